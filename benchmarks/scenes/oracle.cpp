// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "oracle.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace kios::scenes {
namespace {

using Box = ExactTree::Box;

/// A node's triangles are [begin, end) of its tree's. A left child is the node after its parent,
/// and what is below it stands before the right one.
struct Node {
  std::size_t index, begin, end;

  bool isLeaf() const { return end - begin == 1; }
  std::size_t middle() const { return begin + (end - begin) / 2; }
  Node left() const { return {index + 1, begin, middle()}; }
  Node right() const { return {index + 2 * (middle() - begin), middle(), end}; }
};

Node rootOf(const ExactTree& tree) { return {0, 0, tree.ids.size()}; }

/// Orders ids by halves along the longest side of the box of their centroids, and so on below.
void halve(const Node& node, const std::vector<ExactPoint>& centroids, std::vector<int>& ids) {
  if (node.isLeaf()) return;
  Box span;
  for (std::size_t i = node.begin; i < node.end; ++i) span.extend(centroids[ids[i]]);
  int axis = 0;
  span.sizes().maxCoeff(&axis);
  std::nth_element(ids.begin() + node.begin, ids.begin() + node.middle(), ids.begin() + node.end,
                   [&](int i, int j) { return centroids[i][axis] < centroids[j][axis]; });
  halve(node.left(), centroids, ids);
  halve(node.right(), centroids, ids);
}

const Box& findBox(const Node& node, ExactTree& tree) {
  Box& box = tree.boxes[node.index];
  if (node.isLeaf()) {
    box.setEmpty();
    for (const ExactPoint& p : tree.triangles[node.begin]) box.extend(p);
  } else {
    box = findBox(node.left(), tree).merged(findBox(node.right(), tree));
  }
  return box;
}

/// Branch and bound over pairs of nodes of two trees in one frame.
class PairSearch {
 public:
  PairSearch(const ExactTree& a, const ExactTree& b) : a_(a), b_(b) {
    long double scale = 0;
    for (const Box* root : {&a.boxes[0], &b.boxes[0]}) {
      scale =
          std::max({scale, root->min().cwiseAbs().maxCoeff(), root->max().cwiseAbs().maxCoeff()});
    }
    pad_ = kRelativePad * scale;
  }

  /// Calls visit(place of a triangle of A, of B) for every pair whose boxes are no farther apart
  /// than `reach` plus the pad, nearer boxes first. `reach` is read anew at each pair, so that
  /// visit may lower it; a negative one ends the search.
  template <typename Visit>
  void run(const long double& reach, const Visit& visit) const {
    visitPair(pairOf(rootOf(a_), rootOf(b_)), reach, visit);
  }

 private:
  // Far above the rounding of vertices and distances (1e-19 of the scale), far below any gap of
  // interest: a pruned pair cannot have a smaller computed distance than the one found.
  static constexpr long double kRelativePad = 1e-15L;

  struct Pair {
    Node a, b;
    long double gap;
  };
  Pair pairOf(const Node& a, const Node& b) const {
    return {a, b, a_.boxes[a.index].exteriorDistance(b_.boxes[b.index])};
  }

  template <typename Visit>
  void visitPair(const Pair& pair, const long double& reach, const Visit& visit) const {
    const auto& [a, b, gap] = pair;
    if (!(gap <= reach + pad_) || reach < 0) return;
    if (a.isLeaf() && b.isLeaf()) return visit(a.begin, b.begin);
    const bool split_a = b.isLeaf() || (!a.isLeaf() && a_.boxes[a.index].sizes().squaredNorm() >
                                                           b_.boxes[b.index].sizes().squaredNorm());
    Pair near = split_a ? pairOf(a.left(), b) : pairOf(a, b.left());
    Pair far = split_a ? pairOf(a.right(), b) : pairOf(a, b.right());
    if (far.gap < near.gap) std::swap(near, far);
    visitPair(near, reach, visit);
    visitPair(far, reach, visit);
  }

  const ExactTree &a_, &b_;
  long double pad_ = 0;
};

}  // namespace

ExactTree::ExactTree(const Mesh& mesh) : ids(mesh.triangles.size()) {
  if (ids.empty()) throw std::invalid_argument("MeshOracle: a mesh has no triangle");
  std::vector<ExactTriangle> all;
  std::vector<ExactPoint> centroids;  // three times those
  for (const fcl::Triangle& t : mesh.triangles) {
    ExactTriangle& corners = all.emplace_back();
    for (int k = 0; k < 3; ++k) corners[k] = mesh.vertices[t[k]].cast<long double>();
    centroids.emplace_back(corners[0] + corners[1] + corners[2]);
  }
  std::iota(ids.begin(), ids.end(), 0);
  halve(rootOf(*this), centroids, ids);
  for (const int id : ids) triangles.push_back(all[id]);
  boxes.resize(2 * ids.size() - 1);
  findBoxes();
}

void ExactTree::findBoxes() { findBox(rootOf(*this), *this); }

MeshOracle::MeshOracle(const Mesh& a, const Mesh& b) : a_(a), b_(b) {}

ExactTree MeshOracle::placedB(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const {
  using ExactMatrix = Eigen::Matrix<long double, 3, 3>;
  const ExactMatrix R1_transposed = X_WA.linear().transpose().cast<long double>();
  const ExactMatrix R2 = X_WB.linear().cast<long double>();
  const ExactPoint offset =
      X_WB.translation().cast<long double>() - X_WA.translation().cast<long double>();
  ExactTree placed = b_;
  for (ExactTriangle& triangle : placed.triangles) {
    for (ExactPoint& p : triangle) p = (R1_transposed * (R2 * p + offset)).eval();
  }
  placed.findBoxes();
  return placed;
}

double MeshOracle::distance(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const {
  const ExactTree b = placedB(X_WA, X_WB);
  long double best = std::numeric_limits<long double>::infinity(), reach = best;
  PairSearch(a_, b).run(reach, [&](std::size_t i, std::size_t j) {
    best = std::min(best, triangleDistance(a_.triangles[i], b.triangles[j]));
    reach = best > 0 ? best : -1;
  });
  return static_cast<double>(best);
}

bool MeshOracle::collide(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const {
  const ExactTree b = placedB(X_WA, X_WB);
  bool found = false;
  long double reach = 0;
  PairSearch(a_, b).run(reach, [&](std::size_t i, std::size_t j) {
    if (!trianglesMeet(a_.triangles[i], b.triangles[j])) return;
    found = true;
    reach = -1;
  });
  return found;
}

MeshOracle::Pairs MeshOracle::collidingPairs(const fcl::Transform3d& X_WA,
                                             const fcl::Transform3d& X_WB) const {
  const ExactTree b = placedB(X_WA, X_WB);
  Pairs pairs;
  const long double reach = 0;
  PairSearch(a_, b).run(reach, [&](std::size_t i, std::size_t j) {
    if (trianglesMeet(a_.triangles[i], b.triangles[j])) pairs.emplace_back(a_.ids[i], b.ids[j]);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

double MeshOracle::distanceBruteForce(const fcl::Transform3d& X_WA,
                                      const fcl::Transform3d& X_WB) const {
  const ExactTree placed = placedB(X_WA, X_WB);
  long double best = std::numeric_limits<long double>::infinity();
  for (const ExactTriangle& a : a_.triangles) {
    for (const ExactTriangle& b : placed.triangles) best = std::min(best, triangleDistance(a, b));
  }
  return static_cast<double>(best);
}

}  // namespace kios::scenes
