// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A preparation reads the trees of some models and divides the others anew.

#include <gtest/gtest.h>

#include <cstring>

#include "fcl_kios/fcl_kios.h"
#include "fcl_kios/paper.h"
#include "model/prepared.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

// Queries read the model's tree only where it is the one that they would make: another splitter's,
// another fit's or a refitted one is not.
TEST(ReadTree, QueriesKnowWhichTreesTheyMayRead) {
  const scenes::Mesh mesh = scenes::bumpyTorus(300);
  const auto isRead = [](const Modeld& model) { return preparedOf(model).ordinary; };
  Modeld model, by_mean, published;
  by_mean.bv_splitter.reset(new fcl::detail::BVSplitter<kIOSd>(fcl::detail::SPLIT_METHOD_MEAN));
  published.bv_fitter.reset(new PaperFitter<double>(FitMethod::kMethodII));
  for (Modeld* const m : {&model, &by_mean, &published}) {
    ASSERT_EQ(m->beginModel(), fcl::BVH_OK);
    ASSERT_EQ(m->addSubModel(mesh.vertices, mesh.triangles), fcl::BVH_OK);
    ASSERT_EQ(m->endModel(), fcl::BVH_OK);
  }
  EXPECT_TRUE(isRead(model));
  EXPECT_FALSE(isRead(by_mean));
  EXPECT_FALSE(isRead(published));
  Modeld copy(model);
  EXPECT_TRUE(isRead(copy));
  for (const bool bottom_up : {false, true}) {
    ASSERT_EQ(copy.beginReplaceModel(), fcl::BVH_OK);
    ASSERT_EQ(copy.replaceSubModel(mesh.vertices), fcl::BVH_OK);
    ASSERT_EQ(copy.endReplaceModel(true, bottom_up), fcl::BVH_OK);
    EXPECT_FALSE(isRead(copy));
  }
  EXPECT_TRUE(isRead(model));
  // All of them prepare the same tree, as it depends on the mesh alone.
  const engine::Tree *const tree = &treeOf(model), *const other = &treeOf(by_mean);
  EXPECT_EQ(tree->bytes(), other->bytes());
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  EXPECT_TRUE(same(tree->nodes, other->nodes) && same(tree->lanes, other->lanes) &&
              same(tree->features, other->features));
}

}  // namespace
}  // namespace kios::testing
