// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a query answers doesn't depend on whether its model is prepared, which only says who asked
// before: complete and truncated lists, a contact with its geometry, distances with points and ids,
// at contact too, against meshes, all shapes and octrees. (Which contact fcl::collide names where
// one is asked for, without its geometry, and which triangles fcl::distance names at distance 0,
// without their points, may depend on it.)

#include <gtest/gtest.h>

#include <vector>

#include <fcl_kios/model/prepare.h>

#include "fcl/partners.h"

namespace kios::testing {
namespace {

using Numbers = std::vector<double>;

Numbers contacts(const Modeld& model, const fcl::Transform3d& X_WM,
                 const fcl::CollisionGeometryd& partner, std::size_t most) {
  fcl::CollisionResultd result;
  fcl::collide(&model, X_WM, &partner, fcl::Transform3d::Identity(),
               fcl::CollisionRequestd(most, true), result);
  Numbers numbers = {static_cast<double>(result.numContacts())};
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& c = result.getContact(i);
    numbers.insert(numbers.end(), {static_cast<double>(c.b1), static_cast<double>(c.b2),
                                   c.penetration_depth, c.pos[0], c.pos[1], c.normal[2]});
  }
  return numbers;
}

Numbers nearest(const Modeld& model, const fcl::Transform3d& X_WM,
                const fcl::CollisionGeometryd& partner) {
  fcl::DistanceResultd result;
  const double distance =
      fcl::distance(&model, X_WM, &partner, fcl::Transform3d::Identity(),
                    fcl::DistanceRequestd(/*enable_nearest_points=*/true), result);
  return {distance,
          static_cast<double>(result.b1),
          static_cast<double>(result.b2),
          result.nearest_points[0][0],
          result.nearest_points[0][1],
          result.nearest_points[1][2]};
}

TEST(PreparedOrNot, AnswersAreTheSame) {
  const scenes::Mesh mesh = scenes::bumpyTorus(600);
  constexpr std::size_t kAll = 1000000;
  int in_contact = 0, apart = 0;
  for (const auto& [name, partner] : partners()) {
    for (const fcl::Transform3d& X_WM : scenes::randomPoses(20, 1.3, 77)) {
      // Each query meets a model that nobody has asked.
      const auto same = [&](const auto& ask) {
        const auto model = kiosModel(mesh);
        const Numbers fresh = ask(*model);
        prepare(*model);
        EXPECT_EQ(ask(*model), fresh) << name;
        return fresh;
      };
      for (const std::size_t most : {std::size_t{1}, std::size_t{5}, std::size_t{50}, kAll}) {
        same([&](const Modeld& m) { return contacts(m, X_WM, *partner, most); });
      }
      const Numbers found = same([&](const Modeld& m) { return nearest(m, X_WM, *partner); });
      ++(found[0] > 0 ? apart : in_contact);
    }
  }
  EXPECT_GT(in_contact, 50);
  EXPECT_GT(apart, 50);
}

}  // namespace
}  // namespace kios::testing
