// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "shapes.h"

namespace kios::testing {

using scenes::Frame;

template <typename S>
std::shared_ptr<Model<S>> modelOf(const Mesh& mesh) {
  return scenes::buildModel<kIOS<S>>(mesh);
}

}  // namespace kios::testing
