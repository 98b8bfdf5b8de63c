// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"

namespace kios {

/// Lists up to `limit` > 0 pairs of triangles that intersect, by whatever is fastest for models of
/// their sizes. Which pairs a list of exactly `limit` holds doesn't depend on what was prepared,
/// unless `any` will do. Gives nothing if the engine can't serve the models: FCL's tree must.
template <typename S>
std::optional<std::vector<engine::TrianglePairIds>> intersectingPairs(const MeshPair<S>& frame,
                                                                      std::size_t limit, bool any,
                                                                      SearchCounts& counts);

}  // namespace kios
