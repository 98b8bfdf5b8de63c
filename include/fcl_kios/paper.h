// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/detail/bvh_build.h"
#include "fcl_kios/volume.h"

// The addon fcl_kios::paper: the fits of the paper (docs/paper.md), and what it leaves to choose.
// Link fcl_kios::paper (find_package(fcl_kios COMPONENTS paper)), or fcl_kios_paper.

namespace kios {

/// Names the method by which spheres are fitted to points.
enum class FitMethod {
  kTuned,    ///< Near-minimal S0; each cap re-centred in its plane, with its own radius (default).
  kMethodI,  ///< Caps from the curvature of the smallest enclosing ellipsoid (paper, III-B.1).
  kMethodIAtAngle,  ///< As Method I, its shortest semi-axis taken as a sin(angle) at least.
  kMethodII,  ///< As published: PCA, caps at pi/6, k by the ratio 1.5, the shift (paper, III-B.2).
};

/// Decides how many spheres a volume gets.
enum class SphereCount {
  kByRatio,  ///< 1, 3 or 5 by a/c and a/b against 1.5 (paper, III-C), the tuned fit against 1.1.
  kAll,      ///< Always 5.
  kByGain,   ///< A pair of caps where it takes 10 % or more off S0's extent along the pair's axis.
};

/// A method, and what the paper leaves to choose as well.
struct FitOptions {
  FitOptions(FitMethod fit_method = FitMethod::kTuned) : method(fit_method) {}

  FitMethod method;
  SphereCount count = SphereCount::kByRatio;
  /// All caps get the largest of their radii, and move outwards by what they gain. Each still
  /// touches the content (paper, end of III-B).
  bool shared_radius = false;
  /// Half the opening angle of a cap over the rim of the box, in [1/256, pi/2). It has no meaning
  /// in kMethodI. A smaller angle gives larger spheres. Paper, III-B.2: pi/6.
  double angle = kPublishedAngle;

  /// Returns true if this is the tuned fit without changes, that of kios::fit().
  bool plain() const {
    return method == FitMethod::kTuned && count == SphereCount::kByRatio && !shared_radius &&
           angle == kPublishedAngle;
  }

  static constexpr double kPublishedAngle = 0.52359877559829887;  // pi / 6
};

/// Fits a kIOS to n points. n = 0 gives the empty volume. Throws std::invalid_argument where
/// kios::fit() does, or if the angle is out of range.
template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, const FitOptions& options);

/// Fits a model's volumes for FCL's traversals: set as `model.bv_fitter` before endModel(), as in
/// `model.bv_fitter = std::make_shared<kios::PaperFitterd>(kios::FitMethod::kMethodII)`. The
/// tree that queries search has a fit of its own.
template <typename S>
class PaperFitter : public fcl::detail::BVFitter<kIOS<S>> {
 public:
  /// Throws std::invalid_argument for an angle out of range.
  explicit PaperFitter(const FitOptions& options);
  ~PaperFitter() override;

  kIOS<S> fitPoints(const fcl::Vector3<S>* points, int n) const override;
  const FitOptions& options() const { return options_; }

 private:
  const FitOptions options_;
};

using PaperFitterd = PaperFitter<double>;
using PaperFitterf = PaperFitter<float>;

extern template class PaperFitter<double>;
extern template class PaperFitter<float>;

}  // namespace kios
