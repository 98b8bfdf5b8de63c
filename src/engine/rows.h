// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/tree.h"
#include "fcl_kios/bv/kios.h"

namespace kios::engine {

/// Writes the spheres of bv into a node, caps as middle and half difference, rounded outwards:
/// whatever a kernel computes as middle +- half, in exact arithmetic, encloses that cap.
void writeSpheres(const kIOS<float>& bv, Node& node);

/// Copies a node's rows into a lane of the block of its parent.
void writeLane(const Node& node, int lane, Block& block);

/// >= |middle| + |half| + radii of every sphere of the node.
float reachOf(const Node& node);

}  // namespace kios::engine
