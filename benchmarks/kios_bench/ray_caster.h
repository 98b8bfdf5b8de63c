// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <vector>

#include "fcl_kios/rays.h"
#include "scenes/mesh.h"

namespace kios::bench {

enum class RayQuery { kFirst, kAny, kAll };

/// Holds a hit as all that cast rays tell it.
struct CastHit {
  double t;
  int triangle;
};

/// Casts a ray at one mesh, the coordinates of both being floats, and sets the hits: of kFirst at
/// most one, of kAny one of unknown place where there is any.
using RayCaster = std::function<void(RayQuery query, const Rayd& ray, std::vector<CastHit>& hits)>;

#ifdef KIOS_HAVE_EMBREE
/// Returns Embree, single precision with its robust flag.
RayCaster embreeCaster(const scenes::Mesh& mesh);
#endif

}  // namespace kios::bench
