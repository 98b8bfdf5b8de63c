// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/orbits.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include "shape/nearest_point.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::articulated {
namespace {

using Eigen::Array4d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The joints that move one of two bodies against the other; rates are >= their turns, or slides,
/// from the configuration to either end of the path.
std::vector<MovingJoint> jointsBetween(const Pair& pair, const Configuration& at) {
  std::vector<MovingJoint> joints = at.jointsOf(pair.a, pair.shared);
  for (const MovingJoint& joint : at.jointsOf(pair.b, pair.shared)) joints.push_back(joint);
  const double time = std::max(at.s(), 1 - at.s()) * (1 + 0x1p-40);
  for (MovingJoint& joint : joints) joint.rate = std::abs(joint.rate) * time;
  return joints;
}

/// A line, or a point, about which two bodies turn along a path, in the world at a configuration.
///
/// Fasten a copy of it to either body there. All along the path the distance of a body's point from
/// its own copy stays what it is, and so does its height along a line. From a configuration q to q'
/// a point c that is fastened to a body moves by at most sum_i |q_i' - q_i| rho_i(c), rho_i its
/// distance from axis i at q (the derivation in linkage/configuration.h), seen from what carries
/// both bodies. So the two copies come apart by at most the sum over the joints of both, which is
/// next to nothing where the axes meet in the point, or lie in the line. A slide along the line
/// leaves the line what it is, but not the heights.
struct Pivot {
  Vector3d point, axis;  ///< the axis of length 1; zero if this is a point, whose heights are all 0
  /// The distances from both copies, of a point that lies in one of the bodies, differ by at most
  /// so much; and the heights above them.
  double slack, height_slack;
};

/// The way of a point by the joints, but for what slides along the axis.
double wayOf(const std::vector<MovingJoint>& joints, const Vector3d& axis, const Vector3d& p,
             double rounding) {
  double sum = 0;
  for (const MovingJoint& joint : joints) {
    sum += joint.rate * (joint.turns ? joint.axis.cross(p - joint.origin).norm() + rounding
                                     : (joint.axis - axis.dot(joint.axis) * axis).norm() + 0x1p-43);
  }
  return sum * (1 + 0x1p-40);
}

/// Returns the line of least slack among the axes, and the point that is nearest to all of them,
/// each weighed by its turn. Neither if no joint turns the bodies about each other, or the slack is
/// as large as one of them, or as `most`.
std::vector<Pivot> pivotsOf(const Path& path, const Pair& pair, const Configuration& at,
                            double most) {
  const BodyData &a = path.linkage().bodies[pair.a], &b = path.linkage().bodies[pair.b];
  if (!a.bounded || !b.bounded) return {};
  const std::vector<MovingJoint> joints = jointsBetween(pair, at);
  const bool a_is_smaller = a.content.radius < b.content.radius;
  const Vector3d& middle = at.center(a_is_smaller ? pair.a : pair.b);
  const double radius = a_is_smaller ? a.content.radius : b.content.radius;
  const double lengths = path.length(pair.a) + path.length(pair.b);
  const double rounding = path.pad(pair.a, pair.b) + 0x1p-43 * lengths;
  double slides = 0;
  for (const MovingJoint& joint : joints) slides += joint.turns ? 0 : joint.rate;
  most = std::min(most, radius);
  std::vector<Pivot> found;
  const auto offer = [&](const Vector3d& point, const Vector3d& axis, double below) {
    const double off = (point - middle).norm();
    if (!(off <= 2 * lengths)) return;  // rounding counts on that
    // All points to be looked at are so near to any copy, as the slack is less than the radius.
    // Where the ends of the copies come apart by it, they turn by it over the length.
    const Vector3d arm = (off + 2 * radius + slides) * (1 + 0x1p-40) * axis;
    const double slack = std::max(wayOf(joints, axis, point + arm, rounding),
                                  wayOf(joints, axis, point - arm, rounding));
    if (slack < below) found.push_back({point, axis, slack, 2 * slack + slides});
  };
  Matrix3d M = Matrix3d::Zero();
  Vector3d sum = Vector3d::Zero();
  int turns = 0;
  for (const MovingJoint& joint : joints) {
    if (!joint.turns) continue;
    const Vector3d axis = joint.axis.normalized();
    offer(joint.origin + axis.dot(middle - joint.origin) * axis, axis,
          found.empty() ? most : found.back().slack);
    if (found.size() > 1) found.erase(found.begin());
    const Matrix3d across = joint.rate * (Matrix3d::Identity() - axis * axis.transpose());
    M += across;
    sum += across * (joint.origin - middle);
    ++turns;
  }
  if (turns > 1) offer(middle + M.ldlt().solve(sum), Vector3d::Zero(), most);
  return found;
}

/// Bounds an image, by intervals of r, z, r + z and r - z.
struct Image {
  Array4d low = Array4d::Constant(kInfinity), high = -low;

  void take(double near, double far, double bottom, double top) {
    unite({{near, bottom, near + bottom, near - top}, {far, top, far + top, far - bottom}});
  }
  void unite(const Image& o) {
    low = low.min(o.low);
    high = high.max(o.high);
  }
};

/// The image of the hull of three points in the world. Any direction will do; that to the nearest
/// point tells most.
Image ofTriangle(const TriangleVertices<double>& p, const Pivot& pivot) {
  TriangleVertices<double> across;
  double heights[3];
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = p[k] - pivot.point;
    heights[k] = pivot.axis.dot(d);
    across[k] = d - heights[k] * pivot.axis;
  }
  const Vector3d n = unitVector(shape::nearestToOrigin(across));
  Image image;
  for (int k = 0; k < 3; ++k) {
    image.take(n.dot(across[k]), across[k].norm(), heights[k], heights[k]);
  }
  return image;
}

/// The image of a shape, which is taken to reach as far as the axis. All of it lies within a radius
/// of the segment between two points; from the axis a disk's rim is as far as its centre and the
/// radius at most.
Image ofShape(const shape::Solid& solid, const fcl::Transform3d& X, const Pivot& pivot) {
  const Vector3d half = solid.half_length * X.linear().col(2);
  double far = 0;
  for (const Vector3d& end : {Vector3d(half), Vector3d(-half)}) {
    const Vector3d d = X.translation() + end - pivot.point;
    far = std::max(far, (d - pivot.axis.dot(d) * pivot.axis).norm());
  }
  far += solid.half_length > 0 ? solid.radius : solid.reach();
  const auto extent = [&](const Vector3d& n) {
    return shape::extentAlong(solid, X.linear().transpose() * n) +
           n.dot(X.translation() - pivot.point);
  };
  Image image;
  image.take(0, far, -extent(-pivot.axis), extent(pivot.axis));
  return image;
}

/// The images of a body's nodes; a shape is one leaf.
class Images {
 public:
  Images(const BodyData& body, const fcl::Transform3d& X, const Pivot& pivot) : model_(body.model) {
    if (!model_) images_.push_back(ofShape(body.own->solid, X, pivot));
    images_.resize(model_ ? static_cast<std::size_t>(model_->getNumBVs()) : 1);
    // Children follow their parents.
    for (int node = model_ ? model_->getNumBVs() : 0; node-- > 0;) {
      const auto& bv = model_->getBV(node);
      Image& image = images_[static_cast<std::size_t>(node)];
      if (bv.isLeaf()) {
        const fcl::Triangle& t = model_->tri_indices[bv.primitiveId()];
        const Vector3d* const vertices = model_->vertices;
        image = ofTriangle({X * vertices[t[0]], X * vertices[t[1]], X * vertices[t[2]]}, pivot);
      } else {
        image = at(bv.leftChild());
        image.unite(at(bv.rightChild()));
      }
    }
  }

  const Image& at(int node) const { return images_[static_cast<std::size_t>(node)]; }
  bool isLeaf(int node) const { return !model_ || model_->getBV(node).isLeaf(); }
  int child(int node, int i) const { return model_->getBV(node).leftChild() + i; }
  long long size() const { return static_cast<long long>(images_.size()); }

 private:
  const Modeld* const model_;
  std::vector<Image> images_;
};

/// True if all nodes are apart: in an interval by more than is needed.
bool areApart(const Images& a, const Images& b, const Array4d& needed, long long& cost) {
  // What is to be proven is so at large: many nodes in each other's reach are hopeless.
  const long long most = 64 + a.size() + b.size();
  std::vector<std::pair<int, int>> stack = {{0, 0}};
  long long tests = 0;
  bool proven = true;
  while (proven && !stack.empty()) {
    const auto [i, k] = stack.back();
    stack.pop_back();
    ++tests;
    const Image &x = a.at(i), &y = b.at(k);
    if ((y.low - x.high > needed || x.low - y.high > needed).any()) continue;
    const bool leaf_a = a.isLeaf(i), leaf_b = b.isLeaf(k);
    proven = !(leaf_a && leaf_b) && tests <= most;
    const bool splits_a = leaf_b || (!leaf_a && x.high[0] - x.low[0] > y.high[0] - y.low[0]);
    for (int child = 0; proven && child < 2; ++child) {
      stack.emplace_back(splits_a ? a.child(i, child) : i, splits_a ? k : b.child(k, child));
    }
  }
  cost += tests / 8;
  return proven;
}

}  // namespace

bool orbitsApart(const Path& path, const Pair& pair, const Configuration& at, double apart,
                 double min_separation, long long& cost) {
  const BodyData &a = path.linkage().bodies[pair.a], &b = path.linkage().bodies[pair.b];
  if (a.kind == BodyKind::kOctree || b.kind == BodyKind::kOctree) return false;
  const auto pivots = pivotsOf(path, pair, at, apart);
  return std::any_of(pivots.begin(), pivots.end(), [&](const Pivot& pivot) {
    // Places are off by less than the pad, images by a few roundings of lengths.
    const double lengths =
        path.length(pair.a) + path.length(pair.b) + pivot.point.lpNorm<1>() + min_separation;
    const double gap = min_separation + 4 * path.pad(pair.a, pair.b) + 0x1p-44 * lengths;
    const double both = 1.5 * gap + pivot.slack + pivot.height_slack;  // > sqrt(2) gap
    const Images of_a(a, at.pose(pair.a), pivot), of_b(b, at.pose(pair.b), pivot);
    cost += 2 * (of_a.size() + of_b.size());
    return areApart(of_a, of_b, {gap + pivot.slack, gap + pivot.height_slack, both, both}, cost);
  });
}

}  // namespace kios::articulated
