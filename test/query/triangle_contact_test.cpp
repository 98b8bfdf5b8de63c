// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The contact of two triangles is FCL's, bit by bit, wherever FCL's routine finds one.

#include "query/mesh_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include "fcl_kios/triangle.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

TEST(ContactOfTriangles, IsFcls) {
  scenes::Random random(1);
  const auto point = [&](double size) {
    return Pointd(random.uniform(-size, size), random.uniform(-size, size),
                  random.uniform(-size, size));
  };
  int found = 0, two = 0, left_alone = 0;
  for (int i = 0; i < 60000; ++i) {
    const double size = std::pow(10.0, random.uniform(-7, 4)), other = size * (i % 3 ? 1 : 0.1);
    TriangleVerticesd a = {point(size), point(size), point(size)};
    TriangleVerticesd b = {point(other), point(other), point(other)};
    if (i % 5 == 0) b[0] = a[1];                                  // a vertex in common
    if (i % 7 == 0) b[1] = Pointd(0.5 * (a[0] + a[2]));           // on an edge
    if (i % 11 == 0) a[2].z() = a[1].z() = a[0].z() = b[2].z();   // flat to an axis
    if (i % 13 == 0) a[2] = Pointd(a[1] + 1e-4 * (a[2] - a[1]));  // a needle
    if (!trianglesIntersect(a, b)) continue;
    Pointd points[3], normal;
    unsigned int count = 0;
    double depth = 0;
    if (!fcl::detail::Intersect<double>::intersect_Triangle(a[0], a[1], a[2], b[0], b[1], b[2],
                                                            points, &count, &depth, &normal) ||
        count == 0) {
      ++left_alone;
      continue;
    }
    const TriangleContact contact = triangleContact(a, b);
    ASSERT_EQ(contact.num_points, std::min(count, 2U)) << i;
    ASSERT_EQ(contact.normal, normal) << i;
    ASSERT_EQ(contact.depth, std::max(0.0, depth)) << i;
    for (std::size_t k = 0; k < contact.num_points; ++k) ASSERT_EQ(contact.points[k], points[k]);
    ++found;
    two += contact.num_points == 2;
  }
  EXPECT_GT(found, 10000);
  EXPECT_GT(two, 100);
  EXPECT_LT(left_alone, found / 10);
}

}  // namespace
}  // namespace kios::testing
