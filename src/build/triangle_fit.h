// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"

namespace kios {

/// The tuned fit of three points in closed form: placeFourTriangles() for one, in which three lanes
/// would idle and a bottom-up refit take an eighth longer. Every coordinate must be finite and
/// below kMaxCoordinate<S>.
template <typename S>
kIOS<S> fitTriangle(const fcl::Vector3<S>* points);

}  // namespace kios
