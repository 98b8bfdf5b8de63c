// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include "fcl_kios/volume/kios.h"

// Every specialisation of FCL's templates over kios::kIOS. kios.h declares them all, so that no
// file knows the volume and takes FCL's general code for it: two files of one program would then
// disagree (ODR). model/bv_traits.h, bvh_build.h and motion_bounds.h define the classes; without
// them a file that needs one doesn't compile.

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
template <>
BVHModel<kios::kIOS<double>>::BVHModel();
template <>
BVHModel<kios::kIOS<double>>::BVHModel(const BVHModel& other);
template <>
BVHModel<kios::kIOS<double>>::~BVHModel();
template <>
int BVHModel<kios::kIOS<double>>::beginModel(int num_tris, int num_vertices);
template <>
int BVHModel<kios::kIOS<double>>::addVertex(const Vector3<double>& p);
template <>
int BVHModel<kios::kIOS<double>>::addTriangle(const Vector3<double>& p1, const Vector3<double>& p2,
                                              const Vector3<double>& p3);
template <>
int BVHModel<kios::kIOS<double>>::addSubModel(const std::vector<Vector3<double>>& ps);
template <>
int BVHModel<kios::kIOS<double>>::addSubModel(const std::vector<Vector3<double>>& ps,
                                              const std::vector<Triangle>& ts);
template <>
int BVHModel<kios::kIOS<double>>::replaceVertex(const Vector3<double>& p);
template <>
int BVHModel<kios::kIOS<double>>::replaceTriangle(const Vector3<double>& p1,
                                                  const Vector3<double>& p2,
                                                  const Vector3<double>& p3);
template <>
int BVHModel<kios::kIOS<double>>::replaceSubModel(const std::vector<Vector3<double>>& ps);
template <>
int BVHModel<kios::kIOS<double>>::updateVertex(const Vector3<double>& p);
template <>
int BVHModel<kios::kIOS<double>>::updateTriangle(const Vector3<double>& p1,
                                                 const Vector3<double>& p2,
                                                 const Vector3<double>& p3);
template <>
int BVHModel<kios::kIOS<double>>::updateSubModel(const std::vector<Vector3<double>>& ps);
template <>
int BVHModel<kios::kIOS<double>>::endModel();
template <>
int BVHModel<kios::kIOS<double>>::beginUpdateModel();
template <>
int BVHModel<kios::kIOS<double>>::buildTree();
template <>
int BVHModel<kios::kIOS<double>>::refitTree(bool bottomup);
template <>
int BVHModel<kios::kIOS<double>>::refitTree_topdown();
template <>
OBJECT_TYPE BVHModel<kios::kIOS<double>>::getObjectType() const;
template <>
BVHModel<kios::kIOS<float>>::BVHModel();
template <>
BVHModel<kios::kIOS<float>>::BVHModel(const BVHModel& other);
template <>
BVHModel<kios::kIOS<float>>::~BVHModel();
template <>
int BVHModel<kios::kIOS<float>>::beginModel(int num_tris, int num_vertices);
template <>
int BVHModel<kios::kIOS<float>>::addVertex(const Vector3<float>& p);
template <>
int BVHModel<kios::kIOS<float>>::addTriangle(const Vector3<float>& p1, const Vector3<float>& p2,
                                             const Vector3<float>& p3);
template <>
int BVHModel<kios::kIOS<float>>::addSubModel(const std::vector<Vector3<float>>& ps);
template <>
int BVHModel<kios::kIOS<float>>::addSubModel(const std::vector<Vector3<float>>& ps,
                                             const std::vector<Triangle>& ts);
template <>
int BVHModel<kios::kIOS<float>>::replaceVertex(const Vector3<float>& p);
template <>
int BVHModel<kios::kIOS<float>>::replaceTriangle(const Vector3<float>& p1, const Vector3<float>& p2,
                                                 const Vector3<float>& p3);
template <>
int BVHModel<kios::kIOS<float>>::replaceSubModel(const std::vector<Vector3<float>>& ps);
template <>
int BVHModel<kios::kIOS<float>>::updateVertex(const Vector3<float>& p);
template <>
int BVHModel<kios::kIOS<float>>::updateTriangle(const Vector3<float>& p1, const Vector3<float>& p2,
                                                const Vector3<float>& p3);
template <>
int BVHModel<kios::kIOS<float>>::updateSubModel(const std::vector<Vector3<float>>& ps);
template <>
int BVHModel<kios::kIOS<float>>::endModel();
template <>
int BVHModel<kios::kIOS<float>>::beginUpdateModel();
template <>
int BVHModel<kios::kIOS<float>>::buildTree();
template <>
int BVHModel<kios::kIOS<float>>::refitTree(bool bottomup);
template <>
int BVHModel<kios::kIOS<float>>::refitTree_topdown();
template <>
OBJECT_TYPE BVHModel<kios::kIOS<float>>::getObjectType() const;

extern template class BVHModel<kios::kIOS<double>>;
extern template class BVHModel<kios::kIOS<float>>;

}  // namespace fcl
/// @endcond
