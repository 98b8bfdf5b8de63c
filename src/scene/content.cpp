// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/content.h"

#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "fcl/dispatch.h"
#include "model/prepared.h"
#include "model/shape_values.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "volume/errors.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

/// Returns the square of the Frobenius norm of R^T R - I. Throws if the pose can't be queried.
template <typename S>
double requireRigid(const fcl::Transform3d& X) {
  const auto entries = [&X](int i, int j) { return X.linear()(i, j); };
  const double square = squaredRotationError(entries);
  requireRotation<S>(square, determinant(entries), "pose of an object of the scene");
  if (!(X.translation().lpNorm<1>() <= kMaxCoordinate<S> / 4)) {
    refuse("the translation of an object of the scene is NaN, infinite or too large.");
  }
  return square;
}

/// Returns FCL's own local AABB, which renew() made afresh. Its radius has no margin, and FCL's GJK
/// is off by up to its tolerance, 1e-6, so that distances may come out smaller.
template <typename S>
Sphere sphereOf(const fcl::CollisionGeometry<S>& geometry) {
  const double radius = geometry.aabb_radius * (1 + 1e-4) + 1e-5;
  const auto& c = geometry.aabb_center;
  if (!(std::isfinite(radius) && c.allFinite())) return {Pointd::Zero(), kInfinity};
  return {c.template cast<double>(), radius};
}

template <typename S>
class ContentOf final : public Content {
 public:
  using Geometry = std::shared_ptr<const fcl::CollisionGeometry<S>>;

  explicit ContentOf(const fcl::CollisionObject<S>* followed) : followed_(followed) {}

  void place(Body& body, Geometry geometry, const fcl::Transform3<S>& X_W) {
    if (!geometry) refuse("the geometry of an object of the scene is null.");
    const fcl::Transform3d& pose = X_W.template cast<double>();
    const double rotation_square = requireRigid<S>(pose);
    const auto* const model = dynamic_cast<const Model<S>*>(geometry.get());
    if (model) requireFinished(*model);
    geometry_ = std::move(geometry);
    model_ = model;
    setPose(body, pose, rotation_square);
    renew(body);
  }

  void renew(Body& body) override {
    if (model_) {
      state_ = stateOf(*model_);
      body.mesh.emplace(meshOf(*model_));
      body.sphere = {body.mesh->center(), body.mesh->radius()};
      body.watched = true;
    } else {
      // As fcl::CollisionObject does at its construction.
      const_cast<fcl::CollisionGeometry<S>&>(*geometry_).computeLocalAABB();
      body.mesh.reset();
      body.watched = isShapeOfFcl(*geometry_);
      if (body.watched) shape_values_ = shapeValues(*geometry_);
      body.sphere = sphereOf(*geometry_);
    }
    body.reach = body.sphere.reach();
    body.generation = nextGeneration();
    setBox(body);
  }

  void refresh(Body& body) override {
    if (followed_) {
      if (followed_->collisionGeometry() != geometry_) {
        return place(body, followed_->collisionGeometry(), followed_->getTransform());
      }
      move(body, followed_->getTransform());
    }
    if (model_) {
      requireFinished(*model_);
      if (!(stateOf(*model_) == state_)) renew(body);
    } else if (body.watched && !hasShapeValues(*geometry_, shape_values_)) {
      renew(body);
    }
  }

  bool isFollowed() const override { return followed_ != nullptr; }

  double rounded(double distance) const override { return roundedLength<S>(distance); }

  MeshPair pairOf(const Body& a, const Body& b) const override {
    return {*a.mesh, poseOf(a), *b.mesh, poseOf(b), a.rotation_square + b.rotation_square};
  }

  bool contained(const Content& other, const MeshPair& pair, SearchCounts& counts) const override {
    const Model<S>& b = *static_cast<const ContentOf&>(other).model_;
    if (!areSolids(*model_, b) || pair.rootBound(0) > 0) return false;
    return containedPoint(pair, counts).has_value();
  }

  ScenePaird ask(const Body& a, const Body& b, bool nearest_points) const override {
    const auto geometryOf = [](const Body& body) -> const fcl::CollisionGeometry<S>& {
      return *static_cast<const ContentOf&>(*body.content).geometry_;
    };
    const fcl::DistanceResult<S> found =
        distanceOfAny(geometryOf(a), poseOf(a), geometryOf(b), poseOf(b), nearest_points);
    ScenePaird answer;
    answer.distance = found.min_distance;
    answer.triangle_a = found.b1;
    answer.triangle_b = found.b2;
    if (!nearest_points) return answer;
    answer.nearest_a = found.nearest_points[0].template cast<double>();
    answer.nearest_b = found.nearest_points[1].template cast<double>();
    return answer;
  }

 private:
  /// As it was given.
  static decltype(auto) poseOf(const Body& body) {
    if constexpr (std::is_same<S, double>::value) {
      return (body.X_W);
    } else {
      fcl::Transform3<S> X_W;
      X_W.matrix() = roundedTo<S>(body.X_W.matrix());
      return X_W;
    }
  }

  Geometry geometry_;
  const fcl::CollisionObject<S>* followed_;  ///< where geometry and pose are read, if set
  const Model<S>* model_ = nullptr;          ///< the geometry if it is a mesh over k-IOS
  // As they were measured, of a mesh and of a shape: see model/shape_values.h.
  ModelState state_;
  std::vector<S> shape_values_;
};

template <typename S>
Body makeBodyOf(const fcl::CollisionObject<S>* followed,
                std::shared_ptr<const fcl::CollisionGeometry<S>> geometry,
                const fcl::Transform3<S>& X_W) {
  auto content = std::make_unique<ContentOf<S>>(followed);
  Body body;
  content->place(body, std::move(geometry), X_W);
  body.content = std::move(content);
  return body;
}

}  // namespace

template <typename S>
Body makeBody(std::shared_ptr<const fcl::CollisionGeometry<S>> geometry,
              const fcl::Transform3<S>& X_W) {
  return makeBodyOf<S>(nullptr, std::move(geometry), X_W);
}

template <typename S>
Body makeBody(const fcl::CollisionObject<S>& object) {
  return makeBodyOf<S>(&object, object.collisionGeometry(), object.getTransform());
}

template <typename S>
void move(Body& body, const fcl::Transform3<S>& X_W) {
  const fcl::Transform3d& pose = X_W.template cast<double>();
  if (body.X_W.linear() == pose.linear() && body.X_W.translation() == pose.translation()) return;
  const double rotation_square = requireRigid<S>(pose);
  ++body.pose;
  setPose(body, pose, rotation_square);
  setBox(body);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_INSTANTIATE(S)                                                \
  template Body makeBody(std::shared_ptr<const fcl::CollisionGeometry<S>>, \
                         const fcl::Transform3<S>&);                       \
  template Body makeBody(const fcl::CollisionObject<S>&);                  \
  template void move(Body&, const fcl::Transform3<S>&);
// NOLINTEND(bugprone-macro-parentheses)
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios::scene
