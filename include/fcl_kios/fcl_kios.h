// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// k-IOS for FCL: fcl::BVHModel<kios::kIOSd> and all that makes FCL's own calls serve it.

#include "fcl_kios/compiler.h"  // first, as it says what flags are wrong

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#include "fcl_kios/build/fit.h"
#include "fcl_kios/clearance/clearance.h"
#include "fcl_kios/clearance/exact_distance.h"
#include "fcl_kios/continuous/continuous.h"
#include "fcl_kios/linkage/linkage.h"
#include "fcl_kios/model/bounds.h"
#include "fcl_kios/model/bv_traits.h"
#include "fcl_kios/model/bvh_build.h"
#include "fcl_kios/model/convert.h"
#include "fcl_kios/model/model.h"
#include "fcl_kios/model/motion_bounds.h"
#include "fcl_kios/model/prepare.h"
#include "fcl_kios/model/storage.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/query/distance.h"
#include "fcl_kios/query/mesh_nodes.h"
#include "fcl_kios/query/mesh_queries.h"
#include "fcl_kios/query/octree_queries.h"
#include "fcl_kios/query/ray.h"
#include "fcl_kios/query/shape_queries.h"
#include "fcl_kios/scene/manager_query.h"
#include "fcl_kios/scene/scene_distance.h"
#include "fcl_kios/solid/closedness.h"
#include "fcl_kios/solid/penetration.h"
#include "fcl_kios/solid/repair.h"
#include "fcl_kios/solid/self_intersections.h"
#include "fcl_kios/solid/solids.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "fcl_kios/version.h"
#include "fcl_kios/volume/kios.h"
#include "fcl_kios/volume/separation.h"
