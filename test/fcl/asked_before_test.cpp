// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a query answers doesn't depend on what was asked before, nor on which copy is asked: the
// first answer is the tenth, to the bit, with the same ids. Complete and truncated lists, one
// contact with or without its geometry, distances with and without points, against meshes, all
// shapes and octrees.

#include <gtest/gtest.h>

#include <vector>

#include "fcl/partners.h"

namespace kios::testing {
namespace {

using Numbers = std::vector<double>;

Numbers contacts(const Modeld& model, const fcl::Transform3d& X_WM,
                 const fcl::CollisionGeometryd& partner, std::size_t most, bool geometry) {
  fcl::CollisionResultd result;
  fcl::collide(&model, X_WM, &partner, fcl::Transform3d::Identity(),
               fcl::CollisionRequestd(most, geometry), result);
  Numbers numbers = {static_cast<double>(result.numContacts())};
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& c = result.getContact(i);
    numbers.insert(numbers.end(), {static_cast<double>(c.b1), static_cast<double>(c.b2),
                                   c.penetration_depth, c.pos[0], c.pos[1], c.normal[2]});
  }
  return numbers;
}

Numbers nearest(const Modeld& model, const fcl::Transform3d& X_WM,
                const fcl::CollisionGeometryd& partner, bool points) {
  fcl::DistanceResultd result;
  const double distance = fcl::distance(&model, X_WM, &partner, fcl::Transform3d::Identity(),
                                        fcl::DistanceRequestd(points), result);
  Numbers numbers = {distance, static_cast<double>(result.b1), static_cast<double>(result.b2)};
  if (points) {  // else FCL leaves them as they are in memory
    numbers.insert(numbers.end(), {result.nearest_points[0][0], result.nearest_points[0][1],
                                   result.nearest_points[1][2]});
  }
  return numbers;
}

TEST(AskedBefore, AnswersAreTheSame) {
  const scenes::Mesh mesh = scenes::bumpyTorus(600);
  constexpr std::size_t kAll = 1000000;
  int in_contact = 0, apart = 0;
  for (const auto& named : partners()) {
    const auto& name = named.first;  // clang captures no structured bindings in C++17
    const auto& partner = named.second;
    for (const fcl::Transform3d& X_WM : scenes::randomPoses(20, 1.3, 77)) {
      // Each query meets a model that nobody has asked.
      const auto same = [&](const auto& ask) {
        const auto model = kiosModel(mesh);
        const Numbers first = ask(*model);
        for (int again = 2; again < 10; ++again) ask(*model);
        EXPECT_EQ(ask(*model), first) << name;
        EXPECT_EQ(ask(Modeld(*model)), first) << name;
        return first;
      };
      for (const std::size_t most : {std::size_t{1}, std::size_t{5}, std::size_t{50}, kAll}) {
        for (const bool geometry : {true, false}) {
          same([&](const Modeld& m) { return contacts(m, X_WM, *partner, most, geometry); });
        }
      }
      for (const bool points : {true, false}) {
        const auto found =
            same([&](const Modeld& m) { return nearest(m, X_WM, *partner, points); });
        ++(found[0] > 0 ? apart : in_contact);
      }
    }
  }
  EXPECT_GT(in_contact, 100);
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace kios::testing
