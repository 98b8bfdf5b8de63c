// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fcl_kios/paper.h"

namespace kios::paper {

struct Sphere {
  fcl::Vector3d center;
  double radius;
};

/// S0 and pairs of caps in the model's frame, each of which contains the content in exact
/// arithmetic. A pair lies outwards along + and - of an axis.
struct Spheres {
  std::vector<Sphere> all = {};  ///< none: empty
  int floats = 0;                ///< that describe them
};

/// Holds the kinds of k-IOS that models don't use; see its three kinds below. Floats are those that
/// a kind needs; doubles stand for them here.
class SpheresPolicy {
 public:
  /// Once a model.
  struct Shared {
    double reach = 0;                       ///< of the coordinates
    std::vector<fcl::Vector3d> directions;  ///< of a fixed-direction k-IOS
  };
  using Volume = Spheres;
  struct Placed {
    const RelativePose<double>& X;
    double pad, stretch;
  };

  Shared share(const fcl::Vector3d* points, int n) const;
  Spheres fit(const fcl::Vector3d* points, int n, const Shared& model) const;
  Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const;
  double separation(const Spheres& a, const Spheres& b, const Placed& at, double enough) const;

 protected:
  enum class Axes { kOfTheVolume, kOfTheModel, kGiven };
  SpheresPolicy(Axes axes, int most_spheres, const FitOptions& options,
                const std::vector<fcl::Vector3d>& directions = {});

 private:
  void addCaps(const std::vector<fcl::Vector3d>& points, const Shared& model, Spheres& v) const;

  Axes axes_;
  int most_spheres_;
  FitOptions options_;
  std::vector<fcl::Vector3d> given_;  ///< of unit length
};

/// Holds oriented k-IOS (paper, III-A): caps along the principal axes of each volume's content, as
/// the fit of `options` places them; k = 1, 3, 5 or, by the tuned fit alone, 7 (by ratio, where the
/// paper gives 5), at most K. Floats: 4 + 4 (k - 1), with a shared radius 5 + 3 (k - 1).
template <int K>
class OrientedKios : public SpheresPolicy {
  static_assert(K == 1 || K == 3 || K == 5 || K == 7, "S0 and up to three pairs of caps");

 public:
  explicit OrientedKios(const FitOptions& options = {})
      : SpheresPolicy(Axes::kOfTheVolume, K, options) {}
};

/// Holds fixed-direction k-IOS (paper, III-A, V-B): caps along directions that a model stores once.
/// They turn with the model, so that no rotation makes anything be computed again. The method of
/// `options` does not matter; by ratio, an axis gets caps where the largest of the extents is more
/// than 1.5 times its own, which is the paper's rule (III-C). Floats: 4 + 2 (k - 1), with a shared
/// radius 5 + (k - 1).
class FixedDirectionKios : public SpheresPolicy {
 public:
  /// Takes the principal axes of each model's vertices.
  explicit FixedDirectionKios(const FitOptions& options = {})
      : SpheresPolicy(Axes::kOfTheModel, 7, options) {}
  /// Takes directions, the same for every model, each in the model's frame, of any length above 0.
  explicit FixedDirectionKios(const std::vector<fcl::Vector3d>& directions,
                              const FitOptions& options = {})
      : SpheresPolicy(Axes::kGiven, 1 + 2 * static_cast<int>(directions.size()), options,
                      directions) {}
};

/// Holds axis-aligned k-IOS (paper, III-A): along the coordinate axes of the model's frame, of
/// which nothing is stored.
class AxisAlignedKios : public FixedDirectionKios {
 public:
  explicit AxisAlignedKios(const FitOptions& options = {})
      : FixedDirectionKios({fcl::Vector3d::UnitX(), fcl::Vector3d::UnitY(), fcl::Vector3d::UnitZ()},
                           options) {}
};

}  // namespace kios::paper
