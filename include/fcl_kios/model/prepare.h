// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl_kios/model/model.h"

namespace kios {

/// Prepares the model's tree now, as its first query would; other threads that need the tree wait
/// for it. Does nothing if the tree exists, or queries couldn't use it. Models of equal vertices
/// and triangles, anywhere in the process, share one tree, which goes with the last of them. Throws
/// std::invalid_argument if the model is not a finished mesh.
template <typename S>
void prepare(const Model<S>& model);

/// Returns the bytes of the trees that were prepared of this model and of its copies, each tree
/// once; trees that models of equal content share are counted in full.
template <typename S>
std::size_t preparedBytes(const Model<S>& model);

/// Makes a model right whose vertices were written without beginReplaceModel() or
/// beginUpdateModel(): refits the model's volumes and drops its prepared trees. Throws as
/// validate().
template <typename S>
void invalidate(Model<S>& model);

/// Names the instruction set that searches: AVX3 (AVX-512), AVX2, SSE4, NEON, or EMU128 or SCALAR
/// (plain C++). The environment variable FCL_KIOS_SIMD chooses one, for tests; answers don't depend
/// on it.
const char* simdTarget();

}  // namespace kios
