// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// The one translation unit that instantiates FCL's function tables for float, which libfcl lacks.

#include "fcl/dispatch.h"
#include "fcl_kios/overloads.h"

namespace fcl {

template std::size_t collide(const CollisionGeometry<float>*, const Transform3<float>&,
                             const CollisionGeometry<float>*, const Transform3<float>&,
                             const CollisionRequest<float>&, CollisionResult<float>&);

inline namespace kios_overloads {

KIOS_OVERLOADS(float)

}  // namespace kios_overloads
}  // namespace fcl
