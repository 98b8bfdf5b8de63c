// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A stored model brings its prepared tree, which is the one that prepare() would make, and lives on
// as any other. Altered bytes: altered_storage_test.cpp.

#include <gtest/gtest.h>

#include "fcl_kios/model/prepare.h"
#include "model/deform.h"
#include "model/prepared.h"
#include "model/stored_file.h"
#include "scalars.h"
#include "shapes.h"
#include "tree/adopt.h"
#include "tree/prepare.h"

namespace kios::testing {
namespace {

using engine::Tree;

template <typename Array>
bool same(const Array& a, const Array& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(static_cast<const void*>(a.data()),
                                                           static_cast<const void*>(b.data()),
                                                           a.size() * sizeof(a[0])) == 0);
}

void expectSame(const Tree& a, const Tree& b) {
  EXPECT_TRUE(std::equal(a.origin, a.origin + 3, b.origin));
  EXPECT_EQ(a.reach, b.reach);
  EXPECT_EQ(a.mean_leaf, b.mean_leaf);
  EXPECT_EQ(a.widest_leaf, b.widest_leaf);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_TRUE(a.indices == b.indices);
  EXPECT_EQ(std::memcmp(&a.root_box, &b.root_box, sizeof(a.root_box)), 0);
  EXPECT_TRUE(same(a.nodes, b.nodes));
  EXPECT_TRUE(same(a.boxes, b.boxes));
  EXPECT_TRUE(same(a.blocks, b.blocks));
  EXPECT_TRUE(same(a.box_blocks, b.box_blocks));
  EXPECT_TRUE(same(a.children, b.children));
  EXPECT_TRUE(same(a.leaves, b.leaves));
  EXPECT_TRUE(same(a.lanes, b.lanes));
  EXPECT_TRUE(same(a.features, b.features));
  EXPECT_TRUE(same(a.corners, b.corners));
}

KIOS_SCALAR_SUITE(StoredPrepared);

TYPED_TEST(StoredPrepared, IsTheTreeOfPrepare) {
  using S = TypeParam;
  int prepared = 0, with_boxes = 0, welded = 0, all = 0;
  for (const NamedMesh& named : allMeshes<S>()) {
    SCOPED_TRACE(named.name);
    const MeshIn<S> mesh(named.mesh);
    const auto bytes = save(*makeModel<S>(mesh.vertices, mesh.triangles));
    const std::shared_ptr<Model<S>> model = load<S>(bytes.data(), bytes.size());
    ++all;
    const bool is_prepared = preparedBytes(*model) > 0;
    EXPECT_EQ(StoredFile<S>(bytes).header.hasPrepared(), is_prepared);
    const auto tree = preparedTree(*model);
    ASSERT_EQ(bool(tree), is_prepared);
    if (!is_prepared) continue;
    ++prepared;
    with_boxes += tree->boxes.empty() ? 0 : 1;
    welded += tree->corners.empty() ? 0 : 1;
    expectSame(*tree, *engine::prepare(viewOf(*model)));
    EXPECT_EQ(save(*model), bytes);
  }
  EXPECT_GT(prepared, all / 2);
  EXPECT_GE(with_boxes, 2);
  EXPECT_GE(welded, 2);
}

TEST(StoredPrepared, EqualContentIsHeldOnce) {
  const auto model = kiosModel(scenes::bumpyTorus(300));
  const auto bytes = save(*model);
  EXPECT_GT(preparedBytes(*model), 0U) << "save() prepares the model, too";
  const auto one = load(bytes.data(), bytes.size()), two = load(bytes.data(), bytes.size());
  EXPECT_EQ(&*preparedTree(*one), &*preparedTree(*model));
  EXPECT_EQ(&*preparedTree(*two), &*preparedTree(*model));
}

TEST(StoredPrepared, LaterModelsTakeTheLoadedTree) {
  const Mesh mesh = scenes::bumpyTorus(300);
  const auto bytes = save(*kiosModel(mesh));
  const auto loaded = load(bytes.data(), bytes.size());
  const auto later = kiosModel(mesh);
  EXPECT_EQ(&*preparedTree(*later), &*preparedTree(*loaded));
}

// What is stored depends on the mesh alone, not on a tree that was refitted.
TEST(StoredPrepared, IsNoRefittedTree) {
  const Mesh mesh = scenes::bumpyTorus(300);
  const Mesh moved = {swayed(mesh, 1), mesh.triangles};
  const auto fresh = save(*kiosModel(moved));
  for (const bool refit : {true, false}) {
    const auto model = kiosModel(mesh);
    prepare(*model);
    replace(*model, moved.vertices, refit, false);
    prepare(*model);  // of the earlier state's tree
    EXPECT_EQ(save(*model), fresh);
  }
}

// Deformed, copied or made right, a loaded model answers as one that was built.
TEST(StoredPrepared, ChangesAsAnyOther) {
  const Mesh mesh = scenes::bumpyTorus(300), other_mesh = scenes::icosphere(0.5, 1);
  const auto other = kiosModel(other_mesh);
  const auto bytes = save(*kiosModel(mesh));
  const std::vector<Frame> frames = randomFrames(20, 1.5, 17);
  const auto ask = [&](const Modeld& model) {
    std::vector<double> found;
    for (const Frame& frame : frames) {
      found.push_back(distance(model, frame.X_WA, *other, frame.X_WB).distance);
    }
    return found;
  };
  const auto model = load(bytes.data(), bytes.size());
  const auto copy = std::make_shared<Modeld>(*model);
  const std::vector<double> before = ask(*kiosModel(mesh));
  EXPECT_EQ(ask(*copy), before);
  double phase = 0;
  for (const auto change : {&replace, &update}) {
    for (const bool refit : {true, false}) {
      const std::vector<Vector3d> moved = swayed(mesh, ++phase);
      change(*model, moved, refit, false);
      // What FCL updated keeps its previous vertices in its volumes, not in its answers.
      EXPECT_EQ(ask(*model), ask(*kiosModel({moved, mesh.triangles})));
      EXPECT_EQ(ask(*copy), before);
    }
  }
  const std::vector<Vector3d> moved = swayed(mesh, ++phase);
  std::copy(moved.begin(), moved.end(), copy->vertices);
  invalidate(*copy);
  EXPECT_EQ(ask(*copy), ask(*kiosModel({moved, mesh.triangles})));
}

TEST(StoredPrepared, MissesInFilesOfVersion1) {
  const Mesh mesh = scenes::bumpyTorus(300);
  StoredFile<> file(save(*kiosModel(mesh)));
  const auto bytes = file.bytes;
  file.toVersion1();
  EXPECT_LT(file.bytes.size(), bytes.size());
  const auto model = file.load();
  EXPECT_EQ(preparedBytes(*model), 0U);
  EXPECT_EQ(save(*model), bytes);
  // A file of version 1 has no counts of what it doesn't hold.
  file.put(offsetof(stored::Header, num_lanes), 1U);
  file.repairHash();
  EXPECT_THROW(file.load(), std::invalid_argument);
}

// A mesh too large or too small for the kernels' floats has no tree to store.
TEST(StoredPrepared, MissesWhereThereIsNone) {
  for (const double scale : {0x1p50, 0x1p-50}) {
    Mesh mesh = scenes::bumpyTorus(300);
    for (Vector3d& p : mesh.vertices) p *= scale;
    const StoredFile<> file(save(*kiosModel(mesh)));
    EXPECT_FALSE(file.header.hasPrepared());
    EXPECT_NE(file.header.num_nodes, 0U);
    EXPECT_EQ(preparedBytes(*file.load()), 0U);
  }
}

}  // namespace
}  // namespace kios::testing
