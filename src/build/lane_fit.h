// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "volume/lanes.h"

namespace kios {

/// Four points.
struct PointQuad {
  lanes::Float4 x, y, z;
};

/// Rows of points to place spheres by: of four sets, one a lane, or of one set in all lanes.
struct PointRows {
  static constexpr int kMost = 32;
  int count = 0;
  PointQuad points[kMost];
  lanes::Float4 weight[kMost];  ///< 0 where a point stands again, else 1

  void set(int row, int lane, float x, float y, float z, float of_point) {
    points[row].x[lane] = x;
    points[row].y[lane] = y;
    points[row].z[lane] = z;
    weight[row][lane] = of_point;
  }
};

/// The places of the spheres of four volumes, one a lane: S0 in the frame of the points, caps
/// relative to it. Of one set all lanes are equal.
struct SphereSites {
  int k[4];
  lanes::Float4 center[3];
  lanes::Float4 cap[4][3];
};

/// The sets that rows hold, and the care taken with them.
enum class Sets {
  kFour,            ///< each sphere is centred between two points
  kFourThoroughly,  ///< between as many as it takes, mostly: a half longer, for what is tested
                    ///< often
  kOne              ///< likewise, and along the shortest axis too
};

/// The tuned fit. S0 is nearly minimal; each cap starts as a sphere through the rim of the far face
/// of the box along the principal axes, half opening angle 30 degrees, and is centred in its plane.
///
///          o          centre
///         /|\         half opening angle
///        / | \        w / tan(angle) from the centre to the far face
///     +-/--+--\-+     box of the content, 2 h high
///     |/   | h \|
///     +----+----+     far face, whose rim is at most w from the axis
///      '-._ _.-'      cap
SphereSites placeSpheres(const PointRows& rows, Sets sets);

/// The tuned fit of four triangles in closed form: three rows.
SphereSites placeTriangles(const PointRows& triangles);

/// The largest squared distances of the points of each lane from S0's centre, and from the caps'.
struct FarthestSquares {
  lanes::Float4 s0, cap[4];
};
FarthestSquares farthestSquares(const PointQuad* rows, std::size_t n, const SphereSites& sites);

/// The points of a set that lie farthest along the axes and the diagonals of a cube, each once.
/// They stand for a large set where spheres are placed, never where radii are measured.
struct Extremes {
  static constexpr int kDirections = 13;  ///< half of the 26
  static constexpr int kMost = 2 * kDirections;
  int count = 0;
  float x[kMost], y[kMost], z[kMost];

  void move(lanes::Float4 by);
};

Extremes extremesOf(const PointQuad* quads, std::size_t n);

/// Rows of one set: the extremes of its parts.
PointRows rowsOf(const Extremes* parts, int n);

}  // namespace kios
