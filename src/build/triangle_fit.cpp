// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/triangle_fit.h"

#include <Eigen/Geometry>

#include "build/measure.h"
#include "build/principal_frame.h"
#include "volume/assemble.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

/// Longest edge from (-a, 0) to (a, 0), apex at (x, h), |x| <= a.
struct PlaneTriangle {
  float a, x, h;
  double rise;  ///< of the apex over the ball over the longest edge, squared: > 0 if outside
};

/// Centres in the triangle's plane: S0 at (0, v0), its caps along the normal at the same place,
/// those across the longest edge at (u, v).
struct PlaneCenters {
  float v0;
  float height;  ///< of the caps along the normal
  float u[2], v[2];
};

PlaneCenters centersOf(const PlaneTriangle& t) {
  PlaneCenters c;
  // Acute if the apex lies outside the ball over the longest edge: then the circumcentre, which is
  // at most a / sqrt(3) above that edge, is the minimal circle's.
  c.v0 = t.rise > 0 && t.h > 0 ? std::min(0.5774F * t.a, static_cast<float>(0.5 * t.rise / t.h))
                               : 0.0F;
  c.height = kCot30 * std::sqrt(t.a * t.a + c.v0 * c.v0);
  for (int i = 0; i < 2; ++i) {
    const float from_box = kCot30 * t.a - 0.5F * t.h;
    const float v = 0.5F * t.h + (i == 0 ? from_box : -from_box);
    // Along the edge: its middle, unless the apex is farther; then level with the far end.
    const float weight_edge = v * v, weight_apex = (t.h - v) * (t.h - v);
    float u = 0;
    if (t.x * t.x + weight_apex > t.a * t.a + weight_edge) {
      const float end = t.x > 0 ? -t.a : t.a;
      u = 0.5F * (t.x * t.x - t.a * t.a + weight_apex - weight_edge) / (t.x - end);
      u = t.x > 0 ? std::min(u, t.x) : std::max(u, t.x);
    }
    c.u[i] = u;
    c.v[i] = v;
  }
  return c;
}

}  // namespace

template <typename S>
kIOS<S> fitTriangle(const fcl::Vector3<S>* points) {
  kIOS<S> bv;
  Vec p[3] = {Vec::Zero(), points[1].template cast<double>() - points[0].template cast<double>(),
              points[2].template cast<double>() - points[0].template cast<double>()};
  const int exponent =
      capExponent(std::max(p[1].cwiseAbs().maxCoeff(), p[2].cwiseAbs().maxCoeff()));
  if (exponent != 0) {
    for (int c = 0; c < 3; ++c) {
      p[1][c] = scaled(p[1][c], -exponent);
      p[2][c] = scaled(p[2][c], -exponent);
    }
  }
  const double squares[3] = {(p[2] - p[1]).squaredNorm(), p[2].squaredNorm(), p[1].squaredNorm()};
  int apex = squares[0] >= squares[1] ? 0 : 1;  // opposite the longest edge
  if (squares[2] > squares[apex]) apex = 2;
  const Vec &from = p[(apex + 1) % 3], &to = p[(apex + 2) % 3];
  const double square = squares[apex], length = std::sqrt(square);
  if (!(length > 0)) {
    bv.center0 = points[0];
    measure(points, 3, exponent, 1, 0, bv);
    return bv;
  }
  const Vec middle = 0.5 * (from + to), edge = to - from;
  // A small height is measured from the nearer end: for slivers, rounding would swallow it if it
  // were measured from the middle.
  const double along = (p[apex] - middle).dot(edge);
  const Vec from_nearer = p[apex] - (along > 0 ? to : from);
  const Vec across = from_nearer - from_nearer.dot(edge) / square * edge;
  const double height = across.norm();
  Eigen::Vector3f e0, e1, e2;
  if (height > 1e-3 * length) {
    e0 = (edge / length).template cast<float>();
    e1 = (across / height).template cast<float>();
    e2 = e0.cross(e1);
  } else {
    const Eigen::Matrix3f axes =
        axesAlong(edge.template cast<float>(), across.template cast<float>());
    e0 = axes.col(0);
    e1 = axes.col(1);
    e2 = axes.col(2);
  }
  const PlaneCenters c =
      centersOf({static_cast<float>(0.5 * length), static_cast<float>(along / length),
                 static_cast<float>(height), (p[apex] - from).dot(p[apex] - to)});
  for (int k = 0; k < 3; ++k) {
    bv.center0[k] =
        static_cast<S>(double{points[0][k]} + scaled(middle[k] + double{c.v0 * e1[k]}, exponent));
  }
  const Eigen::Vector3f caps[4] = {c.height * e2, -c.height * e2,
                                   c.u[0] * e0 + (c.v[0] - c.v0) * e1,
                                   c.u[1] * e0 + (c.v[1] - c.v0) * e1};
  for (int i = 0; i < 4; ++i) {
    bv.cap_x[i] = caps[i][0];
    bv.cap_y[i] = caps[i][1];
    bv.cap_z[i] = caps[i][2];
  }
  measure(points, 3, exponent, 5, 0, bv);
  return bv;
}

template kIOS<double> fitTriangle(const fcl::Vector3<double>*);
template kIOS<float> fitTriangle(const fcl::Vector3<float>*);

}  // namespace kios
