// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/root_body.h"

#include <algorithm>

#include "tree/box_fit.h"

namespace kios::engine {
namespace {

using Vec = Eigen::Vector3d;
using Four = Eigen::Array4d;  // of the three axes of a box and its middle

// These are of the axes alone.
double widest(const Four& v) { return std::max({v[0], v[1], v[2]}); }
double sumOf(const Four& v) { return v[0] + v[1] + v[2]; }
/// The norm of what is positive.
double normOf(const Four& v) {
  const Four positive = v.max(0);
  return std::sqrt(sumOf(positive * positive));
}

/// Sum of the rows of a box by the coordinates of a vector.
Four along(const Four (&rows)[3], const Vec& w) {
  return rows[0] * w[0] + rows[1] * w[1] + rows[2] * w[2];
}

/// How far b is from a plane, or from what lies below it. `ball` and `middle` are b's in a's frame
/// from the plane's point.
double offPlane(const RootBody& a, const RootBody& b, const Vec& ball, const Vec& middle,
                const Four (&axes)[3]) {
  const Vec n(a.rows[0][0], a.rows[1][0], a.rows[2][0]);
  const auto height = [&](const Vec& p) {
    return a.form == RootBody::Form::kPlane ? std::abs(n.dot(p)) : n.dot(p);
  };
  const double reach = sumOf(along(axes, n).abs() * b.half);
  return std::max(height(ball) - b.radius, height(middle) - reach - b.round);
}

/// How far a box reaches from its tree's origin, and more.
double extentOf(const Box& box) {
  return std::abs(double{box.x[kCenter]}) + std::abs(double{box.y[kCenter]}) +
         std::abs(double{box.z[kCenter]}) +
         1.01 * (double{box.half[0]} + box.half[1] + box.half[2]);
}

// The axes e_k are o_k, at right angles and of length 1, but for u = 2^-24 each, so content has
// |o_k . (p - c)| <= h_k + u |p - c|, and along any axis reaches at most 1.8 u sum h_k farther than
// the box of axes o_k. Stored vertices are off by kStored of the extent.
void setBox(const Box& box, RootBody& body) {
  const float* const rows[3] = {box.x, box.y, box.z};
  for (int c = 0; c < 3; ++c) {
    body.rows[c] = Eigen::Map<const Eigen::Array4f>(rows[c]).cast<double>();
  }
  body.half = Eigen::Map<const Eigen::Array4f>(box.half).cast<double>();
  body.skew = kUlpFloat;
  body.round = 3 * kUlpFloat * extentOf(box);
}

/// A node, or a triangle of a leaf. Without a box of its own it has a cube around its ball.
RootBody bodyOf(const Tree& tree, std::uint32_t id) {
  RootBody body;
  if (isTriangle(id)) {
    const Box box = triangleBox(tree, tree.leaves[leafOfTriangle(id)], laneOfTriangle(id));
    setBox(box, body);
    body.center = {box.x[kCenter], box.y[kCenter], box.z[kCenter]};
    body.radius = (1 + 4 * kUlpFloat) * Vec(box.half[0], box.half[1], box.half[2]).norm();
  } else {
    const Node& node = tree.nodes[id];
    body.center = {node.x[kCentral], node.y[kCentral], node.z[kCentral]};
    body.radius = node.r[kCentral];
  }
  body.radius += kStored * (body.center.lpNorm<1>() + body.radius);
  if (isTriangle(id)) return body;
  if (id == 0 || !tree.boxes.empty()) {
    setBox(id == 0 ? tree.root_box : tree.boxes[id], body);
  } else {
    for (int c = 0; c < 3; ++c) body.rows[c][3] = body.center[c];
    body.half = {body.radius, body.radius, body.radius, 0};
  }
  return body;
}

}  // namespace

[[gnu::hot]] RootBody rootOf(const Mesh& mesh) {
  RootBody body;
  body.center = mesh.center() - Eigen::Map<const Vec>(mesh.tree().origin);
  body.radius = mesh.radius();
  setBox(mesh.tree().root_box, body);
  return body;
}

// In a's frame, b's axes are B = R E_b and those of both C = E_a^T B. With u and v the skews of a
// and b, L the sum of the way between the middles and that from the one ball's centre to the other,
// all halves and radii, s = X.stretch, and Q the rotation next to R, |R - Q| <= s: against boxes of
// axes o_a, Q o_b,
// - b's content is moved by s L more;
// - the way along an axis of a is off by u |way| + s L, elements of C by 1.01 (u + v) + s, and so
//   what b reaches along a's axes by 1.01 (u + v) sum h_b + s L; likewise along b's;
// - products w = o_i x Q o_j: with c = 1.01 (u + v) + s, w . way = C_1j way_2 - C_2j way_1 is off
//   by 2 c |way| + 1.42 u |way|, and what both reach, which are elements of C times halves, by c
//   times these. A length of w below 1 only makes the bound less: in all below (4 (u + v) + 2 s) L.
// The norm of gaps along three axes of one box is a bound, too. X.frame_error is the narrow phase's
// rounding, and kDouble pays for what is computed here.
[[gnu::hot]] double rootBound(const RootBody& a, const RootBody& b, const TreePose& X,
                              double enough) {
  const Vec middle(a.rows[0][3], a.rows[1][3], a.rows[2][3]);
  const Vec ball = X.R * b.center + X.t;
  const double own = X.frame_error + kDouble * X.scale, stretch = 3 * X.stretch;
  const Four &half_a = a.half, &half_b = b.half;
  const Four(&rows_a)[3] = a.rows, (&rows_b)[3] = b.rows;
  double bound = -kInfinity;
  const auto raise = [&](double gap) {
    bound = std::max(bound, gap);
    return bound > enough;
  };
  const auto raiseBy = [&](const Four& gaps, double less) {
    const double most = widest(gaps);
    return raise((most > 0 ? normOf(gaps) : most) - less);
  };
  const double balls = (ball - a.center).norm(), sum_a = sumOf(half_a), sum_b = sumOf(half_b),
               of_balls = balls + sum_a + a.radius + b.radius;
  const bool is_box = a.form == RootBody::Form::kBox;
  if (is_box && (raise(balls - a.radius - b.radius - (stretch * b.radius + own)) ||
                 raiseBy(along(rows_a, ball - middle).abs() - half_a,
                         b.radius + a.round + (a.skew + stretch) * of_balls + own))) {
    return bound;
  }
  const Vec of_b(rows_b[0][3], rows_b[1][3], rows_b[2][3]), to_b = X.R * of_b + X.t - middle;
  const Four out_a = along(rows_a, to_b).abs() - half_a;
  // A middle in the other's box, as a link's in a room: no axis parts them.
  if (is_box && widest(out_a) <= 0) return bound;
  const Four B[3] = {along(rows_b, X.R.row(0)), along(rows_b, X.R.row(1)),
                     along(rows_b, X.R.row(2))};
  const double way = to_b.lpNorm<1>(), lengths = of_balls + way + sum_b,
               skews = 1.01 * (a.skew + b.skew), pad = stretch * lengths + own,
               round = a.round + b.round + pad;
  if (!is_box) return offPlane(a, b, ball - middle, to_b, B) - skews * sum_b - pad;
  const Four out_b = along(B, to_b).abs() - half_b;
  if (widest(out_b) <= 0) return bound;
  const auto columnOfA = [&](int i) { return Vec(rows_a[0][i], rows_a[1][i], rows_a[2][i]); };
  const Four C[3] = {along(B, columnOfA(0)), along(B, columnOfA(1)), along(B, columnOfA(2))};
  const Four reach[3] = {C[0].abs(), C[1].abs(), C[2].abs()};
  if (raiseBy(out_a - Four(sumOf(reach[0] * half_b), sumOf(reach[1] * half_b),
                           sumOf(reach[2] * half_b), 0),
              round + a.skew * way + skews * sum_b)) {
    return bound;
  }
  const Vec halves_a(half_a[0], half_a[1], half_a[2]);
  if (raiseBy(out_b - along(reach, halves_a), round + b.skew * way + skews * sum_a) ||
      raiseBy(along(B, a.center - middle - to_b).abs() - half_b,
              a.radius + b.round + b.skew * lengths + pad) ||
      bound > 0) {
    return bound;
  }
  const Four along_a = along(rows_a, to_b);
  const double more = round + 4 * skews * lengths;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const Four apart = (C[i1] * along_a[i2] - C[i2] * along_a[i1]).abs() -
                       (reach[i2] * half_a[i1] + reach[i1] * half_a[i2]);
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double of_b = half_b[j1] * reach[i][j2] + half_b[j2] * reach[i][j1];
      if (raise(apart[j] - of_b - more)) return bound;
    }
  }
  return bound;
}

double boundInDouble(const Search& search, std::uint32_t node_a, std::uint32_t node_b) {
  return rootBound(bodyOf(search.a, node_a), bodyOf(search.b, node_b), search.pose, 0);
}

// Along w, b's points are at w . (R q + t) = (R^T w) . q + w . t.
double boundAlong(const float (&direction)[3], const StoredPoints& a, const StoredPoints& b,
                  const TreePose& X) {
  const Vec w(direction[0], direction[1], direction[2]);
  double farthest = 0;  // from the origins
  const auto least = [&farthest](const StoredPoints& points, const Vec& along) {
    double result = kInfinity;
    for (int i = 0; i < points.count; ++i) {
      const Lanes* const chunk = points.rows + 3 * (i / kLanes);
      const double x = chunk[0].v[i % kLanes], y = chunk[1].v[i % kLanes],
                   z = chunk[2].v[i % kLanes];
      result = std::min(result, x * along[0] + y * along[1] + z * along[2]);
      farthest = std::max(farthest, std::abs(x) + std::abs(y) + std::abs(z));
    }
    return result;
  };
  const double gap = w.dot(X.t) + least(b, X.R.transpose() * w) + least(a, -w);
  return gap / w.norm() - 2 * kStored * farthest - X.frame_error - kDouble * X.scale;
}

}  // namespace kios::engine
