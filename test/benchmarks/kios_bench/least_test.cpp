// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "kios_bench/least.h"

#include <gtest/gtest.h>

#include <limits>

namespace kios::bench {
namespace {

Row row(const std::string& scenario, const std::string& query, const std::string& bv, double us) {
  Row made;
  made.scenario = scenario;
  made.query = query;
  made.bv = bv;
  made.times.median_us = us;
  return made;
}

Row atThreshold(Row made, double threshold) {
  made.asked.threshold = threshold;
  return made;
}

TEST(Least, TakesTheFastestOtherOfTheSameScenarioQueryAndSetting) {
  const auto standings =
      byRatio({row("shelf", "distance", "kios", 10), row("shelf", "distance", "fcl_rss", 40),
               row("shelf", "distance", "fcl_obbrss", 20), row("shelf", "collide", "fcl_obbrss", 1),
               row("room", "distance", "fcl_obbrss", 2)});
  ASSERT_EQ(standings.size(), 1u);
  EXPECT_EQ(standings[0].best, "fcl_obbrss");
  EXPECT_DOUBLE_EQ(standings[0].ratio, 2);
}

TEST(Least, SettingsAreRowsOfTheirOwn) {
  const auto standings = byRatio({atThreshold(row("a", "closer_than", "kios", 10), 0.5),
                                  atThreshold(row("a", "closer_than", "kios", 10), 0),
                                  atThreshold(row("a", "closer_than", "fcl_obbrss", 5), 0),
                                  atThreshold(row("a", "closer_than", "fcl_obbrss", 30), 0.5),
                                  row("a", "closer_than", "fcl_obbrss", 1)});
  ASSERT_EQ(standings.size(), 2u);
  EXPECT_DOUBLE_EQ(standings[0].ratio, 0.5);
  EXPECT_EQ(standings[0].ours.asked.threshold, 0.0);
  EXPECT_DOUBLE_EQ(standings[1].ratio, 3);
}

TEST(Least, OnlyKiosIsOursAndOnlyFclsAreOthers) {
  const auto standings =
      byRatio({row("a", "distance", "kios", 1), row("a", "distance", "kios_tree", 0.1),
               row("a", "distance", "coal_obbrss", 0.1), row("a", "distance", "fcl_rss", 3),
               row("b", "distance", "kios", 1), row("b", "distance", "kios_pairs", 0.1),
               row("b", "distance", "coal_obbrss", 0.1)});
  ASSERT_EQ(standings.size(), 1u);
  EXPECT_EQ(standings[0].best, "fcl_rss");
  EXPECT_DOUBLE_EQ(standings[0].ratio, 3);
}

TEST(Least, BuildsAreComparedWithVolumesForNearPairs) {
  const auto standings = byRatio({row("a", "build", "kios", 2), row("a", "build", "fcl_aabb", 1),
                                  row("a", "build", "fcl_obb", 4), row("a", "collide", "kios", 2),
                                  row("a", "collide", "fcl_aabb", 1)});
  ASSERT_EQ(standings.size(), 2u);
  EXPECT_EQ(standings[0].best, "fcl_aabb");
  EXPECT_EQ(standings[1].best, "fcl_obb");
}

TEST(Least, LeavesOutWhatHasNoTime) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto standings =
      byRatio({row("a", "distance", "kios", 1), row("a", "distance", "fcl_rss", nan),
               row("a", "distance", "fcl_obbrss", 4), row("b", "distance", "kios", 0),
               row("b", "distance", "fcl_rss", 1), row("c", "distance", "kios", 1),
               row("c", "distance", "fcl_rss", 0)});
  ASSERT_EQ(standings.size(), 1u);
  EXPECT_DOUBLE_EQ(standings[0].ratio, 4);
}

TEST(Least, ToyRowsAreLeftOutAndColdContactsMayBeSlower) {
  Row few = row("quads", "distance", "kios", 2), link = row("table", "distance", "kios", 2);
  few.largest_mesh = 12;
  link.largest_mesh = 2000;
  const auto standings = byRatio(
      {few, row("quads", "distance", "fcl_rss", 1), link, row("table", "distance", "fcl_rss", 1.9),
       row("room/cold", "collide", "kios", 1), row("room/cold", "collide", "fcl_rss", 0.85),
       row("hall/cold", "distance", "kios", 1), row("hall/cold", "distance", "fcl_rss", 0.85),
       row("cold/hall", "collide", "kios", 1), row("cold/hall", "collide", "fcl_rss", 0.85),
       row("shed/cold", "collide", "kios", 1), row("shed/cold", "collide", "fcl_rss", 0.75)});
  ASSERT_EQ(standings.size(), 5u);
  EXPECT_EQ(standings[0].ours.scenario, "shed/cold");
  EXPECT_EQ(standings[4].ours.scenario, "table");
  EXPECT_EQ(countSlower(standings), 4);
}

TEST(Least, LeastFirst) {
  const auto standings =
      byRatio({row("a", "distance", "kios", 1), row("a", "distance", "fcl_rss", 4),
               row("b", "distance", "kios", 1), row("b", "distance", "fcl_rss", 0.9),
               row("rays", "first", "kios", 1), row("rays", "first", "embree", 0.5),
               row("c", "distance", "kios", 1), row("c", "distance", "fcl_rss", 1)});
  ASSERT_EQ(standings.size(), 3u);
  EXPECT_EQ(standings[0].ours.scenario, "b");
  EXPECT_EQ(standings[1].ours.scenario, "c");
  EXPECT_EQ(standings[2].ours.scenario, "a");
  EXPECT_EQ(countSlower(standings), 1);
}

}  // namespace
}  // namespace kios::bench
