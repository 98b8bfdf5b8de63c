// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace kios {

/// A point in space.
template <typename S>
using Point = Eigen::Matrix<S, 3, 1>;
using Pointd = Point<double>;
using Pointf = Point<float>;

/// A closed triangle by its vertices, in any order; it may degenerate to a segment or a point.
template <typename S>
using TriangleVertices = std::array<Point<S>, 3>;
using TriangleVerticesd = TriangleVertices<double>;
using TriangleVerticesf = TriangleVertices<float>;

}  // namespace kios
