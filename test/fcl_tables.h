// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// FCL's function tables, which libfcl lacks for float, and in double for who names a solver, take
// minutes to compile: fcl_tables.cpp does it for all tests. Knows nothing of ours, as standards.cpp
// includes it between FCL's headers.

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#if !defined(KIOS_FCL_TABLE)
#define KIOS_FCL_TABLE extern template
#endif

namespace fcl {

#define KIOS_FCL_TABLES(Solver, S)                                                                \
  KIOS_FCL_TABLE std::size_t collide<S, detail::Solver<S>>(                                       \
      const CollisionGeometry<S>*, const Transform3<S>&, const CollisionGeometry<S>*,             \
      const Transform3<S>&, const detail::Solver<S>*, const CollisionRequest<S>&,                 \
      CollisionResult<S>&);                                                                       \
  KIOS_FCL_TABLE S distance<detail::Solver<S>>(const CollisionGeometry<S>*, const Transform3<S>&, \
                                               const CollisionGeometry<S>*, const Transform3<S>&, \
                                               const detail::Solver<S>*,                          \
                                               const DistanceRequest<S>&, DistanceResult<S>&)
KIOS_FCL_TABLES(GJKSolver_libccd, float);
KIOS_FCL_TABLES(GJKSolver_indep, float);
KIOS_FCL_TABLES(GJKSolver_libccd, double);
KIOS_FCL_TABLES(GJKSolver_indep, double);
#undef KIOS_FCL_TABLES

}  // namespace fcl
