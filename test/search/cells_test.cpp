// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The contacts of an octree and a mesh are those that the exact test finds for all cells and all
// triangles: in touching configurations that leave nothing but the pads of float bounds, far from
// the origin, at any scale, with degenerate triangles; prepared, not prepared, and by FCL's tree in
// double.

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "fcl_kios/contact.h"
#include "fcl_kios/model.h"
#include "model/prepared.h"
#include "query/cell_tree.h"
#include "query/posed_solid.h"
#include "scenes/foreign_fitter.h"
#include "scenes/mesh.h"
#include "shape/triangle_shape.h"
#include "shapes.h"

namespace kios::testing {
namespace {

using CellTriangle = std::pair<std::intptr_t, int>;
using Pairs = std::set<CellTriangle>;

constexpr float kOccupied = 2, kUncertain = 0.5F, kFree = -1;

/// Returns an octree of which cells about a place are set: full blocks that merge, shells, single
/// ones.
std::shared_ptr<octomap::OcTree> makeTree(double resolution, const Eigen::Vector3i& place,
                                          Random& random) {
  auto tree = std::make_shared<octomap::OcTree>(resolution);
  const auto set = [&](int x, int y, int z, float value) {
    const auto key = [&](int axis, int at) {
      return static_cast<octomap::key_type>(32768 + place[axis] + at);
    };
    tree->setNodeValue(octomap::OcTreeKey(key(0, x), key(1, y), key(2, z)), value, true);
  };
  const auto any = [&](int most) { return static_cast<int>(random.uniform(-most, most)); };
  for (int i = 0; i < 64; ++i) set(i % 4, i / 4 % 4, i / 16, kOccupied);
  for (int x = -6; x < 6; ++x) {
    for (int y = -6; y < 6; ++y) set(x, y, -5, kOccupied);
  }
  for (int i = 0; i < 150; ++i) {
    const double kind = random.unit();
    set(any(8), any(8), any(8), kind < 0.7 ? kOccupied : kind < 0.85 ? kUncertain : kFree);
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

template <typename S>
void bruteForce(const fcl::OcTree<S>& octree, const octomap::OcTreeNode* node,
                const engine::Cell& cell, const Model<S>& model, const PosedSolid& posed,
                Pairs& found) {
  if (octree.nodeHasChildren(node)) {
    for (unsigned int i = 0; i < 8; ++i) {
      if (!octree.nodeChildExists(node, i)) continue;
      bruteForce(octree, octree.getNodeChild(node, i), cell.child(i, nullptr, false), model, posed,
                 found);
    }
    return;
  }
  if (!octree.isNodeOccupied(node)) return;
  const double unit = posed.solid().half.x() / engine::kRootHalf;
  shape::Solid solid;
  solid.kind = shape::Kind::kBox;
  const shape::Vec center = unit * shape::Vec(cell.x, cell.y, cell.z);
  solid.half.setConstant(unit * cell.half);
  for (int id = 0; id < model.num_tris; ++id) {
    shape::Triangle t = posed.place(cornersInDouble(model, id));
    for (shape::Vec& p : t) p -= center;
    if (shape::intersects(solid, t)) found.emplace(node - octree.getRoot(), id);
  }
}

template <typename S>
Pairs contacts(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO, const Model<S>& model,
               const fcl::Transform3<S>& X_WM, std::size_t most, bool costs = false) {
  fcl::CollisionResult<S> result;
  const fcl::CollisionRequest<S> request(most, false, 1, costs, false);
  collideOctree(octree, X_WO, model, X_WM, request, result);
  Pairs found;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    EXPECT_TRUE(found.emplace(contact.b1, static_cast<int>(contact.b2)).second);
  }
  return found;
}

/// Returns needles along the axes, whose spheres have no slack at the ends: these lie on the grid,
/// near the cells and up to 1000 cells away.
Mesh longNeedles() {
  Mesh mesh;
  Random random(5);
  const auto whole = [&](double most) { return std::floor(random.uniform(-most, most)); };
  for (int i = 0; i < 60; ++i) {
    fcl::Vector3d a(whole(6), whole(6), whole(6)), b = a;
    b[i % 3] += i % 2 == 0 ? whole(1000) : whole(10);
    addTriangle(mesh, a, b, i % 4 == 0 ? a : fcl::Vector3d(0.5 * (a + b)));
  }
  return mesh;
}

/// Returns meshes in units of cells: in general position, and with faces, edges and corners on the
/// grid.
std::vector<NamedMesh> cases() {
  Mesh on_grid = transformed(scenes::subdividedBox({6, 6, 6}, 6), 1, {1, 0, 2});
  return {{"torus", transformed(scenes::bumpyTorus(200), 3, {0, 0, 0})},
          {"grid", on_grid},
          {"sheet on the grid", scenes::sheet(12, 12, 9, 7, 0)},
          {"soup", scenes::randomSoup(60, 4, 1e-2, 20, 3)},
          {"small", transformed(scenes::icosphere(1, 1), 0.3, {0.2, 0.1, 0.4})},
          {"large triangles", transformed(scenes::icosphere(1, 0), 30, {0, 25, 0})},
          {"large on the grid", rounded(scenes::randomSoup(60, 8, 1, 1000, 4), 1)},
          {"long needles", longNeedles()},
          {"degenerate", transformed(degenerateMesh(60, 3, 8), 4, {0, 0, 0})}};
}

template <typename S>
class Cells : public ::testing::Test {
 protected:
  static constexpr bool kDouble = std::is_same_v<S, double>;

  /// `place` of the cells in the octree, in cells; `world` is where both are, in cells.
  static void compare(double resolution, const Eigen::Vector3i& place, double world,
                      std::uint64_t seed) {
    SCOPED_TRACE("resolution 10^" + std::to_string(std::log10(resolution)));
    Random random(seed);
    const auto tree = makeTree(resolution, place, random);
    const fcl::OcTree<S> octree(tree);
    const fcl::Vector3d middle = resolution * place.cast<double>();
    long found = 0, asked = 0;
    for (const NamedMesh& named : cases()) {
      SCOPED_TRACE(named.name);
      // A frame of its own, not at the middle.
      const Mesh mesh = transformed(named.mesh, resolution, resolution * inCube(random));
      const fcl::Vector3d shift = (resolution * named.mesh.vertices[0] - mesh.vertices[0]);
      const auto prepared = scenes::buildModel<kIOS<S>>(mesh);
      prepare(*prepared);
      const auto foreign =
          scenes::buildModel<kIOS<S>>(mesh, std::make_shared<scenes::ForeignFitter<kIOS<S>>>());
      for (int i = 0; i < 12; ++i) {
        fcl::Transform3d X_WO = fcl::Transform3d::Identity(), X_OM = X_WO;
        if (i % 2 == 1) X_WO = wholePose(random, 3);
        X_WO.translation() += world * resolution * inCube(random);
        if (i < 6) {  // on the grid, or half a cell off
          for (int c = 0; c < 3; ++c) {
            X_OM.translation()[c] = 0.5 * resolution * std::floor(random.uniform(-4, 4));
          }
          X_OM.translation() += shift;
        } else {
          X_OM = wholePose(random, 1);
          X_OM.translation() = 3 * resolution * inCube(random);
        }
        X_OM.translation() += middle;
        const fcl::Transform3<S> X_WOs(X_WO.cast<S>()), X_WM((X_WO * X_OM).cast<S>());
        const PosedSolid posed(rootCube(octree), X_WM, X_WOs, meshOf(*prepared));
        Pairs expected;
        bruteForce(octree, octree.getRoot(), {nullptr, 0, 0, 0, engine::kRootHalf, 0}, *prepared,
                   posed, expected);
        const auto fresh = scenes::buildModel<kIOS<S>>(transformed(mesh, 1 + 1e-14, {0, 0, 0}));
        EXPECT_EQ(contacts(octree, X_WOs, *prepared, X_WM, 1000000), expected);
        EXPECT_EQ(contacts(octree, X_WOs, *foreign, X_WM, 1000000), expected);
        EXPECT_EQ(contacts(octree, X_WOs, *prepared, X_WM, 1000000, true), expected);
        for (const std::size_t most : {1, 3}) {
          for (const auto& model : {prepared, foreign}) {
            const Pairs few = contacts(octree, X_WOs, *model, X_WM, most);
            EXPECT_EQ(few.size(), std::min(most, expected.size()));
            for (const CellTriangle& pair : few) EXPECT_EQ(expected.count(pair), 1u);
          }
        }
        const bool touch = !contacts(octree, X_WOs, *fresh, X_WM, 1).empty();
        if (!kDouble) {  // the same floats
          EXPECT_EQ(touch, !expected.empty());
        }
        found += static_cast<long>(expected.size());
        ++asked;
      }
    }
    EXPECT_GT(found, 5 * asked);
  }
};
using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(Cells, Scalars);

TYPED_TEST(Cells, EqualBruteForceAtTheOrigin) {
  for (const std::uint64_t seed : {1, 2, 3}) this->compare(0.1, {0, 0, 0}, 0, seed);
}

TYPED_TEST(Cells, EqualBruteForceFarFromTheOctreesOrigin) {
  this->compare(0.05, {700, -1300, 41}, 0, 4);
  this->compare(0.1, {-32000, 31000, 15000}, 0, 5);
  this->compare(0.1, {-32760, 32760, 16384}, 0, 6);  // at the border of the octree
}

TYPED_TEST(Cells, EqualBruteForceFarFromTheWorldsOrigin) {
  this->compare(0.1, {5, -7, 3}, 1e3, 7);
  if (!this->kDouble) return;
  this->compare(0.1, {5, -7, 3}, 1e7, 8);
  this->compare(1, {500, -70, 30}, 0x1p30, 9);
}

TYPED_TEST(Cells, EqualBruteForceAtAnyScale) {
  std::uint64_t seed = 10;
  for (const double resolution : {1e-9, 1e-6, 3e-3, 7e2, 1e6, 1e9}) {
    this->compare(resolution, {20, -30, 10}, 0, ++seed);
  }
  if (!this->kDouble) return;
  // Beyond the range of floats, and in units of a power of two.
  for (const double resolution : {1e-80, 1e-40, 1e40, 1e80}) {
    this->compare(resolution, {20, -30, 10}, 0, ++seed);
  }
}

}  // namespace
}  // namespace kios::testing
