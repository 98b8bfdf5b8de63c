// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl_kios/model/model.h"

namespace kios {

/// Makes now what the model's first query would make; its other threads wait for it. Does nothing
/// if it exists, or can't be used. Models of equal vertices and triangles, anywhere in the process,
/// share what is made, which goes with the last of them. Throws std::invalid_argument if the model
/// is not a finished mesh.
template <typename S>
void prepare(const Model<S>& model);

/// Bytes held by what queries prepared of this model and of its copies, each part once; parts that
/// other models of equal content hold too are counted in full.
template <typename S>
std::size_t preparedBytes(const Model<S>& model);

/// To be called after vertices were written without beginReplaceModel() or beginUpdateModel():
/// refits the model's volumes and drops what was prepared. Throws as validate().
template <typename S>
void invalidate(Model<S>& model);

/// The instruction set that searches: AVX3 (AVX-512), AVX2, SSE4, NEON, or EMU128 or SCALAR (plain
/// C++). The environment variable FCL_KIOS_SIMD chooses one, for tests; answers don't depend on it.
const char* simdTarget();

}  // namespace kios
