// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include "fcl_kios/model/bv_traits.h"
#include "fcl_kios/model/bvh_build.h"

namespace fcl {

/// @cond
// Members of models over k-IOS that differ from FCL's. A new model's splitter has no method, and
// splits by cost. Those that build keep nothing in fitter or splitter (bvh_build.h); those that get
// memory return BVH_ERR_MODEL_OUT_OF_MEMORY where there is none, and may be called again.
template <>
BVHModel<kios::kIOS<double>>::BVHModel();
template <>
BVHModel<kios::kIOS<double>>::BVHModel(const BVHModel& other);
template <>
int BVHModel<kios::kIOS<double>>::beginModel(int num_tris, int num_vertices);
template <>
int BVHModel<kios::kIOS<double>>::endModel();
template <>
int BVHModel<kios::kIOS<double>>::beginUpdateModel();
template <>
int BVHModel<kios::kIOS<double>>::buildTree();
template <>
int BVHModel<kios::kIOS<double>>::refitTree_topdown();
template <>
BVHModel<kios::kIOS<float>>::BVHModel();
template <>
BVHModel<kios::kIOS<float>>::BVHModel(const BVHModel& other);
template <>
int BVHModel<kios::kIOS<float>>::beginModel(int num_tris, int num_vertices);
template <>
int BVHModel<kios::kIOS<float>>::endModel();
template <>
int BVHModel<kios::kIOS<float>>::beginUpdateModel();
template <>
int BVHModel<kios::kIOS<float>>::buildTree();
template <>
int BVHModel<kios::kIOS<float>>::refitTree_topdown();

extern template class BVHModel<kios::kIOS<double>>;
extern template class BVHModel<kios::kIOS<float>>;
/// @endcond

}  // namespace fcl

namespace kios {

/// A mesh over k-IOS.
template <typename S>
using Model = fcl::BVHModel<kIOS<S>>;
using Modeld = Model<double>;
using Modelf = Model<float>;

/// Builds a model with every check that FCL's own calls can't make. Throws std::invalid_argument
/// if there is no triangle, an index is out of range, or a vertex (used or not) is not finite, and
/// std::bad_alloc if memory runs out.
template <typename S>
std::shared_ptr<Model<S>> makeModel(const std::vector<fcl::Vector3<S>>& vertices,
                                    const std::vector<fcl::Triangle>& triangles);

/// Throws std::invalid_argument, saying what is wrong, unless the model is a finished triangle mesh
/// with indices in range and finite vertices. O(vertices + triangles).
template <typename S>
void validate(const Model<S>& model);

/// What every query checks first, O(1): the model is finished and holds triangles. Throws
/// std::invalid_argument otherwise.
template <typename S>
void requireFinished(const Model<S>& model);

extern template void validate(const Model<double>&);
extern template void validate(const Model<float>&);

}  // namespace kios
