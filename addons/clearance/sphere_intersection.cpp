// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "clearance/sphere_intersection.h"

#include <algorithm>
#include <cmath>

#include "volume/rounding.h"

namespace kios::exact {
namespace {

/// A point that lies outside by less is on the body.
constexpr double kOn = 8 * kUlpDouble;
/// Vertices found to lie farther outside belong to no corner of the body.
constexpr double kNotOn = 1e-9;
/// Bounds it before a vertex is refined: 2^-53 / 1e-12, the least sine allowed, is far below.
constexpr double kNowhereNear = 1e-2;
/// A lens that is thinner than its radii are exact is taken as a disc of this radius, which passes
/// for a part of the spheres: it lies 2^-49 outside. Normals at the rim of a point couldn't add up;
/// the bound loses half a rim by it, and 2^-50 over the rim by rounding.
constexpr double kLeastRim = 0x1p-24;

}  // namespace

template <typename S>
SphereIntersection::SphereIntersection(const kIOS<S>& volume) {
  const double reach =
      std::max<double>(volume.k() > 1 ? scaled(volume.reach, volume.exponent) : 0, volume.radius0);
  exponent_ = reach > 0 ? std::ilogb(reach) + 1 : 0;
  Ball balls[kSpheres];
  spheres_ = toBalls(volume, {0, 0, 0}, exponent_, balls);
  for (int i = 0; i < spheres_; ++i) {
    sphere_[i] = {{balls[i].x, balls[i].y, balls[i].z}, balls[i].r};
    reach_ = std::max(reach_, sphere_[i].c.lpNorm<1>() + sphere_[i].r);
  }
  for (int i = 0; i < spheres_; ++i) {
    for (int j = i + 1; j < spheres_; ++j) addCircle(i, j);
  }
  for (int i = 0; i < spheres_; ++i) {
    for (int j = i + 1; j < spheres_; ++j) {
      for (int k = j + 1; k < spheres_; ++k) addVertices(i, j, k);
    }
  }
}

template SphereIntersection::SphereIntersection(const kIOS<double>&);
template SphereIntersection::SphereIntersection(const kIOS<float>&);

double SphereIntersection::violation(const Vector3d& x) const {
  double worst = -kInfinity;
  for (int i = 0; i < spheres_; ++i) {
    worst = std::max(worst, (x - sphere_[i].c).norm() - sphere_[i].r);
  }
  return worst;
}

// By Heron's factors, each of which is right to a rounding of its terms, the radius is as good as
// the input allows, also for nearly coincident or nearly touching spheres.
void SphereIntersection::addCircle(int i, int j) {
  const Vector3d between = sphere_[j].c - sphere_[i].c;
  const double d = between.norm(), ri = sphere_[i].r, rj = sphere_[j].r;
  if (!(d > 0)) return;
  const double inside_i = d + (rj - ri), inside_j = d + (ri - rj);
  if (!(inside_i > 0 && inside_j > 0)) return;  // nested
  const double depth = ri + rj - d;             // of the lens
  double radius = 0;
  if (depth > 0) radius = std::sqrt(depth * inside_i * inside_j * (d + ri + rj)) / (2 * d);
  const double rim = kLeastRim * std::min(ri, rj);
  if (depth < 4 * kUlpDouble * (ri + rj)) radius = std::max(radius, rim);
  if (!(radius > 0)) return;
  Circle& circle = circle_[circles_];
  circle.i = i;
  circle.j = j;
  circle.axis = between / d;
  circle.height_i = (d + (ri - rj) * ((ri + rj) / d)) / 2;
  circle.height_j = (d - (ri - rj) * ((ri + rj) / d)) / 2;
  circle.center = sphere_[i].c + circle.height_i * circle.axis;
  circle.radius = radius;
  for (int l = 0; l < spheres_; ++l) {  // wholly outside a third sphere?
    const Vector3d offset = sphere_[l].c - circle.center;
    const double along = circle.axis.dot(offset);
    const double across = (offset - along * circle.axis).norm();
    if (l != i && l != j && std::hypot(along, across - radius) > sphere_[l].r + kNotOn) return;
  }
  ++circles_;
}

// With the centres on a line (S0 and a pair of caps often nearly are) three spheres have a circle
// in common or nothing; the pairs' circles then say all that the triple could.
void SphereIntersection::addVertices(int i, int j, int k) {
  const Vector3d to_j = sphere_[j].c - sphere_[i].c, to_k = sphere_[k].c - sphere_[i].c;
  const Vector3d normal = to_j.cross(to_k);
  const double normal2 = normal.squaredNorm();
  if (!(std::sqrt(normal2) > 1e-12 * to_j.norm() * to_k.norm())) return;
  const double ri = sphere_[i].r, rj = sphere_[j].r, rk = sphere_[k].r;
  const double along_j = (to_j.squaredNorm() + (ri - rj) * (ri + rj)) / 2;
  const double along_k = (to_k.squaredNorm() + (ri - rk) * (ri + rk)) / 2;
  const Vector3d middle = (along_j * to_k.cross(normal) + along_k * normal.cross(to_j)) / normal2;
  const double height2 = (ri - middle.norm()) * (ri + middle.norm());
  if (!(height2 > -kNotOn)) return;
  const Vector3d up = std::sqrt(std::max(0.0, height2) / normal2) * normal;
  addVertex(i, j, k, sphere_[i].c + middle + up);
  addVertex(i, j, k, sphere_[i].c + middle - up);
}

void SphereIntersection::addVertex(int i, int j, int k, Vector3d x) {
  if (violation(x) > kNowhereNear) return;
  Vertex& vertex = vertex_[vertices_];
  vertex.sphere = {i, j, k};
  for (int step = 0; step < 3; ++step) {
    Vector3d missing;
    for (int c = 0; c < 3; ++c) {
      const Sphere& s = sphere_[vertex.sphere[c]];
      vertex.rays.col(c) = x - s.c;
      const double length = vertex.rays.col(c).norm();
      missing[c] = (s.r - length) * (s.r + length) / 2;
    }
    vertex.to_multiple = vertex.rays.inverse();
    if (!vertex.to_multiple.allFinite()) return;
    if (step < 2) x += vertex.to_multiple.transpose() * missing;
  }
  vertex.x = x;
  if (violation(x) <= kNotOn) ++vertices_;
}

// The body's is, of the features whose normals add up to v with factors >= 0, the one whose point
// lies inside all spheres (Karush, Kuhn, Tucker); by rounding there may be none, or several that
// differ by as little: the least violated is taken.
SphereIntersection::Extreme SphereIntersection::support(const Vector3d& v) const {
  Extreme best;
  best.violation = kInfinity;
  const auto better = [&](const Vector3d& x) {
    double outside = -kInfinity;
    for (int i = 0; i < spheres_; ++i) {
      outside = std::max(outside, (x - sphere_[i].c).norm() - sphere_[i].r);
      if (!(outside < best.violation)) return false;
    }
    best.violation = outside;
    best.x = x;
    return true;
  };
  const double v_length = v.norm();
  const Vector3d n = v / v_length;
  for (int i = 0; i < spheres_; ++i) {
    const Sphere& s = sphere_[i];
    if (!better(s.c + s.r * n)) continue;
    best.active = 1;
    best.sphere[0] = i;
    best.part[0] = v;
    best.curvature = s.r / v_length * (Matrix3d::Identity() - n * n.transpose());
    if (best.violation <= kOn) return best;
  }
  for (int c = 0; c < circles_; ++c) {
    const Circle& circle = circle_[c];
    const double along = circle.axis.dot(v);
    Vector3d across = v - along * circle.axis;
    const double length = across.norm();
    if (!(length > 0)) continue;
    across /= length;
    const Vector3d x = circle.center + circle.radius * across;
    const double sum = length / circle.radius;
    const double d = circle.height_i + circle.height_j;
    const double of_i = (along + sum * circle.height_j) / d;
    const double of_j = (sum * circle.height_i - along) / d;
    if (!(of_i >= 0 && of_j >= 0) || !better(x)) continue;
    best.active = 2;
    best.sphere = {circle.i, circle.j, 0};
    best.part[0] = of_i * (circle.height_i * circle.axis + circle.radius * across);
    best.part[1] = of_j * (circle.radius * across - circle.height_j * circle.axis);
    const Vector3d tangent = circle.axis.cross(across);
    best.curvature = circle.radius / length * tangent * tangent.transpose();
    if (best.violation <= kOn) return best;
  }
  for (int c = 0; c < vertices_; ++c) {
    const Vertex& vertex = vertex_[c];
    const Vector3d multiples = vertex.to_multiple * v;
    if (!(multiples.minCoeff() >= 0) || !better(vertex.x)) continue;
    best.active = 3;
    best.sphere = vertex.sphere;
    for (int i = 0; i < 3; ++i) best.part[i] = multiples[i] * vertex.rays.col(i);
    best.curvature.setZero();
    if (best.violation <= kOn) return best;
  }
  return best;
}

// n_i.c_i and r_i |n_i| are off by 6 u |n_i| (|c_i|_1 + r_i); what the parts leave of v, computed
// to 4 u of their lengths, is charged to S0, whose centre is the origin.
double SphereIntersection::supportBound(const Vector3d& v, const Extreme& extreme) const {
  double bound = 0, lengths = v.norm();
  Vector3d rest = v;
  for (int i = 0; i < extreme.active; ++i) {
    const Sphere& s = sphere_[extreme.sphere[i]];
    const double length = extreme.part[i].norm();
    bound += extreme.part[i].dot(s.c) + s.r * length;
    lengths += length;
    rest -= extreme.part[i];
  }
  return bound + sphere_[0].r * rest.norm() + 16 * kUlpDouble * lengths * reach_;
}

}  // namespace kios::exact
