// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/motion.h"

#include <boost/core/demangle.hpp>
#include <typeinfo>

#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/spline_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include "fcl_kios/detail/motion_bounds.h"
#include "volume/errors.h"

namespace kios::continuous {
namespace {

using Eigen::Vector3d;
using fcl::Transform3d;

/// The pose at time 0, from a copy: integrate() writes to what it is called for.
template <typename FclMotion>
Transform3d poseAtStart(FclMotion copy) {
  Transform3d X;
  copy.integrate(0);
  copy.getCurrentTransform(X);
  return X;
}

/// FCL gives a spline's de Boor points to derived classes only.
struct SplinePoints : fcl::SplineMotion<double> {
  static Motion::Points translations(const fcl::SplineMotion<double>& m) {
    return points(m.*(&SplinePoints::Td));
  }
  static Motion::Points rotations(const fcl::SplineMotion<double>& m) {
    return points(m.*(&SplinePoints::Rd));
  }
  static Motion::Points points(const Vector3d (&p)[4]) { return {p[0], p[1], p[2], p[3]}; }
};

/// Returns null for a motion of another class, a derived one too.
template <typename FclMotion>
const FclMotion* exactly(const fcl::MotionBase<double>& motion) {
  return typeid(motion) == typeid(FclMotion) ? static_cast<const FclMotion*>(&motion) : nullptr;
}

Motion of(const fcl::TranslationMotion<double>& m) {
  return Motion::twist(poseAtStart(m), m.getVelocity(), Vector3d::UnitX(), 0, Vector3d::Zero());
}

Motion of(const fcl::InterpMotion<double>& m) {
  const Transform3d X = poseAtStart(m);
  return Motion::twist(X, m.getLinearVelocity(), m.getAngularAxis(), m.getAngularVelocity(),
                       -(X.linear() * m.getReferencePoint()));
}

Motion of(const fcl::ScrewMotion<double>& m) {
  const Transform3d X = poseAtStart(m);
  return Motion::twist(X, m.getAxis() * m.getLinearVelocity(), m.getAxis(), m.getAngularVelocity(),
                       X.translation() - m.getAxisOrigin());
}

Motion of(const fcl::SplineMotion<double>& m) {
  return Motion::spline(SplinePoints::translations(m), SplinePoints::rotations(m));
}

}  // namespace

Motion motionOf(const fcl::MotionBase<double>* motion) {
  if (!motion) refuse("continuousCollide needs a motion for each object.");
  if (const auto* m = exactly<fcl::TranslationMotion<double>>(*motion)) return of(*m);
  if (const auto* m = exactly<fcl::InterpMotion<double>>(*motion)) return of(*m);
  if (const auto* m = exactly<fcl::ScrewMotion<double>>(*motion)) return of(*m);
  if (const auto* m = exactly<fcl::SplineMotion<double>>(*motion)) return of(*m);
  refuse("continuousCollide can't bound the motion ", boost::core::demangle(typeid(*motion).name()),
         "; use fcl::TranslationMotion, InterpMotion, ScrewMotion or SplineMotion.");
}

Motion motionBetween(const Transform3d& X_0, const Transform3d& X_1, fcl::CCDMotionType type) {
  switch (type) {
    case fcl::CCDM_TRANS:
      return Motion::translation(X_0, X_1);
    case fcl::CCDM_LINEAR:
      return Motion::linear(X_0, X_1);
    case fcl::CCDM_SCREW:
      return Motion::screw(X_0, X_1);
    case fcl::CCDM_SPLINE:
      return Motion::spline(X_0, X_1);
  }
  refuse("ContinuousCollisionRequest::ccd_motion_type is unknown.");
}

}  // namespace kios::continuous

namespace kios {

// FCL's motions tell no time, but for splines: the bound is that from 0 on. Points of a body turn
// with at most angular speed times their distance from a fixed axis, and across it.
double detail::speedAlong(const kIOS<double>& bv, const fcl::Vector3d& n,
                          const fcl::MotionBase<double>& motion) {
  const continuous::Motion m = continuous::motionOf(&motion);
  const fcl::Transform3d X = m.pose(0);
  const continuous::VelocityField v = m.velocities(0, X, 1);
  const fcl::Vector3d center = X * bv.center0;
  const double rounding = m.rounding(bv.center0.norm() + bv.radius0);
  const double turn = v.turnSpeed(center, bv.radius0);
  return n.dot(v.linear) + n.norm() * v.originAcceleration() +
         (v.fixed_axis ? n.cross(v.axis).norm() : n.norm()) * turn + rounding;
}

}  // namespace kios
