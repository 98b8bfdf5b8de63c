// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Which tests a pair takes.
enum class Expanded : uint32_t {
  kNode,          ///< children of a node against a node
  kNodeTriangle,  ///< children of a node against a triangle of a leaf
  kLeaf           ///< triangles of a leaf against a node
};

/// A pair of nodes under test: the children of one against the other.
struct Expansion {
  NodePair at;
  uint32_t side;  ///< whose node is expanded: 0 of a, 1 of b
  Expanded kind;
  const Node* parent;    ///< of the children
  const Node* other;     ///< of a triangle: a stand-in
  uint32_t first_child;  ///< the node that lane 0 is
  Children children;
  uint32_t near;  ///< children that matter, as bits
  bool tight;     ///< whether boxes were tested
  float bound;    ///< of the pair
  alignas(32) float bounds[kLanes];
};

/// A triangle that stands for a node: a leaf that spheres bound badly.
inline constexpr Node kTriangleStandIn = [] {
  Node node;
  node.child = -1;
  node.flat = 1;
  return node;
}();

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
