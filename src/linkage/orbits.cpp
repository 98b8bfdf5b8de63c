// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/orbits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkage/pivot.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;

constexpr int kIntervals = 4;  // of r, z, r + z and r - z

/// Bounds an image. That about a point has r alone: its other intervals are without ends.
struct Image {
  double low[kIntervals], high[kIntervals];

  void unite(const Image& o) {
    for (int i = 0; i < kIntervals; ++i) {
      low[i] = std::min(low[i], o.low[i]);
      high[i] = std::max(high[i], o.high[i]);
    }
  }
  /// Compares the images of two bodies: in an interval a gap of more than `needed` parts them.
  bool isApart(const Image& o, const double* needed) const {
    bool any = false;
    for (int i = 0; i < kIntervals; ++i) {
      any |= o.low[i] - high[i] > needed[i] || low[i] - o.high[i] > needed[i];
    }
    return any;
  }
};

/// A place's part across the pivot's axis, all of it about a point; and its height.
struct Coordinates {
  Vector3d across;
  double height;
};

class Imager {
 public:
  explicit Imager(const Pivot& pivot) : pivot_(pivot) {}

  Coordinates of(const Vector3d& p) const {
    const Vector3d d = p - pivot_.point;
    const double height = pivot_.axis.dot(d);
    return {d - height * pivot_.axis, height};
  }

  /// The image of a triangle of a mesh at X, or of a shape.
  Image ofLeaf(const BodyData& body, const fcl::Transform3d& X, int triangle) const {
    if (!body.model) return ofShape(body, X);
    const fcl::Triangle& t = body.model->tri_indices[triangle];
    const Vector3d* const vertices = body.model->vertices;
    const Vector3d corners[3] = {X * vertices[t[0]], X * vertices[t[1]], X * vertices[t[2]]};
    return ofTriangle(corners);
  }

 private:
  /// The image of the hull of three points in the world.
  Image ofTriangle(const Vector3d* p) const {
    Coordinates c[3];
    double lengths[3];
    for (int k = 0; k < 3; ++k) {
      c[k] = of(p[k]);
      lengths[k] = c[k].across.norm();
    }
    // One of the directions towards corners, edges and the face leads to the nearest point.
    Vector3d best = Vector3d::Zero();
    double nearest = 0;
    const auto attempt = [&](const Vector3d& direction) {
      const Vector3d n = unitVector(direction);
      const double least = std::min({n.dot(c[0].across), n.dot(c[1].across), n.dot(c[2].across)});
      if (!(least > nearest)) return;
      nearest = least;
      best = n;
    };
    for (int k = 0; k < 3; ++k) {
      const Vector3d &from = c[k].across, edge = c[(k + 1) % 3].across - from;
      attempt(from);
      const double square = edge.squaredNorm();
      if (square > 0) attempt(from - std::clamp(from.dot(edge) / square, -1.0, 1.0) * edge);
    }
    const Vector3d face = (c[1].across - c[0].across).cross(c[2].across - c[0].across);
    attempt(face);
    attempt(-face);
    Image image = empty();
    for (int k = 0; k < 3; ++k) {
      const double r = best.dot(c[k].across), z = c[k].height;
      take(image, r, lengths[k], z, z);
    }
    return image;
  }

  /// The image of a shape at a place, by what it is: all of it within `radius` of one of two points
  /// of its axis.
  Image ofShape(const BodyData& body, const fcl::Transform3d& X) const {
    const shape::Solid& solid = body.solid;
    const bool is_long = solid.kind == shape::Kind::kCapsule ||
                         solid.kind == shape::Kind::kCylinder || solid.kind == shape::Kind::kCone;
    const Vector3d half = solid.half_length * X.linear().col(2);
    // From the pivot's axis the rim of a disk is as far as its centre and the radius at most.
    double far = 0;
    if (is_long) {
      far = std::max(of(X.translation() + half).across.norm(),
                     of(X.translation() - half).across.norm()) +
            solid.radius;
    } else {
      far = of(X.translation()).across.norm() + solid.reach();
    }
    const auto extent = [&](const Vector3d& n) {
      return shape::extentAlong(solid, X.linear().transpose() * n) +
             n.dot(X.translation() - pivot_.point);
    };
    const Vector3d n = unitVector(of(X.translation()).across);
    const double near = n.isZero(0) ? 0 : std::max(0.0, -extent(-n));
    Image image = empty();
    if (pivot_.isLine()) {
      take(image, near, far, -extent(-pivot_.axis), extent(pivot_.axis));
    } else {
      take(image, near, far, 0, 0);
    }
    return image;
  }

  static Image empty() {
    Image image;
    std::fill_n(image.low, kIntervals, kInfinity);
    std::fill_n(image.high, kIntervals, -kInfinity);
    return image;
  }

  void take(Image& image, double near, double far, double low, double high) const {
    const bool line = pivot_.isLine();
    image.unite({{near, line ? low : -kInfinity, line ? near + low : -kInfinity,
                  line ? near - high : -kInfinity},
                 {far, line ? high : kInfinity, line ? far + high : kInfinity,
                  line ? far - low : kInfinity}});
  }

  const Pivot& pivot_;
};

/// The images of a body's nodes; a shape is one leaf.
class Images {
 public:
  Images(const BodyData& body, const fcl::Transform3d& X, const Imager& imager)
      : model_(body.model) {
    if (!model_) {
      images_.push_back(imager.ofLeaf(body, X, 0));
      return;
    }
    images_.resize(static_cast<std::size_t>(model_->getNumBVs()));
    // Children follow their parents.
    for (int node = model_->getNumBVs(); node-- > 0;) {
      const auto& bv = model_->getBV(node);
      Image& image = images_[static_cast<std::size_t>(node)];
      if (bv.isLeaf()) {
        image = imager.ofLeaf(body, X, bv.primitiveId());
      } else {
        image = at(bv.leftChild());
        image.unite(at(bv.rightChild()));
      }
    }
  }

  const Image& at(int node) const { return images_[static_cast<std::size_t>(node)]; }
  bool isLeaf(int node) const { return !model_ || model_->getBV(node).isLeaf(); }
  int child(int node, int i) const { return model_->getBV(node).leftChild() + i; }
  std::size_t size() const { return images_.size(); }

 private:
  const Modeld* const model_;
  std::vector<Image> images_;
};

bool areApart(const Images& a, const Images& b, const double* needed, long long& cost) {
  // What is to be proven is so at large: many nodes in each other's reach are hopeless.
  const long long most = 64 + static_cast<long long>(a.size() + b.size());
  std::vector<std::pair<int, int>> stack = {{0, 0}};
  long long own_tests = 0;
  bool proven = true;
  while (proven && !stack.empty()) {
    const auto [i, k] = stack.back();
    stack.pop_back();
    ++own_tests;
    const Image &x = a.at(i), &y = b.at(k);
    if (x.isApart(y, needed)) continue;
    const bool leaf_a = a.isLeaf(i), leaf_b = b.isLeaf(k);
    if ((leaf_a && leaf_b) || own_tests > most) proven = false;
    const bool splits_a = leaf_b || (!leaf_a && x.high[0] - x.low[0] > y.high[0] - y.low[0]);
    for (int child = 0; proven && child < 2; ++child) {
      if (splits_a) {
        stack.emplace_back(a.child(i, child), k);
      } else {
        stack.emplace_back(i, b.child(k, child));
      }
    }
  }
  cost += own_tests / 8;
  return proven;
}

/// The images about a pivot, and the gaps of their intervals that part the bodies.
class Orbits {
 public:
  Orbits(const Path& path, const Pair& pair, const Configuration& at, double min_separation,
         const Pivot& pivot)
      : pair_(pair),
        a_(path.linkage().bodies[pair.a]),
        b_(path.linkage().bodies[pair.b]),
        X_WA_(at.pose(pair.a)),
        X_WB_(at.pose(pair.b)),
        imager_(pivot) {
    // Places are off by less than the pad, images by a few roundings of lengths.
    const double lengths =
        path.length(pair.a) + path.length(pair.b) + pivot.point.lpNorm<1>() + min_separation;
    const double gap = min_separation + 4 * path.pad(pair.a, pair.b) + 0x1p-44 * lengths;
    needed_[0] = gap + pivot.slack;
    needed_[1] = gap + pivot.height_slack;
    needed_[2] = needed_[3] = 1.5 * gap + pivot.slack + pivot.height_slack;  // > sqrt(2) gap
  }

  bool nearestApart() const {
    const bool known = (!a_.model || pair_.triangle_a >= 0) && (!b_.model || pair_.triangle_b >= 0);
    return !known || imager_.ofLeaf(a_, X_WA_, pair_.triangle_a)
                         .isApart(imager_.ofLeaf(b_, X_WB_, pair_.triangle_b), needed_);
  }

  bool allApart(long long& cost) const {
    const Images of_a(a_, X_WA_, imager_), of_b(b_, X_WB_, imager_);
    cost += 2 * static_cast<long long>(of_a.size() + of_b.size());
    return areApart(of_a, of_b, needed_, cost);
  }

 private:
  const Pair& pair_;
  const BodyData &a_, &b_;
  const fcl::Transform3d &X_WA_, &X_WB_;
  const Imager imager_;
  double needed_[kIntervals];
};

/// True if `test` holds for the orbits about one of the pivots.
template <typename Test>
bool anyOrbits(const Path& path, const Pair& pair, const Configuration& at, double min_separation,
               const Test& test) {
  const auto& bodies = path.linkage().bodies;
  if (bodies[pair.a].kind == BodyKind::kOctree || bodies[pair.b].kind == BodyKind::kOctree) {
    return false;
  }
  const auto pivots = pivotsOf(path, pair, at);
  return std::any_of(pivots.begin(), pivots.end(), [&](const Pivot& pivot) {
    return test(Orbits(path, pair, at, min_separation, pivot));
  });
}

}  // namespace

bool nearestOrbitsApart(const Path& path, const Pair& pair, const Configuration& at,
                        double min_separation) {
  return anyOrbits(path, pair, at, min_separation,
                   [](const Orbits& orbits) { return orbits.nearestApart(); });
}

bool orbitsApart(const Path& path, const Pair& pair, const Configuration& at, double min_separation,
                 long long& cost) {
  return anyOrbits(path, pair, at, min_separation, [&cost](const Orbits& orbits) {
    return orbits.nearestApart() && orbits.allApart(cost);
  });
}

}  // namespace kios::articulated
