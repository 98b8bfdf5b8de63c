// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// A file that uses FCL's templates over our volume, with FCL's headers before or after ours, and
// with KIOS_MODEL or without the headers that define our specialisations. inclusion.sh compiles it.
#ifdef KIOS_FIRST
#include "fcl_kios/volume.h"
#ifdef KIOS_MODEL
#include "fcl_kios/detail/motion_bounds.h"
#include "fcl_kios/model.h"
#endif
#endif
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h>
#include <fcl/math/motion/tbv_motion_bound_visitor.h>
#include <fcl/math/motion/translation_motion.h>
#include "fcl_kios/volume.h"
#ifdef KIOS_MODEL
#include "fcl_kios/detail/motion_bounds.h"
#include "fcl_kios/model.h"
#endif

using Volume = kios::kIOSd;
using Model = fcl::BVHModel<Volume>;

#ifdef USE_MEMBERS
int build(Model& model, const std::vector<fcl::Vector3d>& points) {
  Model fresh, copy(model);
  fresh.beginModel();
  fresh.addSubModel(points);
  model.beginUpdateModel();
  model.updateSubModel(points);
  return fresh.endModel() + model.endUpdateModel(true, false) + copy.getNumBVs();
}
#endif

#ifdef USE_FITTER
fcl::detail::BVFitter<Volume> fitter;
#endif
#ifdef USE_SPLITTER
fcl::detail::BVSplitter<Volume> splitter(fcl::detail::SPLIT_METHOD_MEAN);
#endif
#ifdef USE_FIT
void fitTo(const fcl::Vector3d* points, int n, Volume& bv) { fcl::fit(points, n, bv); }
#endif
#ifdef USE_AABB
void box(const Volume& bv, fcl::AABBd& box) {
  fcl::convertBV(bv, fcl::Transform3d::Identity(), box);
}
#endif
#ifdef USE_OBB
void box(const Volume& bv, fcl::OBBd& box) {
  fcl::convertBV(bv, fcl::Transform3d::Identity(), box);
}
#endif
#ifdef USE_ORIENTATION
fcl::Matrix3d orientation(const Model& model) { return model.getBV(0).getOrientation(); }
#endif
#ifdef USE_PARENT_RELATIVE
void makeRelative(Model& model) {
  fcl::MakeParentRelativeRecurseImpl<double, Volume>::run(model, 0, fcl::Matrix3d::Identity(),
                                                          fcl::Vector3d::Zero());
}
#endif
#ifdef USE_MOTION
double speed(const Volume& bv, const fcl::TranslationMotiond& motion) {
  return fcl::TBVMotionBoundVisitor<Volume>(bv, fcl::Vector3d::UnitX()).visit(motion);
}
#endif
