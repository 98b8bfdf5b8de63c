// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include "fcl_kios/model/bv_traits.h"
#include "fcl_kios/model/bvh_build.h"

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

/// Throws std::invalid_argument unless the model is a finished mesh with indices in range and
/// finite vertices. The message says what is wrong. O(vertices + triangles).
template <typename S>
void validate(const Model<S>& model);

extern template void validate(const Model<double>&);
extern template void validate(const Model<float>&);

}  // namespace kios
