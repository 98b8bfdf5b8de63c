// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace kios::inspect {
namespace {

using Vec = fcl::Vector3d;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// How far x is outside of the ball that it violates most; negative inside all of them.
double excess(const std::vector<Ball>& balls, const Vec& x, int* worst = nullptr) {
  double result = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double e = (x - balls[i].center).norm() - balls[i].radius;
    if (e <= result) continue;
    result = e;
    if (worst) *worst = static_cast<int>(i);
  }
  return result;
}

/// A point inside all balls, as deep as the ellipsoid method finds: the excess is convex, and each
/// step keeps the half of the ellipsoid that its gradient points away from, with the minimum. The
/// volume shrinks by e^(-1/8) a step, however thin the intersection is.
std::optional<Vec> interiorPoint(const std::vector<Ball>& balls) {
  constexpr int kSteps = 250;
  constexpr double n = 3;
  Vec x = balls[0].center;
  Eigen::Matrix3d P = Eigen::Matrix3d::Identity() * balls[0].radius * balls[0].radius;
  Vec best = x;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kSteps; ++step) {
    int worst = 0;
    const double e = excess(balls, x, &worst);
    if (e < least) {
      least = e;
      best = x;
    }
    const Vec gradient = x - balls[worst].center;
    const double width = std::sqrt(gradient.dot(P * gradient));
    if (!(width > 0)) break;
    const Vec g = P * gradient / width;
    x -= g / (n + 1);
    P = n * n / (n * n - 1) * (P - 2 / (n + 1) * g * g.transpose());
  }
  if (least < 0) return best;
  return std::nullopt;
}

/// Rays from a point inside all balls.
class Caster {
 public:
  explicit Caster(const std::vector<Ball>& balls) : balls_(balls) {}

  Vec origin = Vec::Zero();
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();

  /// Where origin + t stretch direction leaves ball i, as t > 0.
  double leave(int i, const Vec& direction) const {
    const Vec v = stretch * direction;
    const Vec q = origin - balls_[i].center;
    const double a = v.squaredNorm(), b = q.dot(v);
    const double c = (q.norm() - balls_[i].radius) * (q.norm() + balls_[i].radius);
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    return b > 0 ? -c / (b + root) : (root - b) / a;
  }
  /// Where the ray leaves the first ball, and which that is.
  Vec cast(const Vec& direction, int& first) const {
    double t = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const double leaves = leave(static_cast<int>(i), direction);
      if (leaves >= t) continue;
      t = leaves;
      first = static_cast<int>(i);
    }
    return origin + t * (stretch * direction);
  }

 private:
  const std::vector<Ball>& balls_;
};

/// Moves the origin to the middle and stretches directions by the shape, until rays in evenly
/// distributed directions meet the boundary about evenly. The mean of boundary points is inside.
void adaptToShape(const std::vector<Ball>& balls, Caster& caster) {
  static const Directions directions = icosphere(2);
  for (int round = 0; round < 8; ++round) {
    Vec mean = Vec::Zero();
    std::vector<Vec> points;
    for (const Vec& direction : directions.vertices) {
      int first = 0;
      points.push_back(caster.cast(direction, first));
      mean += points.back();
    }
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vec& p : points) covariance += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
    Vec lengths = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
    if (!(lengths[2] > 0) || !lengths.allFinite()) return;
    lengths = (lengths / lengths[2]).cwiseMax(1e-6);
    if (excess(balls, mean) < 0) caster.origin = mean;
    caster.stretch = axes.eigenvectors() * lengths.asDiagonal() * axes.eigenvectors().transpose();
  }
}

/// Cuts the triangles of directions where the sphere that the ray leaves changes.
class Triangulation {
 public:
  Triangulation(const Caster& caster, Directions directions)
      : caster_(caster), directions_(std::move(directions.vertices)) {
    for (const Vec& direction : directions_) {
      balls_.push_back(0);
      surface_.vertices.push_back(caster_.cast(direction, balls_.back()));
    }
    for (const auto& triangle : directions.triangles) split(triangle);
  }
  Surface take() { return std::move(surface_); }

 private:
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c, int ball) {
    surface_.faces.push_back({{a, b, c}, ball});
  }

  /// The point of the crease between two corners of different spheres, by bisection.
  std::uint32_t crease(std::uint32_t a, std::uint32_t b) {
    const auto [found, added] = creases_.try_emplace(std::minmax(a, b), 0);
    if (!added) return found->second;
    const Vec from = directions_[a], to = directions_[b];
    double low = 0, high = 1;
    for (int step = 0; step < 50; ++step) {
      const double middle = (low + high) / 2;
      const Vec direction = from + middle * (to - from);
      const bool still_a =
          caster_.leave(balls_[a], direction) <= caster_.leave(balls_[b], direction);
      (still_a ? low : high) = middle;
    }
    return found->second = add(from + low * (to - from));
  }

  /// Where the spheres of a triangle's corners meet, by Newton's method with differences; the
  /// middle if it leaves the triangle.
  Vec corner(const std::array<std::uint32_t, 3>& t) const {
    const Vec &a = directions_[t[0]], b = directions_[t[1]] - a, c = directions_[t[2]] - a;
    const auto gaps = [&](const Eigen::Vector2d& x) {
      const Vec direction = a + x[0] * b + x[1] * c;
      const double first = caster_.leave(balls_[t[0]], direction);
      return Eigen::Vector2d(caster_.leave(balls_[t[1]], direction) - first,
                             caster_.leave(balls_[t[2]], direction) - first);
    };
    const Eigen::Vector2d middle(1.0 / 3, 1.0 / 3);
    Eigen::Vector2d x = middle;
    for (int step = 0; step < 12; ++step) {
      constexpr double h = 1e-6;
      const Eigen::Vector2d f = gaps(x);
      Eigen::Matrix2d slope;
      slope << (gaps(x + Eigen::Vector2d(h, 0)) - f) / h, (gaps(x + Eigen::Vector2d(0, h)) - f) / h;
      x -= slope.fullPivLu().solve(f);
      if (!(x.minCoeff() > 0 && x.sum() < 1)) x = middle;
    }
    return a + x[0] * b + x[1] * c;
  }

  std::uint32_t add(const Vec& direction) {
    int first = 0;
    surface_.vertices.push_back(caster_.cast(direction, first));
    return static_cast<std::uint32_t>(surface_.vertices.size() - 1);
  }

  void split(const std::array<std::uint32_t, 3>& t) {
    const int ball[3] = {balls_[t[0]], balls_[t[1]], balls_[t[2]]};
    if (ball[0] == ball[1] && ball[1] == ball[2]) return face(t[0], t[1], t[2], ball[0]);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      if (balls_[b] != balls_[c]) continue;
      const std::uint32_t ab = crease(a, b), ca = crease(c, a);
      face(a, ab, ca, balls_[a]);
      face(ab, b, c, balls_[b]);
      face(ab, c, ca, balls_[b]);
      return;
    }
    const std::uint32_t middle = add(corner(t));
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const std::uint32_t ab = crease(a, b), ca = crease(c, a);
      face(a, ab, middle, ball[i]);
      face(a, middle, ca, ball[i]);
    }
  }

  const Caster& caster_;
  const std::vector<Vec> directions_;
  std::vector<int> balls_;  ///< that the ray of each direction leaves first
  std::map<Edge, std::uint32_t> creases_;
  Surface surface_;
};

}  // namespace

std::vector<Ball> ballsOf(const kIOSd& volume) {
  std::vector<Ball> balls;
  if (volume.k() == 0) return balls;
  balls.push_back({Vec::Zero(), volume.radius0});
  for (int i = 0; i + 1 < volume.k(); ++i) {
    const auto scaled = [&](float x) {
      return std::ldexp(static_cast<double>(x), volume.exponent);
    };
    balls.push_back({{scaled(volume.cap_x[i]), scaled(volume.cap_y[i]), scaled(volume.cap_z[i])},
                     scaled(volume.cap_r[i])});
  }
  return balls;
}

Directions icosphere(int subdivisions) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  Directions result;
  result.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                     {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  for (Vec& v : result.vertices) v.normalize();
  result.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int step = 0; step < subdivisions; ++step) {
    std::map<Edge, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, added] = middles.try_emplace(
          std::minmax(a, b), static_cast<std::uint32_t>(result.vertices.size()));
      if (added) {
        result.vertices.push_back((result.vertices[a] + result.vertices[b]).normalized());
      }
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : result.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    result.triangles = std::move(finer);
  }
  return result;
}

Surface triangulate(const kIOSd& volume, int subdivisions) {
  const std::vector<Ball> balls = ballsOf(volume);
  if (balls.empty() || !(balls[0].radius > 0)) return {};
  const std::optional<Vec> inside = interiorPoint(balls);
  if (!inside) return {};
  Caster caster(balls);
  caster.origin = *inside;
  adaptToShape(balls, caster);
  return Triangulation(caster, icosphere(subdivisions)).take();
}

}  // namespace kios::inspect
