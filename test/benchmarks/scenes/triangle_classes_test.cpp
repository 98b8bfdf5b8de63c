// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/triangle_classes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "scenes/rational_oracle.h"

namespace kios::scenes {
namespace {

TEST(TriangleClasses, AreNamedApart) {
  std::set<std::string> names;
  for (const TriangleClass& c : triangleClasses()) names.insert(c.name);
  EXPECT_EQ(names.size(), triangleClasses().size());
  EXPECT_GE(names.size(), 50u);
}

// Contacts named exact are contacts, and gaps are gaps: rounding took nothing from them.
TEST(TriangleClasses, ExactContactsAndGaps) {
  const std::set<std::string> contacts = {
      "vertex on face",         "vertex on edge", "edge through edge", "edge on face",
      "edge through vertex",    "shared vertex",  "shared edge",       "identical",
      "coplanar nested",        "point on face",

      "segments cross",         "same point",     "point on edge",     "segment along face",
      "penetration edge-edge z"};
  const std::set<std::string> gaps = {"gap vertex-face along z", "gap edge-edge along z",
                                      "gap face-face along z", "coplanar apart", "random apart"};
  for (std::size_t c = 0; c < triangleClasses().size(); ++c) {
    const std::string name = triangleClasses()[c].name;
    if (contacts.count(name) + gaps.count(name) == 0) continue;
    for (const TrianglePair& pair : trianglePairs(c, 200, 2)) {
      EXPECT_EQ(rationalDistance(pair).intersect, contacts.count(name) == 1) << name;
    }
  }
}

}  // namespace
}  // namespace kios::scenes
