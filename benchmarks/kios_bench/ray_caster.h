// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_kios/query/ray.h"
#include "scenes/mesh.h"

namespace kios::bench {

/// Holds a hit as all that cast rays tell it.
struct CastHit {
  double t;
  int triangle;
};

/// Casts rays at one mesh, whose coordinates and those of the rays are floats.
class RayCaster {
 public:
  virtual ~RayCaster() = default;

  virtual std::string name() const = 0;
  virtual std::optional<CastHit> first(const Rayd& ray) = 0;
  virtual bool any(const Rayd& ray) = 0;
  virtual void all(const Rayd& ray, std::vector<CastHit>& hits) = 0;

  /// Work done since it was made.
  virtual std::optional<SearchCounts> counts() const { return std::nullopt; }
};

/// Returns ours.
std::unique_ptr<RayCaster> makeKiosCaster(const scenes::Mesh& mesh);

/// Returns embree, single precision with its robust flag; nullptr if this program was built without
/// it.
std::unique_ptr<RayCaster> makeEmbreeCaster(const scenes::Mesh& mesh);

}  // namespace kios::bench
