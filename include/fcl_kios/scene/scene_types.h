// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <fcl/common/types.h>
#include "fcl_kios/search/counts.h"

namespace kios {

/// Says whether an object is an obstacle: two obstacles are never asked about each other.
enum class Role : std::uint8_t { kBody, kObstacle };

/// Options of a scene query.
struct SceneRequest {
  bool nearest_points = false;  ///< sets ScenePair::nearest_a and nearest_b
  /// If false, pairsWithin() may report any distance of two points of a pair up to the margin. That
  /// spares most of the search; which pairs are reported doesn't depend on it.
  bool exact = true;
};

/// Two objects of a scene, a < b.
template <typename S>
struct ScenePair {
  int a = -1, b = -1;  ///< ids
  S distance = 0;      ///< in the models' units; 0 at contact
  /// Triangles that realise the distance; -1 for geometries that have none.
  std::intptr_t triangle_a = -1, triangle_b = -1;
  /// Nearest points in the world; set if the request wants them.
  fcl::Vector3<S> nearest_a = fcl::Vector3<S>::Zero(), nearest_b = fcl::Vector3<S>::Zero();
};
using ScenePaird = ScenePair<double>;
using ScenePairf = ScenePair<float>;

/// Counts how a scene query dealt with its pairs; all but `proven_farther` and `search` add up to
/// `total`.
struct SceneCounts {
  long long total = 0;      ///< n (n - 1) / 2
  long long filtered = 0;   ///< excluded, refused by the filter, or two obstacles, where reached
  long long far_boxes = 0;  ///< farther by the boxes around their root volumes
  long long far_roots = 0;  ///< farther by their root volumes
  long long still = 0;      ///< at the relative pose of the last proof, which suffices
  long long ties = 0;       ///< no distance is small enough: after a contact, or margin <= 0
  long long queried = 0;    ///< searched by the narrow phase
  long long proven_farther = 0;  ///< of those, proven farther than the query asked for
  SearchCounts search;           ///< the work of the narrow phase

  /// Counts the pairs that the narrow phase was spared.
  long long skipped() const { return total - queried; }
};

}  // namespace kios
