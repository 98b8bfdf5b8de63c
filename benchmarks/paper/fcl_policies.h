// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Volumes of others, and the single sphere, as policies of a VariantTree (volume_policy.h).

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/kDOP.h>
#include <fcl/math/bv/utility.h>

#include "fcl_kios/build/fit.h"
#include "paper/volume_policy.h"

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

/// FCL's RSS, OBB (overlap only: its distances are always "infinite") and OBBRSS: as PQP, boxes for
/// overlap and swept rectangles for distance.
template <typename BV>
struct OrientedPolicy : PaddedPolicy {
  using Volume = BV;
  using Store = VolumeArray<BV>;

  BV fit(const fcl::Vector3d* points, int n, const Shared& /*model*/) const {
    BV bv;
    fcl::fit(points, n, bv);
    return bv;
  }
  double separation(const BV& a, const BV& b, const Placed& at, double enough) const {
    if constexpr (std::is_same_v<BV, fcl::RSSd>) {
      return fcl::distance(at.X.R(), at.X.T(), a, b) - at.pad;
    } else {
      if constexpr (std::is_same_v<BV, fcl::OBBRSSd>) {
        if (enough > 0) return fcl::distance(at.X.R(), at.X.T(), a, b) - at.pad;
      }
      return fcl::overlap(at.X.R(), at.X.T(), a, b) ? 0 : kApart;
    }
  }
};

/// Holds FCL's AABB. That of B is recomputed at every test: the box, in A's axes, of the rotated
/// box.
struct AabbPolicy : PaddedPolicy {
  using Volume = fcl::AABBd;
  using Store = VolumeArray<Volume>;

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

/// Holds one sphere: a 1-IOS, the S0 of the tuned fit.
struct SpherePolicy : PaddedPolicy {
  struct Volume {
    fcl::Vector3d center;
    double radius;
  };
  using Store = VolumeArray<Volume>;

  Volume fit(const fcl::Vector3d* points, int n, const Shared& /*model*/) const {
    kIOSd bv;
    kios::fit(points, n, bv);
    return {bv.center0, bv.radius0};
  }
  double separation(const Volume& a, const Volume& b, const Placed& at, double /*enough*/) const {
    return (at.X * b.center - a.center).norm() - a.radius - b.radius - at.pad;
  }
};

/// Holds FCL's k-DOPs. That of B is recomputed at every test, from the corners of its polytope,
/// which are found at its fit (Klosowski et al. 1998, their approximation method). The distance is
/// bounded by the widest gap along a direction, and by that of the boxes.
template <std::size_t N>
struct KdopPolicy {
  static constexpr std::size_t kDirections = N / 2;
  using Directions = std::array<fcl::Vector3d, kDirections>;

  struct Volume {
    std::array<double, kDirections> lower, upper;
    std::vector<fcl::Vector3d> corners;
  };
  /// Holds volumes with their corners, as doubles.
  class Store {
   public:
    void add(const Volume& v) { volumes_.push_back(v); }
    const Volume& operator[](int i) const { return volumes_[i]; }
    std::size_t floats() const {
      std::size_t doubles = 0;
      for (const Volume& v : volumes_) doubles += N + 3 * v.corners.size();
      return 2 * doubles;
    }

   private:
    std::vector<Volume> volumes_;
  };
  struct Shared {
    double reach = 0;
  };
  struct Placed {
    Directions in_b;  ///< A's directions
    std::array<double, kDirections> shift;
    double pad;
  };

  Shared share(const fcl::Vector3d* points, int n) const {
    return {PaddedPolicy().share(points, n).reach};
  }

  Volume fit(const fcl::Vector3d* points, int n, const Shared& model) const {
    fcl::KDOP<double, N> bv;
    fcl::fit(points, n, bv);
    Volume v;
    for (std::size_t i = 0; i < kDirections; ++i) {
      v.lower[i] = bv.dist(i);
      v.upper[i] = bv.dist(i + kDirections);
    }
    findCorners(kTolerance * model.reach, v);
    return v;
  }

  Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const {
    Placed at;
    for (std::size_t i = 0; i < kDirections; ++i) {
      at.in_b[i] = X_AB.R().transpose() * directions()[i];
      at.shift[i] = directions()[i].dot(X_AB.T());
    }
    at.pad = 8 * kTolerance * (a.reach + b.reach + detail::boundsOf(X_AB).T_norm1);
    return at;
  }

  double separation(const Volume& a, const Volume& b, const Placed& at, double /*enough*/) const {
    double best = 0, box = 0;
    for (std::size_t i = 0; i < kDirections; ++i) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const fcl::Vector3d& p : b.corners) {
        const double height = at.in_b[i].dot(p);
        low = std::min(low, height);
        high = std::max(high, height);
      }
      const double gap =
          std::max({0.0, low + at.shift[i] - a.upper[i], a.lower[i] - high - at.shift[i]});
      if (i < 3) box += gap * gap;
      best = std::max(best, gap / directions()[i].norm());
    }
    return std::max(best, std::sqrt(box)) - at.pad;
  }

 private:
  static constexpr double kTolerance =
      1e-9;  ///< of the coordinates, for volumes that meet in a corner

  /// Returns FCL's directions, not normalised: what its k-DOP of a point of each axis says.
  static const Directions& directions() {
    static const Directions all = [] {
      Directions rows;
      for (int axis = 0; axis < 3; ++axis) {
        const fcl::KDOP<double, N> unit(fcl::Vector3d::Unit(axis));
        for (std::size_t i = 0; i < kDirections; ++i) rows[i][axis] = unit.dist(i);
      }
      return rows;
    }();
    return all;
  }

  /// Every point in which three of the planes meet and which is behind the others. Determinants of
  /// three directions are whole numbers, so that none is nearly singular.
  static void findCorners(double tolerance, Volume& v) {
    const Directions& d = directions();
    const auto inside = [&](const fcl::Vector3d& p) {
      for (std::size_t i = 0; i < kDirections; ++i) {
        const double height = d[i].dot(p);
        if (height < v.lower[i] - tolerance || height > v.upper[i] + tolerance) return false;
      }
      return std::none_of(v.corners.begin(), v.corners.end(), [&](const fcl::Vector3d& corner) {
        return (corner - p).cwiseAbs().maxCoeff() <= tolerance;
      });
    };
    for (std::size_t i = 0; i < kDirections; ++i) {
      for (std::size_t j = i + 1; j < kDirections; ++j) {
        const fcl::Vector3d across = d[i].cross(d[j]);
        for (std::size_t k = j + 1; k < kDirections; ++k) {
          const double determinant = across.dot(d[k]);
          if (std::abs(determinant) < 0.5) continue;
          const fcl::Vector3d of_i = d[j].cross(d[k]) / determinant;
          const fcl::Vector3d of_j = d[k].cross(d[i]) / determinant;
          const fcl::Vector3d of_k = across / determinant;
          for (int side = 0; side < 8; ++side) {
            const fcl::Vector3d p = of_i * ((side & 1) != 0 ? v.upper[i] : v.lower[i]) +
                                    of_j * ((side & 2) != 0 ? v.upper[j] : v.lower[j]) +
                                    of_k * ((side & 4) != 0 ? v.upper[k] : v.lower[k]);
            if (inside(p)) v.corners.push_back(p);
          }
        }
      }
    }
  }
};

}  // namespace kios::paper
