// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "tree/tree.h"

namespace kios::engine {

/// Writes five spheres into a node, S0 and two pairs of caps, these as middle and half difference,
/// rounded outwards: whatever a kernel computes as middle +- half, in exact arithmetic, encloses
/// that cap.
void writeSpheres(const Eigen::Vector3f (&centers)[kSphereRows], const double (&radii)[kSphereRows],
                  Node& node);

/// Copies a node's rows into a lane of a block.
void writeLane(const Node& node, int lane, Block& block);

/// Copies the rows of a node's children into the lanes of its block; the first one's where it has
/// fewer.
void fillBlock(const Node& node, Tree& tree);

/// The boxes of all blocks from those of the nodes, and which of their children are flat.
void writeBoxBlocks(Tree& tree);

/// True if the box is so thin that it bounds its content better than spheres do.
bool isFlat(const Box& box);

/// >= |middle| + |half| + radii of every sphere of the node.
float reachOf(const Node& node);

/// The expected cost of a query, by which trees of one mesh are compared: the sum over all blocks
/// of their nodes' sizes to the power of 1.5, where the root's size is 1.
double searchCost(const Tree& tree);

/// Sets Node::width of the leaves, the largest distance of a vertex from the line through the
/// leaf's centroid and its farthest vertex, Tree::mean_leaf, and Tree::widest_leaf. A leaf of long
/// strips side by side is narrow, and one of two large triangles is wide: a node of another tree
/// that is small beside its width may be near to only a few of its triangles. World strips ask 0.56
/// of the speed where the node's size is taken for it.
void measureLeaves(Tree& tree);

}  // namespace kios::engine
