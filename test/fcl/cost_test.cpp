// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost sources and occupancy: the reports of fcl::collide about meshes and shapes that are free,
// uncertain or occupied; for two meshes against OBBRSS models of the same meshes.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "shape/shape_oracle.h"

namespace kios::testing {
namespace {

using ObbrssModel = fcl::BVHModel<fcl::OBBRSSd>;

enum class Occupancy { kFree, kUncertain, kOccupied };

constexpr Occupancy kAllOccupancies[] = {Occupancy::kFree, Occupancy::kUncertain,
                                         Occupancy::kOccupied};

void setOccupancy(fcl::CollisionGeometryd& geometry, Occupancy occupancy) {
  geometry.threshold_free = 0.25;
  geometry.threshold_occupied = 0.75;
  geometry.cost_density = occupancy == Occupancy::kFree ? 0.125 : 0.5;
  if (occupancy == Occupancy::kOccupied) geometry.cost_density = 2;
}

template <typename Model>
fcl::CollisionResultd query(const Model& a, const Model& b, const Frame& frame,
                            const fcl::CollisionRequestd& request) {
  fcl::CollisionResultd result;
  fcl::collide(&a, frame.X_WA, &b, frame.X_WB, request, result);
  return result;
}

// FCL's order of cost sources: the dearest first.
void expectSameCosts(fcl::CollisionResultd& ours, fcl::CollisionResultd& theirs) {
  std::vector<fcl::CostSourced> a, b;
  ours.getCostSources(a);
  theirs.getCostSources(b);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].aabb_min, b[i].aabb_min);
    EXPECT_EQ(a[i].aabb_max, b[i].aabb_max);
    EXPECT_EQ(a[i].cost_density, b[i].cost_density);
    EXPECT_EQ(a[i].total_cost, b[i].total_cost);
  }
}

class Cost : public ::testing::Test {
 protected:
  const MeshCase pair_ = meshCases().front();
  const std::shared_ptr<Modeld> kios_a_ = kiosModel(pair_.a), kios_b_ = kiosModel(pair_.b);
  const std::shared_ptr<ObbrssModel> obbrss_a_ = scenes::buildModel<fcl::OBBRSSd>(pair_.a);
  const std::shared_ptr<ObbrssModel> obbrss_b_ = scenes::buildModel<fcl::OBBRSSd>(pair_.b);
  const std::vector<Frame> frames_ = randomFrames(30, pair_.spread, 31);
};

TEST_F(Cost, SourcesEqualThoseOfObbrssModels) {
  kios_a_->cost_density = obbrss_a_->cost_density = 3;
  kios_b_->cost_density = obbrss_b_->cost_density = 5;
  std::size_t sources = 0;
  for (const Frame& frame : frames_) {
    for (const bool enable_contact : {false, true}) {
      for (const std::size_t limit : {std::size_t{1}, std::size_t{4}, kAllContacts}) {
        // Also a result that is full of contacts gets all sources.
        for (const std::size_t contacts : {std::size_t{1}, kAllContacts}) {
          fcl::CollisionRequestd request(contacts, enable_contact, limit, true);
          for (const bool approximate : {false, true}) {
            request.use_approximate_cost = approximate;
            auto ours = query(*kios_a_, *kios_b_, frame, request);
            auto theirs = query(*obbrss_a_, *obbrss_b_, frame, request);
            expectSameCosts(ours, theirs);
            EXPECT_EQ(ours.isCollision(), theirs.isCollision());
            if (contacts > 1) {
              EXPECT_EQ(contactPairs(ours), contactPairs(theirs));
            }
            sources += ours.numCostSources();
          }
        }
      }
    }
  }
  EXPECT_GT(sources, 100u);
}

TEST_F(Cost, OccupancyDecidesBetweenContactsAndSources) {
  for (const Occupancy of_a : kAllOccupancies) {
    for (const Occupancy of_b : kAllOccupancies) {
      setOccupancy(*kios_a_, of_a);
      setOccupancy(*obbrss_a_, of_a);
      setOccupancy(*kios_b_, of_b);
      setOccupancy(*obbrss_b_, of_b);
      const bool both = of_a == Occupancy::kOccupied && of_b == Occupancy::kOccupied;
      const bool any_free = of_a == Occupancy::kFree || of_b == Occupancy::kFree;
      std::size_t contacts = 0, sources = 0;
      for (const Frame& frame : frames_) {
        for (const bool enable_cost : {false, true}) {
          const fcl::CollisionRequestd request(kAllContacts, false, kAllContacts, enable_cost);
          auto ours = query(*kios_a_, *kios_b_, frame, request);
          auto theirs = query(*obbrss_a_, *obbrss_b_, frame, request);
          EXPECT_EQ(contactPairs(ours), contactPairs(theirs));
          expectSameCosts(ours, theirs);
          contacts += ours.numContacts();
          sources += ours.numCostSources();
        }
      }
      EXPECT_EQ(contacts > 0, both);
      EXPECT_EQ(sources > 0, !any_free);
    }
  }
}

// Defects 3, 10 and 23 of docs/fcl-coverage.md: contacts need that both are occupied, sources that
// neither is free; and sources lie where mesh and shape do, in the world.
TEST(ShapeCosts, OccupancyDecidesBetweenContactsAndSources) {
  const auto model = kiosModel(scenes::icosphere(0.5, 1));
  const Transform3d X_WA(Eigen::Translation3d(100, 0, 0));
  const Transform3d X_WB = X_WA * Eigen::Translation3d(0.3, 0.1, 0.1);
  scenes::Random random(3);
  for (const Shape kind : kShapes) {
    SCOPED_TRACE(nameOf(kind));
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    setOccupancy(*model, Occupancy::kOccupied);
    for (bool meets = false; !meets;) {
      shape = makeShape<double>(randomShape(kind, random));
      fcl::CollisionResultd contacts;
      meets = fcl::collide(model.get(), X_WA, shape.get(), X_WB, {}, contacts) > 0;
    }
    const fcl::CollisionGeometryd *a = model.get(), *b = shape.get();
    for (const Occupancy of_mesh : kAllOccupancies) {
      for (const Occupancy of_shape : kAllOccupancies) {
        setOccupancy(*model, of_mesh);
        setOccupancy(*shape, of_shape);
        for (const bool mesh_first : {true, false}) {
          for (const bool approximate : {true, false}) {
            const fcl::CollisionRequestd request(kAllContacts, false, 100, true, approximate);
            fcl::CollisionResultd result;
            if (mesh_first) fcl::collide(a, X_WA, b, X_WB, request, result);
            if (!mesh_first) fcl::collide(b, X_WB, a, X_WA, request, result);
            EXPECT_EQ(result.isCollision(),
                      of_mesh == Occupancy::kOccupied && of_shape == Occupancy::kOccupied);
            std::vector<fcl::CostSourced> sources;
            result.getCostSources(sources);
            EXPECT_EQ(!sources.empty(),
                      of_mesh != Occupancy::kFree && of_shape != Occupancy::kFree);
            for (const fcl::CostSourced& source : sources) {
              EXPECT_DOUBLE_EQ(source.cost_density, model->cost_density * shape->cost_density);
              for (int i = 0; i < 3; ++i) {  // within the mesh's box, with room for approximation
                EXPECT_GE(source.aabb_min[i], X_WA.translation()[i] - 1);
                EXPECT_LE(source.aabb_max[i], X_WA.translation()[i] + 1);
                EXPECT_LE(source.aabb_min[i], source.aabb_max[i]);
              }
            }
          }
        }
      }
    }
  }
}

// Approximate ones are FCL's for the root volume's box and the shape, found by fewer tests.
TEST(ShapeCosts, ApproximateOnesAreThoseOfTheRootsBox) {
  scenes::Random random(5);
  for (const Mesh& mesh : {scenes::icosphere(0.5, 1), scenes::randomSoup(2, 1, 1, 1, 3)}) {
    const auto model = kiosModel(mesh);
    for (const Shape kind : kShapes) {
      SCOPED_TRACE(nameOf(kind));
      std::size_t with = 0, without = 0;
      for (const Frame& frame : randomFrames(40, 1.5, 11)) {
        const auto shape = makeShape<double>(randomShape(kind, random));
        shape->cost_density = 3;
        model->cost_density = 0.25 * static_cast<double>((with + without) % 5);  // 0: free
        const fcl::CollisionGeometryd *a = model.get(), *b = shape.get();
        const fcl::OBBd volume = toOBB(model->getBV(0).bv, frame.X_WA);
        fcl::Boxd box(2 * volume.extent);
        const Transform3d X_WBox = Eigen::Translation3d(volume.To) * Transform3d(volume.axis);
        box.cost_density = model->cost_density;
        const fcl::CollisionGeometryd* const root = &box;
        fcl::CollisionResultd ours, theirs;
        fcl::CollisionRequestd request(1, false, 10, true, true);
        fcl::collide(a, frame.X_WA, b, frame.X_WB, request, ours);
        request.use_approximate_cost = false;
        fcl::collide(root, X_WBox, b, frame.X_WB, request, theirs);
        expectSameCosts(ours, theirs);
        ++(ours.numCostSources() > 0 ? with : without);
      }
      EXPECT_GT(with, 0u);
      EXPECT_GT(without, 0u);
    }
  }
}

}  // namespace
}  // namespace kios::testing
