// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/common/types.h>

namespace kios {

/// Names the vertices that stand for others.
struct NearWeld {
  std::vector<int> by;  ///< by vertex, the one that stands for it; -1 for those that aren't used
  double tolerance = 0;
  int welded = 0;  ///< vertices that another one stands for
  int moved = 0;   ///< of those, the ones that have other coordinates
  double farthest = 0;
  int farthest_vertex = -1;
};

/// Welds the vertices that are used. In the order of their indices, one that has none within the
/// tolerance that stays, stays; the others move to the nearest that stays. The tolerance is the
/// larger of `absolute` and `relative` times the diagonal of their box; if it is 0, or
/// `only_equal`, equal vertices alone are welded. Coordinates must be finite. Throws
/// std::invalid_argument if the box is too large for its size to be a number.
template <typename S>
NearWeld weldNear(const std::vector<fcl::Vector3<S>>& vertices, const std::vector<bool>& used,
                  double relative, double absolute, bool only_equal);

}  // namespace kios
