// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Volumes of others as policies of a VariantTree.

#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/utility.h>

#include "fcl_kios/volume.h"

namespace kios::paper {

/// Is a bound that proves contents apart and says nothing of how far.
constexpr double kApart = std::numeric_limits<double>::min();

/// FCL's fits and tests don't round outwards. The pad, 1e-12 of the coordinates, covers what they
/// round; the answers of all queries are compared with the oracle.
struct PaddedPolicy {
  struct Shared {
    double reach = 0;  ///< of the coordinates
  };
  struct Placed {
    const RelativePose<double>& X;
    double pad;
  };

  Shared share(const fcl::Vector3d* points, int n) const {
    Shared shared;
    for (int i = 0; i < n; ++i) shared.reach = std::max(shared.reach, points[i].norm());
    return shared;
  }
  Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const {
    return {X_AB, 1e-12 * (a.reach + b.reach + detail::boundsOf(X_AB).T_norm1)};
  }
};

/// FCL's RSS, and OBBRSS: as PQP, boxes for overlap and swept rectangles for distance.
template <typename BV>
struct OrientedPolicy : PaddedPolicy {
  using Volume = BV;

  BV fit(const fcl::Vector3d* points, int n, const Shared& /*model*/) const {
    BV bv;
    fcl::fit(points, n, bv);
    return bv;
  }
  double separation(const BV& a, const BV& b, const Placed& at, double enough) const {
    if (std::is_same_v<BV, fcl::RSSd> || enough > 0) {
      return fcl::distance(at.X.R(), at.X.T(), a, b) - at.pad;
    }
    return fcl::overlap(at.X.R(), at.X.T(), a, b) ? 0 : kApart;
  }
};

/// Holds FCL's AABB. That of B is recomputed at every test: the box, in A's axes, of the rotated
/// box.
struct AabbPolicy : PaddedPolicy {
  using Volume = fcl::AABBd;

  Volume fit(const fcl::Vector3d* points, int n, const Shared& /*model*/) const {
    Volume box;
    fcl::fit(points, n, box);
    return box;
  }
  double separation(const Volume& a, const Volume& b, const Placed& at, double /*enough*/) const {
    const fcl::Vector3d center = at.X * b.center();
    const fcl::Vector3d half = at.X.R().cwiseAbs() * ((b.max_ - b.min_) / 2);
    const fcl::Vector3d gaps =
        (center - half - a.max_).cwiseMax(a.min_ - center - half).cwiseMax(0.0);
    return gaps.norm() - at.pad;
  }
};

}  // namespace kios::paper
