// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost sources and occupancy: what fcl::collide reports of meshes that are free, uncertain or
// occupied, against OBBRSS models of the same meshes.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

using ObbrssModel = fcl::BVHModel<fcl::OBBRSSd>;

enum class Occupancy { kFree, kUncertain, kOccupied };

template <typename Model>
void setOccupancy(Model& model, Occupancy occupancy) {
  model.threshold_free = 0.25;
  model.threshold_occupied = 0.75;
  model.cost_density = occupancy == Occupancy::kFree ? 0.125 : 0.5;
  if (occupancy == Occupancy::kOccupied) model.cost_density = 2;
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
        fcl::CollisionRequestd request(kAllContacts, enable_contact, limit, true);
        for (const bool approximate : {false, true}) {
          request.use_approximate_cost = approximate;
          auto ours = query(*kios_a_, *kios_b_, frame, request);
          auto theirs = query(*obbrss_a_, *obbrss_b_, frame, request);
          expectSameCosts(ours, theirs);
          EXPECT_EQ(ours.isCollision(), theirs.isCollision());
          sources += ours.numCostSources();
        }
      }
    }
  }
  EXPECT_GT(sources, 100u);
}

// With costs asked for, FCL goes on after the last contact that was asked for.
TEST_F(Cost, ContactLimitDoesNotLimitSources) {
  for (const Frame& frame : frames_) {
    auto limited =
        query(*kios_a_, *kios_b_, frame, fcl::CollisionRequestd(1, true, kAllContacts, true));
    auto full = query(*kios_a_, *kios_b_, frame,
                      fcl::CollisionRequestd(kAllContacts, true, kAllContacts, true));
    expectSameCosts(limited, full);
    EXPECT_LE(limited.numContacts(), 1u);
    EXPECT_EQ(limited.isCollision(), full.isCollision());
  }
}

TEST_F(Cost, NoneUnlessAskedFor) {
  for (const Frame& frame : frames_) {
    const auto result =
        query(*kios_a_, *kios_b_, frame, fcl::CollisionRequestd(kAllContacts, true, 9, false));
    EXPECT_EQ(result.numCostSources(), 0u);
  }
}

TEST_F(Cost, OccupancyDecidesBetweenContactsAndSources) {
  constexpr Occupancy kAll[] = {Occupancy::kFree, Occupancy::kUncertain, Occupancy::kOccupied};
  for (const Occupancy of_a : kAll) {
    for (const Occupancy of_b : kAll) {
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

}  // namespace
}  // namespace kios::testing
