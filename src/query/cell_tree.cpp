// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/cell_tree.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cmath>
#include <utility>

namespace kios {
namespace {

/// A node's children, null if there are none; some may be null. FCL's calls for that, one each for
/// a child, aren't inlined.
struct Children : octomap::OcTreeNode {
  static octomap::AbstractOcTreeNode** of(const octomap::OcTreeNode& node) {
    return node.*(&Children::children);
  }
};

std::int32_t toUnits(double v) { return static_cast<std::int32_t>(std::clamp(v, -0x1p21, 0x1p21)); }

bool isLeaf(const octomap::OcTreeNode* node) {
  const auto* const children = node ? Children::of(*node) : nullptr;
  return !children || std::all_of(children, children + 8, [](auto* child) { return !child; });
}

}  // namespace

CellTree::CellTree(const Node* root, double root_half, bool unknown, Matters matters)
    : root_(root),
      unit_(std::max(root_half / engine::kRootHalf, std::numeric_limits<double>::min())),
      unknown_(unknown),
      matters_(std::move(matters)) {}

// Most nodes share a few values.
bool CellTree::matters(const Node* node) {
  if (!node) return unknown_;
  if (node->getLogOdds() == known_value_) return known_to_matter_;
  known_value_ = node->getLogOdds();
  known_to_matter_ = matters_(*node);
  return known_to_matter_;
}

engine::Cell CellTree::root() const {
  constexpr auto kHalf = static_cast<std::uint32_t>(engine::kRootHalf);
  return {root_, -origin_[0], -origin_[1], -origin_[2], kHalf, isLeaf(root_)};
}

std::uint32_t CellTree::open(const void* node, std::uint32_t wanted, const void* (&children)[8],
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

bool CellTree::startNear(const Ball* spheres, int count) {
  const Ball& s = spheres[0];
  const double middle[3] = {s.x, s.y, s.z};
  for (int c = 0; c < 3; ++c) {
    const auto at = [c](const Ball& b) { return c == 0 ? b.x : c == 1 ? b.y : b.z; };
    double from = -engine::kRootHalf * unit_, to = -from;
    for (int i = 0; i < count; ++i) {
      from = std::max(from, at(spheres[i]) - spheres[i].r);
      to = std::min(to, at(spheres[i]) + spheres[i].r);
    }
    if (from > to) return false;
    origin_[c] = toUnits(std::round(std::clamp(middle[c] / unit_, -0x1p20, 0x1p20)));
  }
  return rootMatters();
}

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
