// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A mesh and one of FCL's shapes: distances and contacts within the bounds of docs/shapes.md.
// Boxes, spheres, capsules and convex shapes are judged by exact integers (a capsule is a segment
// with a margin, a box its faces); half-spaces and planes by heights; cylinders and cones by a
// search in long double.

#include <set>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "shape/shape_oracle.h"

namespace kios::fuzz {
namespace {

using testing::Shape;
using testing::ShapeSpec;
using Corners = std::array<Vector3d, 3>;

constexpr Shape kJudged[] = {Shape::kBox,       Shape::kSphere, Shape::kCapsule, Shape::kConvex,
                             Shape::kHalfspace, Shape::kPlane,  Shape::kCone,    Shape::kCylinder};

class ShapeQuestion {
 public:
  ShapeQuestion(const Case& c, std::uint64_t draw)
      : random_(draw), model_(modelOf<double>(c.meshes[0], c.foreign)), X_(c.pose(0)) {
    const auto triangles = BruteForce<double>::trianglesOf(c.meshes[0]);
    Vector3d low = triangles[0][0], high = low;
    for (const auto& t : triangles) {
      for (const Vector3d& p : t) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    const double size = std::max((high - low).norm(), 1e-9);
    spec_ = drawSpec(size);
    geometry_ = testing::makeShape<double>(spec_);
    poseShape(triangles, size);

    // In the shape's frame: right to 2^-53 of coordinates; ours is right to docs/guarantees.md's.
    using Long = Eigen::Matrix<long double, 3, 1>;
    const Eigen::Matrix<long double, 3, 3> R1 = X_.linear().cast<long double>(),
                                           R2 = Y_.linear().cast<long double>();
    const Long t = X_.translation().cast<long double>() - Y_.translation().cast<long double>();
    for (const auto& given : triangles) {
      Placed placed;
      double most = 0;
      for (int k = 0; k < 3; ++k) {
        const Long p = R1 * given[k].cast<long double>() + t;
        placed.corners[k] = (R2.transpose() * p).cast<double>();
        placed.L = std::max(placed.L, placed.corners[k].norm());
        most = std::max(most, given[k].norm());
      }
      placed.L += reach();
      placed.frame = 10 * 0x1p-52 * (most + static_cast<double>(t.norm()) + placed.L);
      triangles_.push_back(placed);
    }
  }

  Verdict run() {
    if (auto wrong = distance()) return wrong;
    return contacts();
  }

 private:
  struct Placed {
    Corners corners;
    double L = 0, frame = 0;
  };

  ShapeSpec drawSpec(double size) {
    const Shape kind = chance(random_, 0.3) ? Shape::kBox : kJudged[below(random_, 8)];
    const double relative = chance(random_, 0.3) ? 1 : power(random_, -5, 2);
    ShapeSpec spec = testing::randomShape(kind, random_, size * relative);
    if (kind == Shape::kConvex) {
      spec.hull = chance(random_, 0.3) ? scenes::subdividedBox({1, 1, 1}, 1)
                                       : scenes::icosphere(1, below(random_, 3));
      if (chance(random_, 0.2)) {  // flat
        spec.hull = scenes::singleTriangle({1, 0, 0}, {-1, 1, 0}, {0, -1, 0});
        spec.hull.triangles.emplace_back(0, 2, 1);
      }
      for (Vector3d& p : spec.hull.vertices) p = p.cwiseProduct(spec.size);
    }
    return spec;
  }

  /// Does as the mesh, somewhere near, or with a gap between a corner and the shape's border.
  void poseShape(const std::vector<TriangleVertices<double>>& triangles, double size) {
    Y_ = Transform3d::Identity();
    if (chance(random_, 0.6)) Y_.linear() = scenes::rotation(random_);
    if (chance(random_, 0.2)) Y_ = X_;
    const auto& t =
        triangles[static_cast<std::size_t>(below(random_, static_cast<int>(triangles.size())))];
    const Vector3d u = t[1] - t[0], v = t[2] - t[0];
    const bool inside = chance(random_, 0.6);
    const Vector3d p = X_ * (inside ? Vector3d(t[0] + 0.25 * u + 0.5 * v) : t[0]);
    Vector3d n = X_.linear() * u.cross(v);
    n = inside && n.norm() > 0 && n.allFinite() ? Vector3d(n.normalized())
                                                : scenes::direction(random_);
    const double gap = size * power(random_, -17, 0);
    const double away =
        chance(random_, 0.6) ? alongNormal(n) + gap : (size + reach()) * random_.unit();
    Y_.translation() = p + away * n;
  }

  /// Returns how far the shape reaches against n from its origin, for shapes with a simple formula.
  double alongNormal(const Vector3d& n) const {
    const Vector3d m = (Y_.linear().transpose() * n).cwiseAbs();
    if (spec_.kind == Shape::kBox) return 0.5 * m.dot(spec_.size);
    if (spec_.kind == Shape::kCapsule) return spec_.size[0] + 0.5 * m.z() * spec_.size[1];
    return reach();
  }

  double reach() const {
    switch (spec_.kind) {
      case Shape::kBox:
        return 0.5 * spec_.size.norm();
      case Shape::kSphere:
        return spec_.size[0];
      case Shape::kHalfspace:
      case Shape::kPlane:
        return std::abs(spec_.offset);
      case Shape::kConvex: {
        double most = 0;
        for (const Vector3d& p : spec_.hull.vertices) most = std::max(most, p.norm());
        return most;
      }
      default:
        return spec_.size[0] + 0.5 * spec_.size[1];
    }
  }

  /// Returns the distance of a triangle and the hull's faces; 0 if a corner lies inside.
  static double toHull(const Corners& t, const Mesh& hull) {
    long double deepest = -1;
    double least = std::numeric_limits<double>::infinity();
    const bool flat = hull.triangles.size() == 2;
    for (const fcl::Triangle& f : hull.triangles) {
      const Corners face = {hull.vertices[f[0]], hull.vertices[f[1]], hull.vertices[f[2]]};
      least = std::min(least, triangleDistance<double>(t, face).distance);
      using Long = Eigen::Matrix<long double, 3, 1>;
      const Long p = face[0].cast<long double>(), u = face[1].cast<long double>() - p,
                 v = face[2].cast<long double>() - p, w = t[0].cast<long double>() - p;
      deepest = std::max(deepest, u.cross(v).dot(w) > 0 ? 1.0L : -1.0L);
    }
    return !flat && deepest < 0 ? 0 : least;
  }

  /// Returns the segment along z of that half length.
  static Corners pointSegment(double half) {
    const Vector3d top(0, 0, half);
    return {top, -top, -top};
  }

  /// Is right to 2^-48 L; `grown`: of the shape larger by so much (boxes, spheres, capsules).
  double exactDistance(const Corners& t, double grown) const {
    const Vector3d& s = spec_.size;
    switch (spec_.kind) {
      case Shape::kBox: {
        Mesh box = scenes::subdividedBox({1, 1, 1}, 1);
        for (Vector3d& p : box.vertices) {
          for (int i = 0; i < 3; ++i) p[i] = std::copysign(s[i] / 2 + grown, p[i]);
        }
        return toHull(t, box);
      }
      case Shape::kSphere:
        return std::max(0.0, triangleDistance<double>(t, pointSegment(0)).distance - s[0] - grown);
      case Shape::kCapsule:
        return std::max(
            0.0, triangleDistance<double>(t, pointSegment(s[1] / 2)).distance - s[0] - grown);
      case Shape::kConvex:
        return toHull(t, spec_.hull);
      default:
        return static_cast<double>(testing::oracleDistance(
            spec_, {t[0].cast<long double>(), t[1].cast<long double>(), t[2].cast<long double>()}));
    }
  }

  bool searched() const { return spec_.kind == Shape::kCone || spec_.kind == Shape::kCylinder; }

  std::string call(const char* query) const {
    std::ostringstream words;
    words << query << " of A and a " << testing::nameOf(spec_.kind) << std::hexfloat << " of "
          << spec_.size.transpose() << ", offset " << spec_.offset << ", hull of "
          << spec_.hull.vertices.size() << " at";
    for (int i = 0; i < 3; ++i) words << " " << Y_.matrix().row(i);
    return words.str();
  }

  Verdict distance() {
    fcl::DistanceResultd result;
    const double d =
        fcl::distance(model_.get(), X_, geometry_.get(), Y_, fcl::DistanceRequestd(true), result);
    double low = std::numeric_limits<double>::infinity(), high = low, exact = low, L = 0;
    // docs/shapes.md: 2^-46 L, of cylinders and cones 2^-43 L; never below by more than 2^-48 L.
    const double within = searched() ? 0x1p-43 : 0x1p-46;
    for (const Placed& t : triangles_) {
      if (searched() && triangles_.size() > 8) return std::nullopt;  // a slow judge
      const double e = exactDistance(t.corners, 0);
      const double judge = searched() ? 2e-12 * t.L : 0x1p-48 * t.L;
      const double skew = 1.1 * skew_ * t.L;
      low = std::min(low, e - 0x1p-48 * t.L - t.frame - judge - skew);
      high = std::min(high, e + within * t.L + t.frame + judge + skew);
      if (e < exact) {
        exact = e;
        L = t.L;
      }
    }
    if (d >= low && d <= high) return std::nullopt;
    return failure(Words() << d << ", exactly " << exact << ", off by " << (d - exact) / L << " L",
                   call("distance"));
  }

  Verdict contacts() {
    fcl::CollisionResultd result;
    fcl::collide(model_.get(), X_, geometry_.get(), Y_, fcl::CollisionRequestd(1 << 30, false),
                 result);
    std::vector<fcl::Contactd> all;
    result.getContacts(all);
    std::set<std::intptr_t> found;
    for (const auto& contact : all) found.insert(contact.b1);
    if (searched() && triangles_.size() > 8) return std::nullopt;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const Placed& t = triangles_[i];
      const bool touches = found.count(static_cast<std::intptr_t>(i)) > 0;
      const double band = (searched() ? 2e-12 : 0x1p-46) * t.L + t.frame + 1.1 * skew_ * t.L;
      const double e = exactDistance(t.corners, 0);
      if (touches && e > band) {
        return failure(
            Words() << "triangle " << static_cast<int>(i) << " at " << e << " is no contact",
            call("contacts"));
      }
      const bool shrinks = spec_.kind == Shape::kBox || spec_.kind == Shape::kSphere ||
                           spec_.kind == Shape::kCapsule;
      const double least = spec_.kind == Shape::kBox ? 0.5 * spec_.size.minCoeff() : spec_.size[0];
      if (!touches && shrinks && band < least && exactDistance(t.corners, -band) == 0) {
        return failure(Words() << "triangle " << static_cast<int>(i) << " is missed",
                       call("contacts"));
      }
    }
    return std::nullopt;
  }

  Random random_;
  const std::shared_ptr<Modeld> model_;
  const Transform3d X_;
  Transform3d Y_;
  ShapeSpec spec_;
  std::shared_ptr<fcl::CollisionGeometryd> geometry_;
  std::vector<Placed> triangles_;  ///< in the shape's frame
  /// |E| of the mesh's pose, which scales lengths.
  const double skew_ = skewOf(X_);
};

}  // namespace

Verdict askShape(const Case& c) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    if (auto wrong = ShapeQuestion(c, c.draw + i).run()) return wrong;
  }
  return std::nullopt;
}

}  // namespace kios::fuzz
