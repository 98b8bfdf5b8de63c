// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>

#include <fcl/math/motion/motion_base.h>
#include <fcl/narrowphase/continuous_collision_request.h>
#include <fcl/narrowphase/continuous_collision_result.h>

#include "competitor.h"
#include "scenes/mesh.h"

namespace kios::bench {

/// Both meshes on their way, from t = 0 to 1.
struct Motions {
  std::shared_ptr<fcl::MotionBased> a, b;
};

/// One volume with two meshes, and a way to find their first contact in time.
class ContinuousCompetitor {
 public:
  virtual ~ContinuousCompetitor() = default;
  virtual const char* name() const = 0;
  virtual bool serves(fcl::CCDMotionType type) const = 0;
  virtual double timeError() const = 0;
  virtual void load(const scenes::Mesh& a, const scenes::Mesh& b) = 0;
  virtual fcl::ContinuousCollisionResultd answer(const Motions& motions) const = 0;
  /// The same with work counted, where it is.
  virtual TestCounts count(const Motions& motions) const = 0;
};

/// Ours, to 1e-4. In a file of its own, as makeKiosCompetitor().
std::unique_ptr<ContinuousCompetitor> makeKiosContinuous();
/// FCL's over OBBRSS, to 1e-3: 1000 samples, which may miss what is between them, and its
/// conservative advancement, which can't serve splines.
std::unique_ptr<ContinuousCompetitor> makeObbrssSampling();
std::unique_ptr<ContinuousCompetitor> makeObbrssAdvancement();

}  // namespace kios::bench
