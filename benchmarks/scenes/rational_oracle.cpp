// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rational_oracle.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "integers.h"

namespace kios::scenes {
namespace {

// The least squared distance so far, as a fraction.
class Least {
 public:
  void offer(const Integer& numerator, const Integer& denominator) {
    if (denominator_ != 0 && numerator * denominator_ >= numerator_ * denominator) return;
    numerator_ = numerator;
    denominator_ = denominator;
  }
  bool zero() const { return denominator_ != 0 && numerator_ == 0; }

  long double root(int exponent) const {
    using Float = mp::number<mp::cpp_bin_float<100>, mp::et_off>;
    const Float squared = Float(numerator_) / Float(denominator_);
    return ldexp(sqrt(squared), exponent).convert_to<long double>();
  }

 private:
  Integer numerator_, denominator_ = 0;
};

struct Face {
  Vector origin, u, v, normal;
  Integer squared_normal;  // 0: no face, its edges say all

  explicit Face(const Triangle& t)
      : origin(t[0]),
        u(t[1] - t[0]),
        v(t[2] - t[0]),
        normal(cross(u, v)),
        squared_normal(dot(normal, normal)) {}

  // True if the point w / weight from the origin projects into the closed face.
  bool holds(const Vector& w, const Integer& weight) const {
    const Integer along_u = dot(cross(w, v), normal);
    if (along_u < 0) return false;
    const Integer along_v = dot(cross(u, w), normal);
    return along_v >= 0 && along_u + along_v <= weight * squared_normal;
  }
};

void offerPointSegment(const Vector& p, const Vector& a, const Vector& b, Least& least) {
  const Vector w = p - a, d = b - a;
  const Integer along = dot(w, d), length = dot(d, d);
  if (along <= 0) {
    least.offer(dot(w, w), 1);
  } else if (along >= length) {
    const Vector from_b = p - b;
    least.offer(dot(from_b, from_b), 1);
  } else {
    least.offer(dot(w, w) * length - along * along, length);
  }
}

// Offers the nearest points of the two lines if they lie in both segments. Otherwise, and for
// parallel lines, an end and the other segment are nearest.
void offerSegmentSegment(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1,
                         Least& least) {
  const Vector da = a1 - a0, db = b1 - b0, n = cross(da, db);
  const Integer squared = dot(n, n);
  if (squared == 0) return;
  const Vector w = b0 - a0;
  const Integer s = dot(cross(w, db), n);
  if (s < 0 || s > squared) return;
  const Integer t = dot(cross(w, da), n);
  if (t < 0 || t > squared) return;
  const Integer height = dot(w, n);
  least.offer(height * height, squared);
}

void offerPointFace(const Vector& p, const Face& face, Least& least) {
  if (face.squared_normal == 0) return;
  const Vector w = p - face.origin;
  if (!face.holds(w, 1)) return;
  const Integer height = dot(w, face.normal);
  least.offer(height * height, face.squared_normal);
}

// The point (hq p - hp q) / (hq - hp) of a segment whose ends lie strictly on opposite sides.
bool pierces(const Vector& p, const Vector& q, const Face& face) {
  if (face.squared_normal == 0) return false;
  const Vector wp = p - face.origin, wq = q - face.origin;
  Integer hp = dot(wp, face.normal), hq = dot(wq, face.normal);
  if (hp.sign() * hq.sign() >= 0) return false;
  if (hq < 0) {
    hp = -hp;
    hq = -hq;
  }
  Vector w;
  for (int c = 0; c < 3; ++c) w[c] = hq * wp[c] - hp * wq[c];
  return face.holds(w, hq - hp);
}

}  // namespace

RationalDistance rationalDistance(const TrianglePair& pair) {
  const IntegerPoints integers({pair.a[0], pair.a[1], pair.a[2], pair.b[0], pair.b[1], pair.b[2]});
  const auto& points = integers.points;
  const Triangle a{points[0], points[1], points[2]}, b{points[3], points[4], points[5]};
  const Face face_a(a), face_b(b);
  Least least;
  for (int i = 0; i < 3; ++i) {
    if (pierces(a[i], a[kNext[i]], face_b) || pierces(b[i], b[kNext[i]], face_a)) return {true, 0};
    offerPointFace(a[i], face_b, least);
    offerPointFace(b[i], face_a, least);
    for (int k = 0; k < 3; ++k) {
      offerPointSegment(a[i], b[k], b[kNext[k]], least);
      offerPointSegment(b[i], a[k], a[kNext[k]], least);
      offerSegmentSegment(a[i], a[kNext[i]], b[k], b[kNext[k]], least);
    }
    if (least.zero()) return {true, 0};
  }
  return {false, least.root(integers.exponent)};
}

long double rationalDistance(const Eigen::Vector3d& point,
                             const std::array<Eigen::Vector3d, 3>& triangle) {
  const IntegerPoints integers({point, triangle[0], triangle[1], triangle[2]});
  const auto& points = integers.points;
  Least least;
  offerPointFace(points[0], Face({points[1], points[2], points[3]}), least);
  for (int k = 0; k < 3; ++k) {
    offerPointSegment(points[0], points[1 + k], points[1 + kNext[k]], least);
  }
  return least.zero() ? 0 : least.root(integers.exponent);
}

}  // namespace kios::scenes
