// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "oracle.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace kios::scenes {
namespace {

using ExactMatrix = Eigen::Matrix<long double, 3, 3>;

std::vector<ExactTriangle> exactTriangles(const Mesh& mesh, const char* name) {
  if (mesh.triangles.empty()) {
    throw std::invalid_argument(std::string("MeshOracle: mesh ") + name + " has no triangle");
  }
  std::vector<ExactTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const fcl::Triangle& t : mesh.triangles) {
    triangles.push_back({mesh.vertices[t[0]].cast<long double>(),
                         mesh.vertices[t[1]].cast<long double>(),
                         mesh.vertices[t[2]].cast<long double>()});
  }
  return triangles;
}

// Branch and bound over pairs of nodes of two trees whose boxes lie in one frame.
class PairSearch {
 public:
  PairSearch(const AabbTree& tree_a, const std::vector<ExactBox>& boxes_a, const AabbTree& tree_b,
             const std::vector<ExactBox>& boxes_b)
      : nodes_a_(tree_a.nodes()), boxes_a_(boxes_a), nodes_b_(tree_b.nodes()), boxes_b_(boxes_b) {
    long double scale = 0;
    for (const ExactBox* root : {&boxes_a.front(), &boxes_b.front()}) {
      scale =
          std::max({scale, root->lower.cwiseAbs().maxCoeff(), root->upper.cwiseAbs().maxCoeff()});
    }
    pad_ = kRelativePad * scale;
  }

  // Calls visit(triangle of A, triangle of B) for every pair whose boxes are no farther apart than
  // `reach` plus the pad, nearer boxes first. `reach` is read anew at each pair, so that visit may
  // lower it; a negative one ends the search.
  template <typename Visit>
  void run(const long double& reach, const Visit& visit) const {
    visitPair(0, 0, boxDistance(boxes_a_[0], boxes_b_[0]), reach, visit);
  }

 private:
  // Far above the rounding of vertices and distances (1e-19 of the scale), far below any gap of
  // interest: a pruned pair cannot have a smaller computed distance than the one found.
  static constexpr long double kRelativePad = 1e-15L;

  template <typename Visit>
  void visitPair(int a, int b, long double gap, const long double& reach,
                 const Visit& visit) const {
    if (!(gap <= reach + pad_) || reach < 0) return;
    const AabbTree::Node& node_a = nodes_a_[a];
    const AabbTree::Node& node_b = nodes_b_[b];
    if (node_a.triangle >= 0 && node_b.triangle >= 0) {
      visit(node_a.triangle, node_b.triangle);
      return;
    }
    const bool split_a = node_b.triangle >= 0 ||
                         (node_a.triangle < 0 && diagonal(boxes_a_[a]) > diagonal(boxes_b_[b]));
    int first_a = split_a ? node_a.left : a;
    int first_b = split_a ? b : node_b.left;
    int second_a = split_a ? node_a.left + 1 : a;
    int second_b = split_a ? b : node_b.left + 1;
    long double first_gap = boxDistance(boxes_a_[first_a], boxes_b_[first_b]);
    long double second_gap = boxDistance(boxes_a_[second_a], boxes_b_[second_b]);
    if (second_gap < first_gap) {
      std::swap(first_a, second_a);
      std::swap(first_b, second_b);
      std::swap(first_gap, second_gap);
    }
    visitPair(first_a, first_b, first_gap, reach, visit);
    visitPair(second_a, second_b, second_gap, reach, visit);
  }

  static long double diagonal(const ExactBox& box) { return (box.upper - box.lower).squaredNorm(); }

  const std::vector<AabbTree::Node>& nodes_a_;
  const std::vector<ExactBox>& boxes_a_;
  const std::vector<AabbTree::Node>& nodes_b_;
  const std::vector<ExactBox>& boxes_b_;
  long double pad_ = 0;
};

}  // namespace

MeshOracle::MeshOracle(const Mesh& a, const Mesh& b)
    : triangles_a_(exactTriangles(a, "A")),
      triangles_b_(exactTriangles(b, "B")),
      tree_a_(triangles_a_),
      tree_b_(triangles_b_),
      boxes_a_(tree_a_.boxes(triangles_a_)) {}

std::vector<ExactTriangle> MeshOracle::placeB(const fcl::Transform3d& X_WA,
                                              const fcl::Transform3d& X_WB) const {
  const ExactMatrix R1_transposed = X_WA.linear().transpose().cast<long double>();
  const ExactMatrix R2 = X_WB.linear().cast<long double>();
  const ExactPoint offset =
      X_WB.translation().cast<long double>() - X_WA.translation().cast<long double>();
  std::vector<ExactTriangle> placed = triangles_b_;
  for (ExactTriangle& triangle : placed) {
    for (ExactPoint& p : triangle) p = (R1_transposed * (R2 * p + offset)).eval();
  }
  return placed;
}

double MeshOracle::distance(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const {
  const std::vector<ExactTriangle> placed = placeB(X_WA, X_WB);
  const std::vector<ExactBox> boxes_b = tree_b_.boxes(placed);
  long double best = std::numeric_limits<long double>::infinity();
  const PairSearch search(tree_a_, boxes_a_, tree_b_, boxes_b);
  long double reach = best;
  search.run(reach, [&](int i, int j) {
    best = std::min(best, triangleDistance(triangles_a_[i], placed[j]));
    reach = best > 0 ? best : -1;
  });
  return static_cast<double>(best);
}

bool MeshOracle::collide(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const {
  const std::vector<ExactTriangle> placed = placeB(X_WA, X_WB);
  const std::vector<ExactBox> boxes_b = tree_b_.boxes(placed);
  bool found = false;
  long double reach = 0;
  PairSearch(tree_a_, boxes_a_, tree_b_, boxes_b).run(reach, [&](int i, int j) {
    if (!trianglesMeet(triangles_a_[i], placed[j])) return;
    found = true;
    reach = -1;
  });
  return found;
}

MeshOracle::Pairs MeshOracle::collidingPairs(const fcl::Transform3d& X_WA,
                                             const fcl::Transform3d& X_WB) const {
  const std::vector<ExactTriangle> placed = placeB(X_WA, X_WB);
  const std::vector<ExactBox> boxes_b = tree_b_.boxes(placed);
  Pairs pairs;
  const long double reach = 0;
  PairSearch(tree_a_, boxes_a_, tree_b_, boxes_b).run(reach, [&](int i, int j) {
    if (trianglesMeet(triangles_a_[i], placed[j])) pairs.emplace_back(i, j);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

double MeshOracle::distanceBruteForce(const fcl::Transform3d& X_WA,
                                      const fcl::Transform3d& X_WB) const {
  const std::vector<ExactTriangle> placed = placeB(X_WA, X_WB);
  long double best = std::numeric_limits<long double>::infinity();
  for (const ExactTriangle& a : triangles_a_) {
    for (const ExactTriangle& b : placed) best = std::min(best, triangleDistance(a, b));
  }
  return static_cast<double>(best);
}

}  // namespace kios::scenes
