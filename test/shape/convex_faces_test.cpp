// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The planes of a convex shape's faces and its farthest points; and close pairs of a triangle and a
// hull of many faces, which GJK's slab across features decides.

#include "shape/convex_faces.h"
#include "shape/point_rows.h"
#include "shape/separating_slabs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "not_finite.h"
#include "scenes/shapes.h"
#include "shape/solid_cases.h"

namespace kios::testing {
namespace {

using shape::ConvexFaces;
using shape::Solid;
using shape::Triangle;
using shape::Vec;

/// Holds the hull of a ball's vertices, stretched; every third face runs the other way round.
struct Hull {
  std::vector<int> faces;
  Solid solid;

  Hull(int subdivisions, const Vec& half, const Vec& at = Vec::Zero()) {
    const auto ball = scenes::icosphere(1, subdivisions);
    for (const auto& p : ball.vertices) solid.points.push_back(half.cwiseProduct(p) + at);
    for (const auto& t : ball.triangles) {
      faces.insert(faces.end(), {3, int(t[0]), int(t[1]), int(t[2])});
      if (++solid.num_faces % 3 == 0) std::swap(faces.end()[-1], faces.end()[-2]);
    }
    solid.kind = shape::Kind::kConvex;
    solid.faces = faces.data();
  }
  void addFace(int a, int b, int c) {
    faces.insert(faces.end(), {3, a, b, c});
    ++solid.num_faces;
    solid.faces = faces.data();
  }
};

double depthIn(const ConvexFaces::Slab& slab, const Triangle& t) {
  const Vec& n = slab.normal;
  return slab.offset - std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
}

// Small integers make ties, and no rounding. Rows are looked at by whole chunks.
TEST(FarthestPoint, IsTheFirstOfTheFarthest) {
  SolidCases cases(61);
  Solid s;
  s.kind = shape::Kind::kConvex;
  const auto grid = [&] { return Vec((4 * cases.vector()).array().round()); };
  for (int count = 1; count <= 700; ++count) {
    s.points.push_back(grid());
    if (count > 200 && count % 61 != 0 && count != 256 && count != 512) continue;
    Solid in_rows = s;
    shape::makeRows(in_rows);
    EXPECT_EQ(in_rows.rows.empty(), count <= 16);
    for (int i = 0; i < 20; ++i) {
      const Vec n = grid();
      const Vec* first = &s.points[0];
      for (const Vec& p : s.points) {
        if (n.dot(p) > n.dot(*first)) first = &p;
      }
      EXPECT_EQ(shape::coreSupport(s, n), *first) << count;
      EXPECT_EQ(shape::coreSupport(in_rows, n), *first) << count;
      const Vec any = cases.vector();  // rounded alike
      EXPECT_EQ(shape::coreSupport(in_rows, any), shape::coreSupport(s, any)) << count;
      if (!in_rows.rows.empty()) {
        EXPECT_EQ(in_rows.rows.farthestAlong(n), first - s.points.data()) << count;
      }
    }
  }
  const shape::PointRows rows(s.points);
  EXPECT_EQ(rows.farthestAlong(Vec(std::numeric_limits<double>::quiet_NaN(), 0, 0)), 0U);
}

TEST(PlaneRows, TellTheFirstThatATriangleLiesHighestOver) {
  SolidCases cases(66);
  for (const std::size_t count : {8, 16, 256, 264, 1000}) {
    std::vector<double> normals(3 * count), offsets(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec n = (2 * cases.vector()).array().round();
      for (std::size_t c = 0; c < 3; ++c) normals[count * c + i] = n[static_cast<int>(c)];
      offsets[i] = std::round(2 * cases.vector().x());
    }
    const shape::PlaneRows planes = {normals.data(), offsets.data(), count};
    for (int k = 0; k < 50; ++k) {
      const Triangle t = cases.triangle(cases.vector(), 1);
      const auto heightOver = [&](std::size_t i) {
        const Vec n(normals[i], normals[count + i], normals[2 * count + i]);
        return std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])}) - offsets[i];
      };
      std::size_t first = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (heightOver(i) > heightOver(first)) first = i;
      }
      double height;
      EXPECT_EQ(planes.highestOver(t, height), first);
      EXPECT_EQ(height, heightOver(first));
    }
  }
}

// Each across a triangle beside the hull: what they prove is so by the kernel of one triangle.
TEST(SeparatingSlabs, ProveNoMoreThanThereIs) {
  SolidCases cases(67);
  int proven = 0;
  for (int i = 0; i < 40; ++i) {
    const Hull hull(2, Vec::Constant(0.2) + cases.vector().cwiseAbs(), cases.vector());
    shape::SeparatingSlabs slabs(hull.solid);
    EXPECT_EQ(slabs.add(Vec::Zero()), nullptr);
    for (int k = 0; k < 100; ++k) {
      const Triangle t = cases.triangle(2 * cases.vector(), cases.power(-3, 0));
      const auto d = shape::distance(hull.solid, t, kInfinity);
      const double rounding = 0x1p-46 * (hull.solid.reach() + shape::sizeOf(t));
      for (const double share : {0.0, 0.5, 0.9}) {
        proven += slabs.proveFarther(t, share * d.distance + (d.distance == 0 ? rounding : 0));
      }
      EXPECT_FALSE(slabs.proveFarther(t, d.distance + rounding)) << i << ' ' << k;
      if (d.distance == 0) continue;
      const auto* const slab = slabs.add(d.on_triangle - d.on_shape);
      ASSERT_NE(slab, nullptr);
      EXPECT_TRUE(slabs.proveFarther(t, d.distance - rounding));
      for (const Vec& p : hull.solid.points) {
        EXPECT_LE(slab->normal.dot(p), slab->offset + rounding);
      }
    }
  }
  EXPECT_GT(proven, 3000);
}

TEST(ConvexFaces, SlabsHoldAllPoints) {
  SolidCases cases(62);
  for (int i = 0; i < 200; ++i) {
    Hull hull(1, Vec::Constant(0.1) + cases.vector().cwiseAbs(), cases.vector());
    const double reach = hull.solid.reach();
    if (i % 2 == 1) {  // a sliver, whose plane cuts the hull
      auto& points = hull.solid.points;
      points.push_back(0.5 * (points[0] + points[1]) + 1e-13 * cases.vector());
      hull.addFace(0, 1, int(points.size()) - 1);
    }
    const ConvexFaces faces(hull.solid), others(hull.solid);
    ASSERT_TRUE(faces.known());
    const auto slabs = others.slabs();
    for (const auto& slab : slabs) {
      for (const Vec& p : hull.solid.points) {
        EXPECT_LE(slab.normal.dot(p), slab.offset + 0x1p-50 * reach);
      }
    }
    for (int k = 0; k < 20; ++k) {
      const Triangle t = cases.triangle(cases.vector(), cases.power(-3, 1));
      double least = kInfinity;
      for (const auto& slab : slabs) {
        least = std::min(least, depthIn(slab, t));
      }
      const auto exit = faces.leastExit(t);
      EXPECT_NEAR(exit.normal.norm(), 1, 1e-14);
      EXPECT_NEAR(depthIn(exit, t), least, 0x1p-47 * (reach + shape::sizeOf(t)));
    }
  }
}

TEST(ConvexFaces, WithoutAnAreaAreLeftOut) {
  Hull hull(1, Vec::Ones());
  const Hull plain(1, Vec::Ones());
  hull.addFace(1, 1, 2);
  const ConvexFaces faces(hull.solid), others(plain.solid);
  EXPECT_EQ(faces.slabs().size(), others.slabs().size());
  EXPECT_TRUE(faces.contains(Vec(0.1, 0.2, 0.3)));
  const Triangle t = {Vec(0.9, 0, 0), Vec(2, 1, 0), Vec(2, -1, 0)};
  EXPECT_TRUE(shape::intersects(hull.solid, t, &faces));
  EXPECT_LT(shape::contact(hull.solid, t, &faces).depth, 0.2);
}

// What is left of a plate's depth in an inclined plane is rounding, as are coordinates in it.
TEST(ConvexFaces, OfPlatesHoldNothing) {
  SolidCases cases(65);
  for (int i = 0; i < 500; ++i) {
    const int n = 3 + i % 8;
    const Eigen::Matrix3d R =
        Eigen::Quaterniond::FromTwoVectors(Vec::UnitZ(), cases.vector()).toRotationMatrix();
    const auto at = [&](double radius, double angle) {
      return Vec(R * Vec(radius * std::cos(angle), radius * std::sin(angle), 0));
    };
    Hull plate(0, Vec::Ones());
    plate.solid.points.clear();
    plate.faces = {n};
    for (int k = 0; k < n; ++k) {
      plate.solid.points.push_back(at(0.7, 2 * M_PI * k / n));
      plate.faces.push_back(k);
    }
    plate.faces.push_back(n);
    for (int k = n; k-- > 0;) plate.faces.push_back(k);
    plate.solid.faces = plate.faces.data();
    plate.solid.num_faces = 2;
    const ConvexFaces faces(plate.solid);
    if (!faces.known()) continue;
    for (int k = 0; k < 20; ++k) {
      const Triangle beside = {at(0.8, 0.3 * k), at(0.9, 0.3 * k + 0.05), at(0.85, 0.3 * k + 0.1)};
      EXPECT_NE(faces.judge(beside), ConvexFaces::Verdict::kMeets) << n;
      EXPECT_FALSE(faces.contains(beside[0])) << n;
    }
  }
}

// Verdicts of the planes are GJK's, and never those of the band that may be judged either way;
// close pairs' distances and lower bounds hold against each face in long double.
TEST(ConvexFaces, ClosePairsAreToldBySlabsAcrossFeatures) {
  SolidCases cases(63);
  Real worst = 0, above = 0;
  int apart = 0, met = 0, told_apart = 0, told_meets = 0, closed = 0;
  for (int i = 0; i < 1500; ++i) {
    NearPair pair;
    const Hull hull(1, Vec::Constant(0.2) + cases.vector().cwiseAbs(), cases.vector());
    pair.solid = hull.solid;
    pair.faces = coreFaces(pair.solid);
    pair.triangle = cases.triangle(2 * cases.vector(), cases.power(-3, 1));
    setGap(cases.power(-14, -1), pair);
    if (i % 3 == 0) {
      for (Vec& p : pair.triangle) p -= 0.3 * cases.unit() * (p - pair.solid.points[0]);
      measure(pair);
    }
    const ConvexFaces faces(pair.solid);
    const auto verdict = faces.judge(pair.triangle);
    const bool meets = shape::intersects(pair.solid, pair.triangle);
    EXPECT_NE(verdict, meets ? ConvexFaces::Verdict::kApart : ConvexFaces::Verdict::kMeets);
    told_apart += verdict == ConvexFaces::Verdict::kApart;
    told_meets += verdict == ConvexFaces::Verdict::kMeets;
    const auto d = shape::distance(pair.solid, pair.triangle, kInfinity);
    EXPECT_EQ(d.distance == 0, meets);
    if (meets) {
      ++met;
      EXPECT_LE(pair.distance, 0x1p-46L * pair.extent);
      continue;
    }
    EXPECT_LE(pair.depth, 0x1p-46L * pair.extent);
    ++apart;
    closed += d.distance - d.lower <= 0x1p-47 * static_cast<double>(pair.extent);
    worst = std::max(worst, std::abs(d.distance - pair.distance) / pair.extent);
    above = std::max(above, (d.lower - pair.distance) / pair.extent);
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(told_meets, 50);
  EXPECT_GT(told_apart, 300);
  EXPECT_GT(closed, apart * 9 / 10);
  EXPECT_LE(worst, 0x1p-46L);
  EXPECT_LE(above, 0x1p-46L);
}

}  // namespace
}  // namespace kios::testing
