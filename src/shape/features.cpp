// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "shape/meets.h"
#include "shape/nearest_point.h"
#include "shape/simplex.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

bool isBefore(const Vec& a, const Vec& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// A search among the features of one triangle. The nearest point q of a solid to a point x is
/// extreme along the normal n there, so that each y of the triangle is at least |x - q| + n (y - x)
/// away: by how far the slab across n falls short of |x - q| is the error of x as nearest point.
class Features {
 public:
  Features(const Solid& solid, const Triangle& triangle, double required, CoreDistance& core)
      : solid_(solid),
        t_(triangle),
        required_(required),
        size_(sizeOf(triangle) + solid.reach()),
        full_ellipsoid_(solid.kind == Kind::kEllipsoid && !isFlat(solid.half, 0) &&
                        !isFlat(solid.half, 1) && !isFlat(solid.half, 2)),
        core_(core) {}

  bool run() {
    core_.lower = -1;
    core_.inside = false;
    int known = kNone;
    if (full_ellipsoid_) {
      Vec outwards;
      if (touchesInRadii(outwards, known)) return false;
      if (core_.lower > required_ + tolerance()) return true;
      if (known == kNone ? face(outwards, 0x1p-20) : cornerAlone(known)) return true;
    }
    int least = 0;
    for (int i = 0; i < 3; ++i) {
      if (i != known) corners_[i] = nearestPoint(solid_, t_[i]);
      if (corners_[i].distance < corners_[least].distance) least = i;
    }
    constexpr double kClear = 0x1p-36;
    if (!(corners_[least].distance > kClear * size_)) return false;
    if (decides(t_[least], corners_[least])) return true;
    for (int i = 0; i < 3; ++i) {
      if (edge(i, (i + 1) % 3)) return true;
    }
    return face(corners_[least].normal, 0);
  }

  /// Takes the nearest of all features, whatever their slabs prove.
  void takeNearest() {
    core_.upper = kInfinity;
    core_.inside = false;
    for (int i = 0; i < 3; ++i) {
      corners_[i] = nearestPoint(solid_, t_[i]);
      offer(t_[i], corners_[i]);
    }
    Vec x;
    NearestPoint q;
    for (int i = 0; i < 3; ++i) {
      if (nearestOnEdge(i, (i + 1) % 3, x, q)) offer(x, q);
    }
    const Vec n = faceNormal(t_).normalized();
    for (const Vec& out : {n, Vec(-n)}) {
      if (foot(n, out, 0, x, q)) offer(x, nearestPoint(solid_, x));
    }
  }

 private:
  static constexpr int kNone = -1;

  double tolerance() const { return 0x1p-49 * size_; }

  /// How far the triangle rises above x along the normal at q: what a slab there lacks, if
  /// negative.
  double rise(const Vec& x, const NearestPoint& q) const {
    const Vec& n = q.normal;
    return std::min({n.dot(t_[0] - x), n.dot(t_[1] - x), n.dot(t_[2] - x)});
  }

  void take(const Vec& x, const NearestPoint& q, double rise) {
    core_.lower = q.distance + std::min(rise, 0.0);
    core_.upper = q.distance;
    core_.point = x;
    core_.on_core = q.on_shape;
  }
  void offer(const Vec& x, const NearestPoint& q) {
    if (q.distance < core_.upper) take(x, q, rise(x, q));
  }

  /// Takes x, a point of the triangle, if its slab proves that it is the nearest one, or that the
  /// pair is farther than is asked.
  bool decides(const Vec& x, const NearestPoint& q) {
    const double rises = rise(x, q);
    const bool farther = q.distance + std::min(rises, 0.0) > required_ + tolerance();
    if (rises < -tolerance() && !farther) return false;
    if (!(q.distance > 0x1p-36 * size_)) return false;
    take(x, q, rises);
    return true;
  }

  /// True if the triangle meets an ellipsoid. Else takes the slab across the ellipsoid's normal
  /// where the two are nearest in units of the radii, and sets `corner` if that is one. Without it
  /// shapes/ellipsoid distance has 0.78 of its speed, contacts 0.89.
  bool touchesInRadii(Vec& outwards, int& corner) {
    if (isLargeInRadii(solid_.half, t_) && meets(solid_, t_, nullptr)) return true;
    Triangle scaled;
    for (int i = 0; i < 3; ++i) scaled[i] = t_[i].cwiseQuotient(solid_.half);
    const Vec nearest = nearestToOrigin(scaled);
    const double length = nearest.norm();
    if (!(length > 1)) return true;
    for (int i = 0; i < 3; ++i) {
      if (nearest == scaled[i]) corner = i;
    }
    outwards = nearest.cwiseQuotient(solid_.half).normalized();
    core_.lower = std::min({outwards.dot(t_[0]), outwards.dot(t_[1]), outwards.dot(t_[2])}) -
                  extentAlong(solid_, outwards);
    core_.point = nearest.cwiseProduct(solid_.half);
    core_.on_core = core_.point / length;
    core_.upper = (core_.point - core_.on_core).norm();
    return false;
  }

  /// Takes a corner if the others lie so far beyond its slab that rounding can't make them nearer.
  bool cornerAlone(int i) {
    const Vec& x = t_[i];
    const NearestPoint& q = corners_[i] = nearestPoint(solid_, x);
    const double rise =
        std::min(q.normal.dot(t_[(i + 1) % 3] - x), q.normal.dot(t_[(i + 2) % 3] - x));
    return rise > 0x1p-40 * size_ && decides(x, q);
  }

  // Half the derivative of the squared distance along the edge is found to be 0 by false position,
  // after Illinois: next to a box and a capsule it is linear but for a few bends.
  bool nearestOnEdge(int i, int j, Vec& x, NearestPoint& q) const {
    if (isBefore(t_[j], t_[i])) std::swap(i, j);
    const Vec& a = t_[i];
    const Vec along = t_[j] - a;
    const auto slope = [&along](const NearestPoint& q) { return q.distance * q.normal.dot(along); };
    double low = 0, high = 1, at_low = slope(corners_[i]), at_high = slope(corners_[j]);
    if (!(at_low < 0 && at_high > 0)) return false;
    constexpr int kGuesses = 16, kSteps = 68;  // halvings follow, for triple roots where both touch
    int kept = 0;                              // the end that stayed where it was: -1 low, 1 high
    for (int step = 0; step < kSteps; ++step) {
      double way = low + (high - low) * (at_low / (at_low - at_high));
      if (step >= kGuesses || !(way > low && way < high)) way = 0.5 * (low + high);
      x = a + way * along;
      q = nearestPoint(solid_, x);
      const double steep = q.normal.dot(along);
      if (std::min(-way * steep, (1 - way) * steep) >= -tolerance()) break;
      const double at = q.distance * steep;
      if (at < 0) {
        low = way;
        at_low = at;
        if (kept == 1) at_high *= 0.5;
        kept = 1;
      } else {
        high = way;
        at_high = at;
        if (kept == -1) at_low *= 0.5;
        kept = -1;
      }
    }
    return true;
  }

  bool edge(int i, int j) {
    Vec x;
    NearestPoint q;
    return nearestOnEdge(i, j, x, q) && decides(x, q);
  }

  /// Sets q to the solid's support point along `out`, n or -n, and x to its projection into the
  /// face, by `inside` of its altitudes, which are that share of all lengths at least. False if
  /// there is none, or the face's plane cuts the solid. Coordinates are along the longest edge,
  /// from a to b, and across it, towards c: a thin face leaves others few digits.
  bool foot(const Vec& n, const Vec& out, double inside, Vec& x, NearestPoint& q) const {
    int longest = 0;
    double uu = 0;
    for (int i = 0; i < 3; ++i) {
      const double square = (t_[(i + 1) % 3] - t_[i]).squaredNorm();
      if (square > uu) longest = i;
      uu = std::max(uu, square);
    }
    const Vec &a = t_[longest], &b = t_[(longest + 1) % 3], &c = t_[(longest + 2) % 3];
    const Vec u = b - a, v = n.cross(u), w = c - a;
    const double width = w.dot(v);
    if (!(width > 0 && width * width >= inside * inside * size_ * size_ * uu)) return false;
    q.on_shape = coreSupport(solid_, out);
    q.normal = out;
    const Vec to = q.on_shape - a;
    if (out.dot(to) > 0x1p-48 * size_) return false;
    const double across = to.dot(v) / width, along = (to.dot(u) - across * w.dot(u)) / uu;
    if (!(across >= inside && along >= inside && across + along <= 1 - inside)) return false;
    x = a + along * u + across * w;
    q.distance = (x - q.on_shape).norm();
    return true;
  }

  bool face(const Vec& outwards, double inside) {
    const Vec n = faceNormal(t_).normalized();  // zero stays zero
    const Vec out = n.dot(outwards) < 0 ? Vec(-n) : n;
    Vec x;
    NearestPoint q;
    return foot(n, out, inside, x, q) &&
           q.distance - out.dot(x - q.on_shape) <= 0.5 * tolerance() && decides(x, q);
  }

  const Solid& solid_;
  const Triangle& t_;
  const double required_, size_;
  const bool full_ellipsoid_;
  CoreDistance& core_;
  NearestPoint corners_[3];
};

}  // namespace

bool distanceByCertificate(const Solid& solid, const Triangle& triangle, double required,
                           CoreDistance& core) {
  return Features(solid, triangle, required, core).run();
}

CoreDistance nearestFeature(const Solid& solid, const Triangle& triangle) {
  CoreDistance core;
  Features(solid, triangle, kInfinity, core).takeNearest();
  return core;
}

}  // namespace kios::shape
