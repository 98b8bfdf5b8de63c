// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/cell_tree.h"
#include "volume/rounding.h"

#if FCL_HAVE_OCTOMAP
namespace kios {
namespace {

constexpr double kRadius = 1.75;  ///< of a cube, in halves

/// A node's children, null if there are none; some may be null. FCL's calls for that, one each for
/// a child, aren't inlined.
struct Children : octomap::OcTreeNode {
  static octomap::AbstractOcTreeNode** of(const octomap::OcTreeNode& node) {
    return node.*(&Children::children);
  }
};

std::int32_t toUnits(double v) { return static_cast<std::int32_t>(std::clamp(v, -0x1p21, 0x1p21)); }

}  // namespace

// A pair that is not occupied on both sides matters for costs only.
/// Depends on the node's value alone, of which most nodes share a few.
template <typename S>
bool CellTree<S>::matters(const Node* node) {
  if (!node) return costs_;
  if (node->getLogOdds() == known_value_) return known_to_matter_;
  known_value_ = node->getLogOdds();
  known_to_matter_ =
      !octree_.isNodeFree(node) && (costs_ || (octree_.isNodeOccupied(node) && occupied_));
  return known_to_matter_;
}

template <typename S>
bool CellTree<S>::isLeaf(const Node* node) {
  const auto* const children = node ? Children::of(*node) : nullptr;
  return !children || std::all_of(children, children + 8, [](auto* child) { return !child; });
}

template <typename S>
std::uint32_t CellTree<S>::open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                                std::uint32_t& leaves) {
  const auto* const all = Children::of(*static_cast<const Node*>(node));
  std::uint32_t mattering = 0;
  leaves = 0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    if ((wanted >> i & 1U) == 0) continue;
    const auto* const child = static_cast<const Node*>(all[i]);
    if (!matters(child)) continue;  // for costs, also one that is not there
    children[i] = child;
    mattering |= 1U << i;
    leaves |= std::uint32_t{isLeaf(child)} << i;
  }
  return mattering;
}

template <typename S>
std::vector<engine::Cell> CellTree<S>::cellsNear(const Ball* spheres, int count, double error) {
  const Node* const root = octree_.getRoot();
  std::vector<Cell> found;
  if (!matters(root)) return found;
  std::int32_t low[3], high[3];
  const Ball& s = spheres[0];
  const double middle[3] = {s.x, s.y, s.z};
  for (int c = 0; c < 3; ++c) {
    const auto at = [c](const Ball& b) { return c == 0 ? b.x : c == 1 ? b.y : b.z; };
    double from = at(s) - s.r, to = at(s) + s.r;
    for (int i = 1; i < count; ++i) {
      from = std::max(from, at(spheres[i]) - spheres[i].r);
      to = std::min(to, at(spheres[i]) + spheres[i].r);
    }
    low[c] = toUnits(std::floor((from - error) / unit_));
    high[c] = toUnits(std::ceil((to + error) / unit_));
    if (low[c] > engine::kRootHalf || high[c] < -engine::kRootHalf || low[c] > high[c])
      return found;
    origin_[c] = toUnits(std::round(std::clamp(middle[c] / unit_, -0x1p20, 0x1p20)));
  }
  const Cell whole = {root,
                      -origin_[0],
                      -origin_[1],
                      -origin_[2],
                      static_cast<std::uint32_t>(engine::kRootHalf),
                      isLeaf(root)};
  for (int c = 0; c < 3; ++c) {
    low_[c] = low[c] - origin_[c];
    high_[c] = high[c] - origin_[c];
  }
  // As in the search: circumspheres are compared.
  least_half_ = s.r / (kRadius * unit_);
  collect(whole, found);
  return found;
}

template <typename S>
void CellTree<S>::collect(Cell cell, std::vector<Cell>& found) {
  for (;;) {
    if (cell.leaf != 0 || cell.half <= least_half_) {
      found.push_back(cell);
      return;
    }
    std::uint32_t wanted = 0xFF;
    const std::int32_t at[3] = {cell.x, cell.y, cell.z};
    constexpr std::uint32_t kUpper[3] = {0xAA, 0xCC, 0xF0};
    for (int c = 0; c < 3; ++c) {
      if (high_[c] < at[c]) wanted &= ~kUpper[c];
      if (low_[c] > at[c]) wanted &= kUpper[c];
    }
    const void* children[8];
    std::uint32_t leaves;
    wanted = open(cell.node, wanted, children, leaves);
    if (wanted == 0) return;
    Cell last = cell;
    for (std::uint32_t i = 0; i < 8; ++i) {
      if ((wanted >> i & 1U) == 0) continue;
      wanted &= wanted - 1;
      const Cell child = cell.child(i, children[i], (leaves >> i & 1U) != 0);
      if (wanted == 0) {
        last = child;
      } else {
        collect(child, found);
      }
    }
    cell = last;
  }
}

// FCL halves intervals. Without branches, which can't be predicted.
template <typename S>
fcl::AABB<S> CellTree<S>::boxAt(const Cell& cell) const {
  const fcl::AABB<S> root = octree_.getRootBV();
  S low[4] = {root.min_[0], root.min_[1], root.min_[2], 0};
  S high[4] = {root.max_[0], root.max_[1], root.max_[2], 0};
  const S target[4] = {S(cell.x + origin_[0]), S(cell.y + origin_[1]), S(cell.z + origin_[2]), 0};
  S at[4] = {0, 0, 0, 0};
  const S last = roundedTo<S>(cell.half);
  for (S half = S(engine::kRootHalf) / 2; half >= last; half *= S(0.5)) {
    for (int c = 0; c < 4; ++c) {
      const S mid = (low[c] + high[c]) * S(0.5);
      const bool upper = target[c] > at[c];
      low[c] = upper ? mid : low[c];
      high[c] = upper ? high[c] : mid;
      at[c] += upper ? half : -half;
    }
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

template class CellTree<double>;
template class CellTree<float>;

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
