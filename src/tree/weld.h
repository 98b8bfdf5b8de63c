// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "build/mesh_view.h"

namespace kios::engine {

/// For each vertex that a triangle uses, the first used vertex with equal coordinates (-0 = +0).
template <typename S>
std::vector<std::uint32_t> weld(const MeshView<S>& mesh);

}  // namespace kios::engine
