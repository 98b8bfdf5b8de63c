// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/overloads.h"
#include "model/kios_model.h"
#include "volume/errors.h"

namespace kios {

bool holdsModel(const fcl::CollisionGeometry<double>* geometry) { return asModel(geometry); }
bool holdsModel(const fcl::CollisionGeometry<float>* geometry) { return asModel(geometry); }

void detail::requireObjects(const void* object1, const void* object2) {
  if (!object1 || !object2) refuse("a collision object is null.");
}

}  // namespace kios
