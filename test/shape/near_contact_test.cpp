// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The promises of docs/shapes.md about a triangle and a shape that nearly touch: verdicts,
// distances, lower bounds, nearest points and early ends, with gaps from 1e-15 to 0.1 of the shape,
// for flat and thin shapes, and for triangles from 1e-9 to 1e6 of the shape that may degenerate;
// of an octree's cell through FCL's own calls. mesh_fuzz asks these of shapes, far from the origin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fcl/geometry/octree/octree.h>
#include <fcl_kios/fcl_kios.h>

#include "not_finite.h"
#include "shape/solid_cases.h"

namespace kios::testing {
namespace {

using shape::Kind;
using shape::Solid;
using shape::Triangle;
using shape::Vec;

constexpr Kind kKinds[] = {Kind::kSphere,    Kind::kCapsule,  Kind::kBox, Kind::kConvex,
                           Kind::kEllipsoid, Kind::kCylinder, Kind::kCone};

bool isRound(Kind kind) {
  return kind == Kind::kEllipsoid || kind == Kind::kCylinder || kind == Kind::kCone;
}

/// Returns the distance of a point to a triangle, or to a solid.
Real offTriangle(const Vec& p, const Triangle& t) {
  const ExactPoint x = p.cast<Real>();
  return scenes::triangleDistance({x, x, x}, exact(t));
}

/// Ellipsoids are judged in units of their radii, of which the least doesn't matter.
Real unsureWithin(const NearPair& pair) {
  const Vec& e = pair.solid.half;
  const Real band = 0x1p-46L * pair.extent;
  if (pair.solid.kind != Kind::kEllipsoid || e.isZero(0)) return band;
  const double middle = std::max(std::min(e[0], e[1]), std::min(std::max(e[0], e[1]), e[2]));
  return band * e.maxCoeff() / std::max(1e-40, middle);
}

Real outside(const NearPair& pair, const Vec& p) {
  if (pair.round()) return pointLevel(pair.solid, p.cast<Real>());
  if (pair.solid.kind == Kind::kBox) return (p.cwiseAbs() - pair.solid.half).maxCoeff();
  const ExactPoint x = p.cast<Real>();
  Real least = std::numeric_limits<Real>::infinity();
  for (const ExactTriangle& f : pair.faces) {
    least = std::min(least, scenes::triangleDistance({x, x, x}, f) - pair.solid.margin());
  }
  const bool full = pair.solid.kind == Kind::kConvex && pair.solid.num_faces >= 4;
  if (full) least = std::min(least, FaceLevel(pair.solid, pair.faces)(x));
  return least;
}

class NearContact : public ::testing::TestWithParam<Kind> {};

// The normal of a needle, which is the last form, has digits only as the product of its short
// edges.
TEST_P(NearContact, PromisesAreKept) {
  const Kind kind = GetParam();
  const Real promised = isRound(kind) ? 0x1p-43L : 0x1p-46L;
  const int count = isRound(kind) ? 150 : 1500, needles = static_cast<int>(std::size(kSizes));
  SolidCases cases((std::getenv("SEED") ? 1000 * atoi(std::getenv("SEED")) : 31) +
                   static_cast<int>(kind));
  for (int form = 0; form <= needles; ++form) {
    int apart = 0, wrong_verdicts = 0, wrong_ends = 0;
    Real worst = 0, below = 0, above = 0, off = 0, split = 0, contact_off = 0;
    for (int i = 0; i < (form == needles ? 2 : 1) * count; ++i) {
      const NearPair pair =
          form == needles ? nearNeedle(cases, kind) : nearPair(cases, kind, kSizes[form]);
      const Real L = pair.extent;
      const Real band = unsureWithin(pair);
      const auto d = shape::distance(pair.solid, pair.triangle, kInfinity);
      const bool meets = shape::intersects(pair.solid, pair.triangle);
      EXPECT_EQ(d.distance == 0, meets);
      if (pair.judged) wrong_verdicts += meets ? pair.distance > band : pair.depth > band;
      if (meets) {
        const auto contact = shape::contact(pair.solid, pair.triangle);
        EXPECT_GE(contact.depth, 0);
        EXPECT_NEAR(contact.normal.norm(), 1, 1e-12);
        contact_off = std::max(contact_off, offTriangle(contact.position, pair.triangle) / L);
        contact_off = std::max(contact_off, outside(pair, contact.position) / L);
      }
      off = std::max(off, offTriangle(d.on_triangle, pair.triangle) / L);
      off = std::max(off, outside(pair, d.on_shape) / L);
      if (meets || pair.depth > 0 || !pair.judged) continue;
      ++apart;
      worst = std::max(worst, std::abs(d.distance - pair.distance) / L);
      below = std::max(below, (pair.distance - d.distance) / L);
      above = std::max(above, (d.lower - pair.distance) / L);
      split = std::max(split, std::abs((d.on_triangle - d.on_shape).norm() - d.distance) / L);
      // It is also asked as "nearer than this?"
      const double exact_distance = static_cast<double>(pair.distance);
      const double enough = exact_distance * (1 + (cases.pick(2) ? 1 : -1) * cases.power(-12, -1));
      const auto ended = shape::distance(pair.solid, pair.triangle, enough);
      wrong_ends += ended.distance > enough
                        ? pair.distance < enough - promised * L
                        : std::abs(ended.distance - pair.distance) > promised * L;
    }
    const auto where = [&] { return std::string(nameOf(kind)) + ", form " + std::to_string(form); };
    EXPECT_GT(apart, count / 4) << where();
    EXPECT_EQ(wrong_verdicts, 0) << where();
    EXPECT_EQ(wrong_ends, 0) << where();
    EXPECT_LE(worst, promised) << where();
    EXPECT_LE(below, 0x1p-48L) << where();
    EXPECT_LE(above, 0x1p-46L) << where() << ": lower bound";
    EXPECT_LE(split, 0x1p-46L) << where() << ": witness points' distance";
    EXPECT_LE(off, 0x1p-46L) << where() << ": witness points";
    EXPECT_LE(contact_off, 0x1p-46L) << where() << ": contact point";
  }
}

Triangle triangleThrough(const Vec& at, SolidCases& cases) {
  const double size = cases.power(-2, 3);
  const Vec n = cases.vector().normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  return {Vec(at + size * u), Vec(at + size * (-0.4 * u + 0.9 * v)),
          Vec(at + size * (-0.6 * u - 0.8 * v))};
}

// A triangle through a point of a shape without an inside, away from both their borders.
TEST_P(NearContact, PiercedFlatShapesAreMet) {
  SolidCases cases(41);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Solid s = cases.solid(GetParam(), Size::kZero);
    Vec at = Vec::Zero();
    if (s.kind == Kind::kConvex) {
      double sum = 0;
      for (const Vec& p : s.points) {
        const double weight = 0.5 + cases.unit();
        at += weight * p;
        sum += weight;
      }
      at /= sum;
    } else if (s.kind == Kind::kBox || s.kind == Kind::kEllipsoid) {
      at = 0.5 * cases.vector().cwiseProduct(s.half);
    } else {
      at = 0.2 * cases.vector().cwiseProduct(Vec(s.radius, s.radius, s.half_length));
    }
    if (!((shape::coreSupport(s, Vec(1, 2, 3)) - shape::coreSupport(s, Vec(-1, -2, -3))).norm() +
              s.margin() >
          0.1)) {
      continue;  // a point
    }
    const Triangle t = triangleThrough(at, cases);
    ++checked;
    EXPECT_TRUE(shape::intersects(s, t)) << i;
    EXPECT_EQ(shape::distance(s, t, kInfinity).distance, 0) << i;
  }
  EXPECT_GT(checked, 1500);
}

INSTANTIATE_TEST_SUITE_P(Kinds, NearContact, ::testing::ValuesIn(kKinds), NameOfKind());

// A plate and a triangle beside it, in its plane or across.
TEST(FlatConvex, NothingBesideIsMet) {
  SolidCases cases(42);
  for (int i = 0; i < 4000; ++i) {
    const double thickness = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-3 : 1e-9;
    const double gap = cases.power(-12, -2);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    if (i % 2 == 0) R = Eigen::AngleAxisd(3 * cases.unit(), cases.vector().normalized());
    Solid plate;
    plate.kind = Kind::kConvex;
    for (const double z : {-thickness, thickness}) {
      for (const Vec& p : {Vec(-1, -1, z), Vec(1, -1, z), Vec(1, 1, z), Vec(-1, 1, z)}) {
        if (thickness > 0 || plate.points.size() < 4) plate.points.push_back(R * p);
      }
    }
    const std::vector<int> two = {4, 0, 1, 2, 3, 4, 3, 2, 1, 0};
    const std::vector<int> six = {4, 3, 2, 1, 0, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                  4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7};
    plate.faces = thickness > 0 ? six.data() : two.data();
    plate.num_faces = thickness > 0 ? 6 : 2;
    const double lift = i % 4 < 2 ? 0.0 : 0.5;
    const Triangle t = {R * Vec(1.5, cases.unit(), lift), R * Vec(1 + gap, 0.3 * cases.unit(), 0),
                        R * Vec(1.5, -cases.unit(), -lift)};
    EXPECT_FALSE(shape::intersects(plate, t)) << i;
    EXPECT_NEAR(shape::distance(plate, t, kInfinity).distance, gap, 1e-14) << i;
    const Triangle through = {R * Vec(1.5, 0.1, 0.5), R * Vec(0.9, 0.3 * cases.unit(), 0),
                              R * Vec(1.5, -0.2, -0.5)};
    EXPECT_TRUE(shape::intersects(plate, through)) << i;
  }
}

// Without faces less is promised.
TEST(FacelessConvex, PromisesAreKept) {
  SolidCases cases(43);
  for (const Size size : kSizes) {
    Real worst = 0;
    for (int i = 0; i < 1000; ++i) {
      NearPair pair = nearPair(cases, Kind::kConvex, size);
      pair.solid.num_faces = 0;
      const auto d = shape::distance(pair.solid, pair.triangle, kInfinity);
      EXPECT_EQ(d.distance == 0, shape::intersects(pair.solid, pair.triangle));
      if (!pair.judged) continue;
      worst = std::max(worst, std::abs(d.distance - pair.distance) / pair.extent);
      EXPECT_FALSE(pair.distance > 0x1p-36L * pair.extent && d.distance == 0);
      EXPECT_FALSE(pair.depth > 0x1p-36L * pair.extent && d.distance > 0);
    }
    EXPECT_LE(worst, 0x1p-30L) << static_cast<int>(size);
  }
}

// A triangle that cuts the plane of an elliptic disk along a tangent of the disk, moved by a part
// of the disk's size: in units of the radii it is that far from the disk. As it stands across the
// plane, it is also that far from an ellipsoid of any thickness.
TEST(FlatEllipsoid, VerdictsAreSure) {
  SolidCases cases(44);
  for (int i = 0; i < 20000; ++i) {
    Solid disk;
    disk.kind = Kind::kEllipsoid;
    const int axis = cases.pick(3), x = (axis + 1) % 3, y = (axis + 2) % 3;
    disk.half[x] = 0.2 + 0.8 * cases.unit();
    disk.half[y] = disk.half[x] * cases.power(-3, 0);
    if (i % 2 == 1) disk.half[axis] = disk.half[y] * cases.power(-25, 0);
    const double a = 6.3 * cases.unit(), gap = cases.power(-15, -1) * (cases.pick(2) ? 1 : -1);
    Vec at = Vec::Zero(), tangent = Vec::Zero(), up = Vec::Zero();
    at[x] = disk.half[x] * std::cos(a) * (1 + gap);
    at[y] = disk.half[y] * std::sin(a) * (1 + gap);
    tangent[x] = -disk.half[x] * std::sin(a);
    tangent[y] = disk.half[y] * std::cos(a);
    up[axis] = 1;
    const double wide = cases.power(-2, 3), high = cases.power(-2, 3);
    const Triangle t = {Vec(at + wide * tangent + high * up),
                        Vec(at - wide * tangent + cases.unit() * high * up), Vec(at - high * up)};
    const double extent = std::max({t[0].norm(), t[1].norm(), t[2].norm()}) + disk.reach();
    if (std::abs(gap) * disk.half[y] <= 0x1p-46 * extent) continue;
    EXPECT_EQ(shape::intersects(disk, t), gap < 0) << gap;
    EXPECT_EQ(shape::distance(disk, t, kInfinity).distance == 0, gap < 0) << gap;
  }
}

// A triangle through a point well inside an ellipsoid that is flat, or a needle.
TEST(FlatEllipsoid, PiercedOnesAreMet) {
  SolidCases cases(45);
  for (int i = 0; i < 20000; ++i) {
    Solid s;
    s.kind = Kind::kEllipsoid;
    const int axis = cases.pick(3);
    s.half = Vec::Constant(cases.power(-22, -3));
    if (i % 2 == 0) s.half *= cases.power(-3, 0);
    s.half[axis] = i % 4 < 2 ? 1.0 : s.half[axis];
    s.half[(axis + 1) % 3] = 0.2 + 0.8 * cases.unit();
    const Vec at = 0.5 * cases.vector().normalized().cwiseProduct(s.half);
    const Triangle t = triangleThrough(at, cases);
    const double extent = shape::sizeOf(t) + s.reach();
    EXPECT_LE(shape::distance(s, t, kInfinity).distance, 0x1p-46 * extent) << s.half.transpose();
  }
}

#if FCL_HAVE_OCTOMAP
// One cell, which isn't about the octree's origin.
TEST(OctreeCell, PromisesAreKept) {
  SolidCases cases(61);
  const double side = 0.5;
  auto tree = std::make_shared<octomap::OcTree>(side);
  tree->updateNode(octomap::point3d(0.75f, 1.25f, -0.25f), true);
  const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(tree)};
  const Vec center(0.75, 1.25, -0.25);
  for (int i = 0; i < 1500; ++i) {
    NearPair pair;
    pair.solid.kind = Kind::kBox;
    pair.solid.half.setConstant(side / 2);
    pair.faces = coreFaces(pair.solid);
    pair.triangle = cases.triangle(cases.vector(), cases.power(-3, 3));
    setGap(cases.power(-14, -1), pair);
    // As the mesh stores it: about the octree's origin, rounded.
    std::vector<fcl::Vector3d> stored;
    for (Vec& p : pair.triangle) {
      stored.push_back(p + center);
      p = stored.back() - center;
    }
    measure(pair);
    const auto model = makeModel<double>(stored, {fcl::Triangle(0, 1, 2)});
    fcl::DistanceResultd d;
    fcl::CollisionResultd c;
    const fcl::Transform3d I = fcl::Transform3d::Identity();
    const fcl::CollisionGeometryd& cell = octree;
    fcl::distance(model.get(), I, &cell, I, fcl::DistanceRequestd(), d);
    fcl::collide(model.get(), I, &cell, I, fcl::CollisionRequestd(), c);
    const Real band = 0x1p-46L * (pair.extent + center.norm());
    if (pair.depth == 0) {
      EXPECT_LE(std::abs(d.min_distance - pair.distance), band);
    }
    EXPECT_FALSE(c.isCollision() && pair.distance > band);
    EXPECT_FALSE(!c.isCollision() && pair.depth > band);
  }
}
#endif

}  // namespace
}  // namespace kios::testing
