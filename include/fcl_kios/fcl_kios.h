// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// k-IOS for FCL: fcl::BVHModel<kios::kIOSd> and all that makes FCL's own calls serve it.

#include "fcl/broadphase/broadphase_dynamic_AABB_tree.h"
#include "fcl/broadphase/default_broadphase_callbacks.h"
#include "fcl/narrowphase/collision.h"
#include "fcl/narrowphase/continuous_collision.h"
#include "fcl/narrowphase/distance.h"
#include "fcl_kios/bv/exact_distance.h"
#include "fcl_kios/bv/kios.h"
#include "fcl_kios/bv/separation.h"
#include "fcl_kios/continuous.h"
#include "fcl_kios/fcl/bounds.h"
#include "fcl_kios/fcl/bv_traits.h"
#include "fcl_kios/fcl/bvh_build.h"
#include "fcl_kios/fcl/convert.h"
#include "fcl_kios/fcl/mesh_nodes.h"
#include "fcl_kios/fcl/mesh_queries.h"
#include "fcl_kios/fcl/model.h"
#include "fcl_kios/fcl/motion_bounds.h"
#include "fcl_kios/fcl/octree_queries.h"
#include "fcl_kios/fcl/shape_queries.h"
#include "fcl_kios/fit/fit.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/query/clearance.h"
#include "fcl_kios/query/distance.h"
#include "fcl_kios/scene/manager_query.h"
#include "fcl_kios/scene/scene_distance.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "fcl_kios/version.h"
