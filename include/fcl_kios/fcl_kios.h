// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// k-IOS for FCL: fcl::BVHModel<kios::kIOSd> and all that makes FCL's own calls serve it.

#include "fcl_kios/detail/compiler.h"  // first, as it says what flags are wrong

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#include "fcl_kios/contact.h"
#include "fcl_kios/distance.h"
#include "fcl_kios/fcl_nodes.h"
#include "fcl_kios/linkage.h"
#include "fcl_kios/model.h"
#include "fcl_kios/motion.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/points.h"
#include "fcl_kios/rays.h"
#include "fcl_kios/repair.h"
#include "fcl_kios/scene.h"
#include "fcl_kios/solids.h"
#include "fcl_kios/storage.h"
#include "fcl_kios/triangle.h"
#include "fcl_kios/version.h"
#include "fcl_kios/volume.h"
