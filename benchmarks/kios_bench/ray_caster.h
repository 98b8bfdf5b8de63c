// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
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

/// Casts rays at one mesh, whose coordinates and those of the rays are floats.
class RayCaster {
 public:
  virtual ~RayCaster() = default;

  /// Sets the hits: of kFirst at most one, of kAny one of unknown place where there is any.
  virtual void cast(RayQuery query, const Rayd& ray, std::vector<CastHit>& hits) = 0;
};

#ifdef KIOS_HAVE_EMBREE
/// Returns Embree, single precision with its robust flag.
std::unique_ptr<RayCaster> makeEmbreeCaster(const scenes::Mesh& mesh);
#endif

}  // namespace kios::bench
