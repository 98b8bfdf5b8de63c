// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All of FCL, before substitute.h renames its volumes: scripts/fcl_suite precompiles this.

#include <gtest/gtest.h>

#include <fcl/fcl.h>

#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include <fcl_kios/fcl_kios.h>
