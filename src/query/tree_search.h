// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/mesh_search.h"
#include "fcl_kios/model/model.h"
#include "fcl_kios/volume/separation.h"

namespace kios {

/// engine::bracketDistance over FCL's tree, for models that the engine can't serve: best first, in
/// double. Exact answers take the least ids of equally near triangles. `rounding` bounds the errors
/// of triangle distances.
template <typename S>
engine::BracketResult<S> bracketInTree(const Model<S>& model1, const Model<S>& model2,
                                       const RelativePose<S>& X_12,
                                       const engine::BracketQuery<S>& query, double rounding,
                                       SearchCounts& counts);

}  // namespace kios
