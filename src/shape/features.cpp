// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "shape/meets.h"
#include "shape/nearest_point.h"
#include "shape/simplex.h"

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

 private:
  static constexpr int kNone = -1;

  double tolerance() const { return 0x1p-49 * size_; }

  /// Takes x, a point of the triangle, if its slab proves that it is the nearest one, or that the
  /// pair is farther than is asked.
  bool decides(const Vec& x, const NearestPoint& q) {
    const double rise =
        std::min({q.normal.dot(t_[0] - x), q.normal.dot(t_[1] - x), q.normal.dot(t_[2] - x)});
    const double lower = q.distance + std::min(rise, 0.0);
    const bool nearest = rise >= -tolerance();
    if (!nearest && !(lower > required_ + tolerance())) return false;
    if (!(q.distance > 0x1p-36 * size_)) return false;
    core_.lower = lower;
    core_.upper = q.distance;
    core_.point = x;
    core_.on_core = q.on_shape;
    return true;
  }

  /// True if the triangle meets an ellipsoid. Else takes the slab across the ellipsoid's normal
  /// where the two are nearest in units of the radii, and sets `corner` if that is one.
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

  /// Guesses where on an edge an ellipsoid is nearest. x = a + s d has the nearest point e^2 n,
  /// n = x / (e^2 + t), for s and t of |e n| = 1 and n d = 0: Newton's method for both, as in
  /// nearestPoint(), from where the edge is nearest in units of the radii.
  double guessOnEdge(const Vec& a, const Vec& d) const {
    const Eigen::Array3d e = solid_.half.array(), e2 = e * e;
    const Vec scaled_a = a.array() / e, scaled_d = d.array() / e;
    double s = nearestOnSegment(scaled_a, scaled_a + scaled_d), t = 0;
    constexpr int kSteps = 12;
    for (int step = 0; step < kSteps; ++step) {
      const Eigen::Array3d x = a + s * d;
      t = std::max(t, (e * x.abs() - e2).maxCoeff());  // keeps |e_i n_i| within 1
      const Eigen::Array3d over = 1 / (e2 + t), n = x * over, nd = n * d.array(),
                           dd = d.array().square() * over;
      const Eigen::Array3d w2 = e2 * n * n;
      const double square = w2.sum(), r = (w2 * over).sum();
      const double h = (std::sqrt(square) - 1) * square;
      const double g = nd.sum(), a1 = dd.sum(), b = (e2 * nd * over).sum(), c = (nd * over).sum();
      const double determinant = r * a1 - b * c;
      if (!(determinant > 0)) break;
      const double ds = (c * h - r * g) / determinant, dt = (a1 * h - b * g) / determinant;
      s = std::clamp(s + ds, 0.0, 1.0);
      t = std::max(0.0, t + dt);
      if (std::abs(ds) <= 0x1p-30) break;
    }
    return s;
  }

  // Half the derivative of the squared distance along the edge is found to be 0 by false position,
  // after Illinois: next to a box and a capsule it is linear but for a few bends.
  bool edge(int i, int j) {
    if (isBefore(t_[j], t_[i])) std::swap(i, j);
    const Vec& a = t_[i];
    const Vec along = t_[j] - a;
    const auto slope = [&along](const NearestPoint& q) { return q.distance * q.normal.dot(along); };
    double low = 0, high = 1, at_low = slope(corners_[i]), at_high = slope(corners_[j]);
    if (!(at_low < 0 && at_high > 0)) return false;
    constexpr int kSteps = 40;
    int kept = 0;  // the end that stayed where it was: -1 low, 1 high
    for (int step = 0; step < kSteps; ++step) {
      double way = step == 0 && full_ellipsoid_
                       ? guessOnEdge(a, along)
                       : low + (high - low) * (at_low / (at_low - at_high));
      if (!(way > low && way < high)) way = 0.5 * (low + high);
      const Vec x = a + way * along;
      const NearestPoint q = nearestPoint(solid_, x);
      const double steep = q.normal.dot(along);
      if (std::min(-way * steep, (1 - way) * steep) >= -tolerance()) return decides(x, q);
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
    return false;
  }

  /// The face is nearest where the solid's support point along its normal projects into it, by
  /// `inside` of its altitudes, which are that share of all lengths at least.
  bool face(const Vec& outwards, double inside) {
    Vec n = faceNormal(t_);
    const double length = n.norm();
    if (!(length > 0)) return false;
    n /= length;
    if (n.dot(outwards) < 0) n = -n;
    NearestPoint q;
    q.on_shape = coreSupport(solid_, n);
    q.normal = n;
    const Vec u = t_[1] - t_[0], v = t_[2] - t_[0], w = q.on_shape - t_[0];
    const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
    const double uw = u.dot(w), vw = v.dot(w), determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) return false;
    const double s = (vv * uw - uv * vw) / determinant, t = (uu * vw - uv * uw) / determinant;
    if (!(s >= inside && t >= inside && s + t <= 1 - inside)) return false;
    const double longest = std::max({uu, vv, uu + vv - 2 * uv});
    if (!(determinant >= inside * inside * size_ * size_ * longest)) return false;
    const Vec x = t_[0] + s * u + t * v;
    q.distance = (x - q.on_shape).norm();
    // A thin face leaves s and t, and x with them, few digits.
    return q.distance - n.dot(x - q.on_shape) <= 0.5 * tolerance() && decides(x, q);
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

}  // namespace kios::shape
