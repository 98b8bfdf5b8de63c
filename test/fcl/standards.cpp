// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every way to write a query, for standards.sh to compile as C++17, 20 and 23, with and without the
// forced include. Without it, FCL's headers come first, as in a planner's file.
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#if !defined(OWN_FLOAT_TABLES)
#include "fcl_tables.h"
#endif
// Ours after FCL's.
#include <fcl_kios/model.h>
#include <fcl_kios/motion.h>
#include <fcl_kios/overloads.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace {

int failures = 0;

void check(const char* what, bool right) {
  if (!right) std::printf("FAILED  %s\n", what);
  failures += right ? 0 : 1;
}

/// Returns a unit square at the origin, normal to x.
template <typename S>
std::shared_ptr<kios::Model<S>> square() {
  using V = fcl::Vector3<S>;
  return kios::makeModel<S>({V(0, 0, 0), V(0, 1, 0), V(0, 1, 1), V(0, 0, 1)},
                            {{0, 1, 2}, {0, 2, 3}});
}

template <typename S>
struct Pair {
  Pair(const std::shared_ptr<fcl::CollisionGeometry<S>>& geometry1,
       const std::shared_ptr<fcl::CollisionGeometry<S>>& geometry2, S x)
      : o1(geometry1), o2(geometry2, fcl::Matrix3<S>::Identity(), fcl::Vector3<S>(x, 0, 0)) {
    X2.translation().x() = x;
  }
  fcl::Transform3<S> X1 = fcl::Transform3<S>::Identity(), X2 = X1;
  fcl::CollisionObject<S> o1, o2;
  const fcl::CollisionGeometry<S>* g1 = o1.collisionGeometry().get();
  const fcl::CollisionGeometry<S>* g2 = o2.collisionGeometry().get();
};

/// The surfaces of the pair are `apart` from each other.
template <typename S>
void ask(const char* what, const Pair<S>& p, S apart) {
  const bool touching = apart == 0;
  const fcl::CollisionRequest<S> request;
  const fcl::DistanceRequest<S> distance_request;
  const auto is = [apart](S d) { return std::abs(d - apart) <= 1e-5; };
  fcl::CollisionResult<S> c[4];
  fcl::DistanceResult<S> d[4];
  check(what, (fcl::collide(&p.o1, &p.o2, request, c[0]) > 0) == touching);
  check(what, (fcl::collide(p.g1, p.X1, p.g2, p.X2, request, c[1]) > 0) == touching);
  check(what, is(fcl::distance(&p.o1, &p.o2, distance_request, d[0])));
  check(what, is(fcl::distance(p.g1, p.X1, p.g2, p.X2, distance_request, d[1])));
#if __cplusplus >= 202002L
  check(what, (fcl::collide<S>(&p.o1, &p.o2, request, c[2]) > 0) == touching);
  check(what, (fcl::collide<S>(p.g1, p.X1, p.g2, p.X2, request, c[3]) > 0) == touching);
  check(what, is(fcl::distance<S>(&p.o1, &p.o2, distance_request, d[2])));
  check(what, is(fcl::distance<S>(p.g1, p.X1, p.g2, p.X2, distance_request, d[3])));
#endif
}

void askByCallbacks(const char* what, Pair<double>& p, double apart) {
  fcl::DefaultCollisionData<double> collision_data;
  fcl::DefaultCollisionFunction(&p.o1, &p.o2, &collision_data);
  check(what, collision_data.result.isCollision() == (apart == 0));
  fcl::DefaultDistanceData<double> distance_data;
  double dist = std::numeric_limits<double>::max();
  fcl::DefaultDistanceFunction(&p.o1, &p.o2, &distance_data, dist);
  check(what, std::abs(distance_data.result.min_distance - apart) <= 1e-5);
}

/// The second object comes to the first from x = 4.
void askContinuous(const char* what, const Pair<double>& p) {
  fcl::Transform3d far = p.X1;
  far.translation().x() = 4;
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_TRANS;
  fcl::ContinuousCollisionResultd r1, r2;
  fcl::CollisionObjectd moved = p.o2;
  moved.setTransform(far);
  fcl::continuousCollide(p.g1, p.X1, p.X1, p.g2, far, p.X1, request, r1);
  check(what, r1.is_collide);
  fcl::continuousCollide(&p.o1, p.X1, &moved, p.X1, request, r2);
  check(what, r2.is_collide);
#if __cplusplus >= 202002L
  fcl::ContinuousCollisionResultd r3;
  fcl::continuousCollide<double>(p.g1, p.X1, p.X1, p.g2, far, p.X1, request, r3);
  check(what, r3.is_collide && r3.time_of_contact == r1.time_of_contact);
#endif
}

}  // namespace

int main() {
  const auto sphere = std::make_shared<fcl::Sphered>(1);
  const auto sphere_f = std::make_shared<fcl::Spheref>(1);
  for (const bool touching : {false, true}) {
    const double apart = touching ? 0 : 0.5;
    Pair<double> meshes(square<double>(), square<double>(), apart);
    Pair<double> mixed(square<double>(), sphere, 1 + apart);
    Pair<float> meshes_f(square<float>(), square<float>(), static_cast<float>(apart));
    ask("double, meshes", meshes, apart);
    ask("double, mesh and shape", mixed, apart);
    ask("float, meshes", meshes_f, static_cast<float>(apart));
    askByCallbacks("callbacks, meshes", meshes, apart);
    askByCallbacks("callbacks, mesh and shape", mixed, apart);
    askContinuous("continuous, meshes", meshes);
  }
  Pair<double> spheres(sphere, sphere, 2.5);  // FCL's own pairs
  Pair<float> spheres_f(sphere_f, sphere_f, 2.5F);
  ask("double, shapes", spheres, 0.5);
  ask("float, shapes", spheres_f, 0.5F);
  askByCallbacks("callbacks, shapes", spheres, 0.5);
  askContinuous("continuous, shapes", spheres);
  std::printf("%s\n", failures == 0 ? "all right" : "FAILED");
  return failures == 0 ? 0 : 1;
}
