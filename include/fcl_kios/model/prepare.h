// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl_kios/model/model.h"

namespace kios {

/// Does nothing, as endModel() and refits prepare what queries search. Deprecated, gone in the next
/// version. Throws std::invalid_argument if the model is not a finished mesh.
template <typename S>
void prepare(const Model<S>& model);

/// Returns the bytes of the tree that queries search, beside FCL's; 0 of what isn't a finished
/// mesh. Copies of a model and models of equal content, anywhere in the process, share one.
template <typename S>
std::size_t preparedBytes(const Model<S>& model);

/// Makes a model right whose vertices were written without beginReplaceModel() or
/// beginUpdateModel(): refits all that was made of them. Throws as
/// validate(), and std::bad_alloc if memory runs out: the model then is unfinished.
template <typename S>
void invalidate(Model<S>& model);

/// Names the instruction set that searches: AVX3 (AVX-512), AVX2, SSE4, NEON, or EMU128 or SCALAR
/// (plain C++). The environment variable FCL_KIOS_SIMD chooses one, for tests; answers don't depend
/// on it.
const char* simdTarget();

}  // namespace kios
