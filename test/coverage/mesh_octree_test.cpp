// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mesh against octree, both orders, over any volume, against brute force over triangles and cells.

#include <set>

#include <fcl/geometry/octree/octree.h>

#include "coverage/shape_distance.h"
#include "coverage/tally.h"
#include "fcl/mesh_cases.h"
#include "scenes/random.h"

namespace kios::coverage {
namespace {

using testing::Frame;

struct Cell {
  Vector3d centre;
  double half;
};

// Cells that are occupied, single ones and a block that octomap prunes to a coarse cell.
std::shared_ptr<octomap::OcTree> randomTree(std::uint64_t seed) {
  auto tree = std::make_shared<octomap::OcTree>(0.125);
  scenes::Random random(seed);
  const auto occupy = [&](double x, double y, double z) {
    // Often enough that the cell is occupied beyond doubt.
    for (int i = 0; i < 8; ++i) tree->updateNode(octomap::point3d(x, y, z), true);
  };
  for (int i = 0; i < 30; ++i) {
    occupy(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }
  for (int i = 0; i < 64; ++i) {
    occupy(0.0625 + 0.125 * (i & 3), 0.0625 + 0.125 * (i >> 2 & 3), 0.0625 + 0.125 * (i >> 4));
  }
  for (int i = 0; i < 30; ++i) {  // free cells hit nothing
    tree->updateNode(octomap::point3d(random.uniform(1.5, 2), random.uniform(1.5, 2), 1), false);
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

std::vector<Cell> cellsOf(const octomap::OcTree& tree) {
  std::vector<Cell> cells;
  for (auto it = tree.begin_leafs(); it != tree.end_leafs(); ++it) {
    if (!tree.isNodeOccupied(*it)) continue;
    cells.push_back({Vector3d(it.getX(), it.getY(), it.getZ()), 0.5 * it.getSize()});
  }
  return cells;
}

double cellDistance(const Vector3d& p, const Cell& cell) {
  return ((p - cell.centre).cwiseAbs() - Vector3d::Constant(cell.half)).cwiseMax(0.0).norm();
}

template <typename BV>
class MeshOctree : public ::testing::Test {};
TYPED_TEST_SUITE(MeshOctree, Volumes);

TYPED_TEST(MeshOctree, BruteForce) {
  using S = typename TypeParam::S;
  const scenes::Mesh mesh = rounded<S>(scenes::icosphere(0.5, 1));
  const auto model = scenes::buildModel<TypeParam>(mesh);
  const auto tree = randomTree(501);
  const std::vector<Cell> cells = cellsOf(*tree);
  const fcl::OcTree<S> octree(tree);
  const double margin = 1e-6 + tolerance<S>(8);
  bool any_hit = false, any_miss = false;
  for (Frame frame : testing::randomFrames(30, 1.8, 502)) {
    frame = {rounded<S>(frame.X_WA), rounded<S>(frame.X_WB)};
    const fcl::Transform3d X = frame.X_WB.inverse(Eigen::Isometry) * frame.X_WA;
    double exact = 1e300;
    std::set<int> surely, possibly;
    for (int i = 0; i < model->num_tris; ++i) {
      auto t = testing::corners(mesh, i);
      for (Vector3d& p : t) p = X * p;
      for (const Cell& cell : cells) {
        const auto distance = [&](const Vector3d& p) { return cellDistance(p, cell); };
        const double d = triangleShapeDistance(t, distance, std::max(exact, margin));
        exact = std::min(exact, d);
        if (d <= margin) possibly.insert(i);
        const Cell inner{cell.centre, cell.half - margin};
        for (const Vector3d& p : {t[0], t[1], t[2], Vector3d((t[0] + t[1] + t[2]) / 3)}) {
          if (cellDistance(p, inner) == 0) surely.insert(i);
        }
      }
    }
    any_hit = any_hit || !surely.empty();
    any_miss = any_miss || possibly.empty();
    for (const bool mesh_first : {true, false}) {
      const fcl::CollisionGeometry<S>*g1 = model.get(), *g2 = &octree;
      fcl::Transform3<S> X1 = frame.X_WA.cast<S>(), X2 = frame.X_WB.cast<S>();
      if (!mesh_first) std::swap(g1, g2), std::swap(X1, X2);
      const std::string order = mesh_first ? "mesh, octree" : "octree, mesh";

      const fcl::CollisionRequest<S> request(testing::kAllContacts);
      fcl::CollisionResult<S> contacts, first;
      fcl::collide(g1, X1, g2, X2, request, contacts);
      std::set<int> hit;
      for (std::size_t i = 0; i < contacts.numContacts(); ++i) {
        const auto& contact = contacts.getContact(i);
        hit.insert(static_cast<int>(contact.o1 == model.get() ? contact.b1 : contact.b2));
      }
      check<TypeParam>(order + " contacts",
                       std::includes(hit.begin(), hit.end(), surely.begin(), surely.end()) &&
                           std::includes(possibly.begin(), possibly.end(), hit.begin(), hit.end()));
      const fcl::CollisionRequest<S> one;
      const bool collides = fcl::collide(g1, X1, g2, X2, one, first) > 0;
      check<TypeParam>(order + " verdict", collides ? !possibly.empty() : surely.empty());

      const fcl::DistanceRequest<S> ask(true);
      fcl::DistanceResult<S> result;
      const double d = fcl::distance(g1, X1, g2, X2, ask, result);
      check<TypeParam>(
          order + " distance",
          exact <= margin ? d <= 2 * margin && std::isfinite(d) : std::abs(d - exact) <= margin,
          std::to_string(d) + " for " + std::to_string(exact));
    }
  }
  EXPECT_TRUE(any_hit && any_miss);
}

}  // namespace
}  // namespace kios::coverage
