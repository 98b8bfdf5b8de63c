// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fcl_kios/triangle.h"
#include "paper/mesh_split.h"

namespace kios::paper {

/// Holds the answer and the cost of a query of two trees.
struct VariantResult {
  double distance = std::numeric_limits<double>::infinity();  ///< 0 in contact
  bool contact = false;
  int triangle_a = -1;  ///< ids that realise it; -1 where two trees are apart in collide()
  int triangle_b = -1;
  std::int64_t bv_tests = 0;
  std::int64_t leaf_tests = 0;
};

/// Holds a mesh with a volume of a policy around every node of its split. Traversal and leaf tests
/// are the same for all policies and do not look into volumes, so that counts compare the volumes
/// alone. For comparison: fcl::BVHModel<kIOSd> is what answers queries fast.
///
/// A volume policy P is a copyable class with
///   P::Shared  what a model stores once for all its volumes (directions, origin); {} if nothing
///   P::Volume  a volume
///   P::Placed  what the bounds of two models at one pose have in common
///
///   Shared share(const fcl::Vector3d* points, int n) const
///     from all vertices of a model, in its frame
///   Volume fit(const fcl::Vector3d* points, int n, const Shared&) const
///     a volume around some of them; empty for n = 0. Throws std::invalid_argument if a coordinate
///     is NaN, infinite or above 2^1000 in magnitude.
///   Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const
///     X_AB must outlive the result.
///   double separation(const Volume& a, const Volume& b, const Placed&, double enough) const
///     signed lower bound of the distance of the contents, a's in frame A, b's moved by X_AB as
///     given and also as X_AB * p rounds: > 0 proves them apart, +infinity if one is empty. Any
///     value above `enough` may be returned as soon as it is proven.
template <typename Policy>
class VariantTree {
 public:
  /// Fits all volumes. Throws what the policy's fit throws.
  explicit VariantTree(std::shared_ptr<const MeshSplit> split, Policy policy = Policy())
      : split_(std::move(split)), policy_(std::move(policy)) {
    const std::vector<fcl::Vector3d> all = split_->points(split_->nodes()[0]);
    shared_ = policy_.share(all.data(), static_cast<int>(all.size()));
    volumes_.reserve(split_->nodes().size());
    for (const MeshSplit::Node& node : split_->nodes()) {
      const std::vector<fcl::Vector3d> points = split_->points(node);
      volumes_.push_back(policy_.fit(points.data(), static_cast<int>(points.size()), shared_));
    }
  }

  const MeshSplit& split() const { return *split_; }
  const Policy& policy() const { return policy_; }
  const typename Policy::Shared& shared() const { return shared_; }
  const std::vector<typename Policy::Volume>& volumes() const { return volumes_; }

  /// Returns the exact distance to b at X_AB: that of the triangles with b's vertices moved by X_AB
  /// * p.
  VariantResult distance(const VariantTree& b, const RelativePose<double>& X_AB) const {
    Query query(*this, b, X_AB);
    query.leafDistance(0, 0);
    query.nearest(0, 0);
    return query.result;
  }

  /// Stops at the first pair of triangles that meets. The distance of the result is then 0,
  /// otherwise infinite.
  VariantResult collide(const VariantTree& b, const RelativePose<double>& X_AB) const {
    Query query(*this, b, X_AB);
    if (!query.apart(0, 0)) query.findContact(0, 0);
    return query.result;
  }

 private:
  struct Query {
    Query(const VariantTree& tree_a, const VariantTree& tree_b, const RelativePose<double>& X_AB)
        : a(tree_a), b(tree_b), X(X_AB), placed(a.policy_.place(a.shared_, b.shared_, X_AB)) {}

    double bound(int i, int j, double enough) {
      ++result.bv_tests;
      return a.policy_.separation(a.volumes_[i], b.volumes_[j], placed, enough);
    }
    bool apart(int i, int j) { return bound(i, j, 0) > 0; }

    TriangleVertices<double> cornersOfB(int place) const {
      TriangleVertices<double> t = b.split_->corners(b.split_->triangle(place));
      for (Point<double>& p : t) p = X * p;
      return t;
    }
    void leafDistance(int place_a, int place_b) {
      ++result.leaf_tests;
      const int id_a = a.split_->triangle(place_a);
      const double d = triangleDistance(a.split_->corners(id_a), cornersOfB(place_b)).distance;
      if (!(d < result.distance)) return;
      result.distance = d;
      result.contact = d == 0;
      result.triangle_a = id_a;
      result.triangle_b = b.split_->triangle(place_b);
    }

    /// The two pairs below (i, j): children of the larger node, or of the one that has any.
    template <typename Visit>
    void descend(int i, int j, Visit visit) {
      const MeshSplit::Node &m = a.split_->nodes()[i], &n = b.split_->nodes()[j];
      if (n.leaf() || (!m.leaf() && m.extent > n.extent)) {
        visit(m.left, j, m.left + 1, j);
      } else {
        visit(i, n.left, i, n.left + 1);
      }
    }
    bool leaves(int i, int j) const {
      return a.split_->nodes()[i].leaf() && b.split_->nodes()[j].leaf();
    }

    void nearest(int i, int j) {
      if (leaves(i, j)) {
        leafDistance(a.split_->nodes()[i].first, b.split_->nodes()[j].first);
        return;
      }
      descend(i, j, [this](int i0, int j0, int i1, int j1) {
        double d0 = bound(i0, j0, result.distance), d1 = bound(i1, j1, result.distance);
        if (d1 < d0) {
          std::swap(d0, d1);
          std::swap(i0, i1);
          std::swap(j0, j1);
        }
        if (d0 < result.distance) nearest(i0, j0);
        if (d1 < result.distance) nearest(i1, j1);
      });
    }

    void findContact(int i, int j) {
      if (leaves(i, j)) {
        ++result.leaf_tests;
        const int place_a = a.split_->nodes()[i].first, place_b = b.split_->nodes()[j].first;
        const int id_a = a.split_->triangle(place_a);
        if (!trianglesIntersect(a.split_->corners(id_a), cornersOfB(place_b))) return;
        result.distance = 0;
        result.contact = true;
        result.triangle_a = id_a;
        result.triangle_b = b.split_->triangle(place_b);
        return;
      }
      descend(i, j, [this](int i0, int j0, int i1, int j1) {
        if (!apart(i0, j0)) findContact(i0, j0);
        if (!result.contact && !apart(i1, j1)) findContact(i1, j1);
      });
    }

    const VariantTree &a, &b;
    const RelativePose<double>& X;
    const typename Policy::Placed placed;
    VariantResult result;
  };

  std::shared_ptr<const MeshSplit> split_;
  Policy policy_;
  typename Policy::Shared shared_;
  std::vector<typename Policy::Volume> volumes_;
};

}  // namespace kios::paper
