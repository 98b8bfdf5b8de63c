// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace kios::scenes {
namespace {

using Real = long double;

constexpr std::array<std::array<int, 2>, 3> kEdges{{{0, 1}, {1, 2}, {2, 0}}};

int sign(Real x) { return (x > 0) - (x < 0); }

Real clampToUnit(Real x) { return std::clamp(x, Real(0), Real(1)); }

// All differences are taken before any product, so that an offset common to both triangles costs
// nothing but the rounding already in the coordinates.

Real squaredPointSegment(const ExactPoint& p, const ExactPoint& a, const ExactPoint& b) {
  const ExactPoint edge = b - a;
  const ExactPoint from_a = p - a;
  const Real squared_length = edge.squaredNorm();
  if (squared_length == 0) return from_a.squaredNorm();
  return (from_a - clampToUnit(from_a.dot(edge) / squared_length) * edge).squaredNorm();
}

// Closest points of the lines where both lie within the segments. The cases at an endpoint are
// point-segment pairs, which the caller tries anyway; so parallel segments need nothing here.
Real squaredSegmentInteriors(const ExactPoint& a0, const ExactPoint& a1, const ExactPoint& b0,
                             const ExactPoint& b1) {
  const ExactPoint along_a = a1 - a0;
  const ExactPoint along_b = b1 - b0;
  const ExactPoint normal = along_a.cross(along_b);
  const Real squared_normal = normal.squaredNorm();
  if (squared_normal == 0) return std::numeric_limits<Real>::infinity();
  const ExactPoint start = b0 - a0;
  ExactPoint residual = start;
  Real s = 0;
  Real t = 0;
  // The second and third round remove the error that nearly parallel lines leave in the first.
  for (int round = 0; round < 3; ++round) {
    s = clampToUnit(s + residual.cross(along_b).dot(normal) / squared_normal);
    t = clampToUnit(t + residual.cross(along_a).dot(normal) / squared_normal);
    residual = start + t * along_b - s * along_a;
  }
  return residual.squaredNorm();
}

// Distance to the face where p projects into it. The cases on the border are point-segment pairs.
Real squaredPointFaceInterior(const ExactPoint& p, const ExactTriangle& face) {
  // u is the longest edge and w another at the same corner: v, the altitude, is then as accurate as
  // the shape allows. Solving by u and v and correcting by the residual keeps slivers exact.
  int longest = 0;
  Real longest_squared = -1;
  for (int i = 0; i < 3; ++i) {
    const Real squared = (face[(i + 1) % 3] - face[i]).squaredNorm();
    if (squared > longest_squared) {
      longest_squared = squared;
      longest = i;
    }
  }
  if (longest_squared == 0) return std::numeric_limits<Real>::infinity();
  const ExactPoint& corner = face[longest];
  const ExactPoint u = face[(longest + 1) % 3] - corner;
  const ExactPoint w = face[(longest + 2) % 3] - corner;
  ExactPoint v = w - (u.dot(w) / longest_squared) * u;
  v -= (u.dot(v) / longest_squared) * u;
  const Real v_dot_w = v.dot(w);
  if (!(v_dot_w > 0)) return std::numeric_limits<Real>::infinity();

  const ExactPoint start = p - corner;
  ExactPoint residual = start;
  Real s = 0;
  Real t = 0;
  for (int round = 0; round < 3; ++round) {
    const Real dt = v.dot(residual) / v_dot_w;
    s += u.dot(residual - dt * w) / longest_squared;
    t += dt;
    residual = start - s * u - t * w;
  }
  if (!(s >= 0 && t >= 0 && s + t <= 1)) return std::numeric_limits<Real>::infinity();
  return residual.squaredNorm();
}

// Six times the signed volume of the tetrahedron o a b c.
Real volume(const ExactPoint& o, const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return (a - o).dot((b - o).cross(c - o));
}

// True if the closed segment p q meets the closed face and doesn't run within its plane.
bool segmentPiercesFace(const ExactPoint& p, const ExactPoint& q, const ExactTriangle& face) {
  const int side_p = sign(volume(p, face[0], face[1], face[2]));
  const int side_q = sign(volume(q, face[0], face[1], face[2]));
  if (side_p == side_q) return false;
  int lowest = 1;
  int highest = -1;
  for (const auto& [i, j] : kEdges) {
    const int side = sign(volume(p, q, face[i], face[j]));
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  // Three zeros: the face is degenerate, and the line runs in one plane with it.
  return lowest * highest >= 0 && (lowest != 0 || highest != 0);
}

using Planar = std::array<std::array<Real, 2>, 3>;

Real area(const std::array<Real, 2>& a, const std::array<Real, 2>& b,
          const std::array<Real, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// True if the line of some edge of `a` has all of `b` strictly on one side and `a` on the other. A
// degenerate `a` lies on the line itself.
bool edgeSeparates(const Planar& a, const Planar& b) {
  const int inner = sign(area(a[0], a[1], a[2]));
  return std::any_of(kEdges.begin(), kEdges.end(), [&](const std::array<int, 2>& edge) {
    const int side = sign(area(a[edge[0]], a[edge[1]], b[0]));
    return side != 0 && side != inner && std::all_of(b.begin(), b.end(), [&](const auto& p) {
             return sign(area(a[edge[0]], a[edge[1]], p)) == side;
           });
  });
}

// Overlap within the plane of `a`, which has the given normal and is not degenerate; closed.
bool coplanarTrianglesMeet(const ExactTriangle& a, const ExactTriangle& b,
                           const ExactPoint& normal) {
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const auto project = [dropped](const ExactTriangle& triangle) {
    Planar planar;
    for (int i = 0; i < 3; ++i) {
      planar[i] = {triangle[i][(dropped + 1) % 3], triangle[i][(dropped + 2) % 3]};
    }
    return planar;
  };
  const Planar planar_a = project(a);
  const Planar planar_b = project(b);
  return !edgeSeparates(planar_a, planar_b) && !edgeSeparates(planar_b, planar_a);
}

ExactPoint scaledNormal(const ExactTriangle& face) {
  return (face[1] - face[0]).cross(face[2] - face[0]);
}

// Two degenerate triangles have no face to meet: they are left to the feature distances.
bool facesMeet(const ExactTriangle& a, const ExactTriangle& b) {
  const ExactPoint normal = scaledNormal(a);
  if (normal.isZero(0)) return !scaledNormal(b).isZero(0) && facesMeet(b, a);
  const bool coplanar = std::all_of(
      b.begin(), b.end(), [&](const ExactPoint& p) { return volume(p, a[0], a[1], a[2]) == 0; });
  if (coplanar) return coplanarTrianglesMeet(a, b, normal);
  return std::any_of(kEdges.begin(), kEdges.end(), [&](const std::array<int, 2>& edge) {
    return segmentPiercesFace(a[edge[0]], a[edge[1]], b) ||
           segmentPiercesFace(b[edge[0]], b[edge[1]], a);
  });
}

Real squaredFeatureDistance(const ExactTriangle& a, const ExactTriangle& b) {
  Real best = std::numeric_limits<Real>::infinity();
  for (const auto& [i, j] : kEdges) {
    for (const auto& [k, l] : kEdges) {
      best = std::min(best, squaredSegmentInteriors(a[i], a[j], b[k], b[l]));
    }
  }
  for (int corner = 0; corner < 3; ++corner) {
    for (const auto& [i, j] : kEdges) {
      best = std::min(best, squaredPointSegment(a[corner], b[i], b[j]));
      best = std::min(best, squaredPointSegment(b[corner], a[i], a[j]));
    }
    best = std::min(best, squaredPointFaceInterior(a[corner], b));
    best = std::min(best, squaredPointFaceInterior(b[corner], a));
  }
  return best;
}

}  // namespace

long double triangleDistance(const ExactTriangle& a, const ExactTriangle& b) {
  return facesMeet(a, b) ? 0 : std::sqrt(squaredFeatureDistance(a, b));
}

bool trianglesMeet(const ExactTriangle& a, const ExactTriangle& b) {
  return facesMeet(a, b) || squaredFeatureDistance(a, b) == 0;
}

}  // namespace kios::scenes
