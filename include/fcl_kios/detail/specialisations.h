// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include "fcl_kios/volume.h"

// Every specialisation of FCL's templates over kios::kIOS. kios.h declares them all, so that no
// file knows the volume and takes FCL's general code for it: two files of one program would then
// disagree (ODR). fcl_kios/detail/bv_traits.h, bvh_build.h and motion_bounds.h define the classes;
// without them a file that needs one doesn't compile.

/// @cond
namespace fcl {

template <typename S, typename BV, typename Motion>
struct TBVMotionBoundVisitorVisitImpl;
template <typename Motion>
struct TBVMotionBoundVisitorVisitImpl<double, kios::kIOS<double>, Motion>;
template <typename S>
struct GetOrientationImpl<S, kios::kIOS<S>>;
template <typename S>
struct MakeParentRelativeRecurseImpl<S, kios::kIOS<S>>;

namespace detail {

template <typename S, typename BV>
struct Fitter;
template <typename S>
struct Fitter<S, kios::kIOS<S>>;
template <typename S, typename BV1, typename BV2>
class ConvertBVImpl;
template <typename S>
class ConvertBVImpl<S, kios::kIOS<S>, AABB<S>>;
template <typename S>
class ConvertBVImpl<S, kios::kIOS<S>, OBB<S>>;
template <typename S>
class BVFitter<kios::kIOS<S>>;
template <typename S>
class BVSplitter<kios::kIOS<S>>;

}  // namespace detail

// Members of models over k-IOS that differ from FCL's. A new model's splitter has no method, and
// splits by cost. Those that build keep nothing in fitter or splitter (bvh_build.h); those that get
// memory return BVH_ERR_MODEL_OUT_OF_MEMORY where there is none, and may be called again. Those
// after which a tree is another, or none, first wait for builds that copy it (equal meshes share).
// Those that take vertices and triangles take no more than there is room for, or make room.
// Macros, as explicit specialisations can't have the scalar as a parameter.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_MEMBER(declaration) \
  template <>                    \
  declaration
#define KIOS_MEMBERS_OF(Model, V)                                                                 \
  KIOS_MEMBER(Model::BVHModel());                                                                 \
  KIOS_MEMBER(Model::BVHModel(const BVHModel& other));                                            \
  KIOS_MEMBER(Model::~BVHModel());                                                                \
  KIOS_MEMBER(int Model::beginModel(int num_tris, int num_vertices));                             \
  KIOS_MEMBER(int Model::addVertex(const V& p));                                                  \
  KIOS_MEMBER(int Model::addTriangle(const V& p1, const V& p2, const V& p3));                     \
  KIOS_MEMBER(int Model::addSubModel(const std::vector<V>& ps));                                  \
  KIOS_MEMBER(int Model::addSubModel(const std::vector<V>& ps, const std::vector<Triangle>& ts)); \
  KIOS_MEMBER(int Model::replaceVertex(const V& p));                                              \
  KIOS_MEMBER(int Model::replaceTriangle(const V& p1, const V& p2, const V& p3));                 \
  KIOS_MEMBER(int Model::replaceSubModel(const std::vector<V>& ps));                              \
  KIOS_MEMBER(int Model::updateVertex(const V& p));                                               \
  KIOS_MEMBER(int Model::updateTriangle(const V& p1, const V& p2, const V& p3));                  \
  KIOS_MEMBER(int Model::updateSubModel(const std::vector<V>& ps));                               \
  KIOS_MEMBER(int Model::endModel());                                                             \
  KIOS_MEMBER(int Model::beginUpdateModel());                                                     \
  KIOS_MEMBER(int Model::buildTree());                                                            \
  KIOS_MEMBER(int Model::refitTree(bool bottomup));                                               \
  KIOS_MEMBER(int Model::refitTree_topdown());                                                    \
  KIOS_MEMBER(OBJECT_TYPE Model::getObjectType() const);
// NOLINTEND(bugprone-macro-parentheses)
KIOS_MEMBERS_OF(BVHModel<kios::kIOS<double>>, Vector3<double>)
KIOS_MEMBERS_OF(BVHModel<kios::kIOS<float>>, Vector3<float>)
#undef KIOS_MEMBERS_OF
#undef KIOS_MEMBER

extern template class BVHModel<kios::kIOS<double>>;
extern template class BVHModel<kios::kIOS<float>>;

}  // namespace fcl
/// @endcond
