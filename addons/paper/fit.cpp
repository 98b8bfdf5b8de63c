// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/paper.h"

#include <algorithm>

#include "build/measure.h"
#include "paper/sphere_centers.h"
#include "volume/assemble.h"
#include "volume/balls.h"

namespace kios {

template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, const FitOptions& options) {
  requireUsable(options);
  fit(points, n, bv);  // refuses what can't be bounded
  if (n == 0 || options.plain()) return;
  const RelativePoints relative(points, n);
  const int exponent = relative.exponent;
  const SphereCenters centers = placeCenters(relative.p, options, kIOS<S>::kMaxSpheres);
  bv = kIOS<S>();
  for (int c = 0; c < 3; ++c) {
    bv.center0[c] = static_cast<S>(double{points[0][c]} + scaled(centers.sphere[0][c], exponent));
  }
  for (int i = 1; i < centers.k; ++i) {
    const Eigen::Vector3f cap = centers.sphere[i].cast<float>();
    bv.cap_x[i - 1] = cap[0];
    bv.cap_y[i - 1] = cap[1];
    bv.cap_z[i - 1] = cap[2];
  }
  measure(points, n, exponent, centers.k, bv);
  const int k = bv.k();
  float* const radii = bv.cap_r;
  const auto least = static_cast<float>(scaled(centers.least_cap_radius, exponent - bv.exponent));
  for (int i = 0; i < k - 1; ++i) radii[i] = std::max(radii[i], least);
  // Rounding outwards may have told them apart.
  if (options.shared_radius && k > 1) {
    std::fill_n(radii, k - 1, *std::max_element(radii, radii + k - 1));
  }
  completeCaps(bv, k);
  if (sizeof(S) == sizeof(float) && bv.reach > scaled(0x1p126, -bv.exponent)) {
    completeCaps(bv, 1);  // accessors could not return such spheres
  }
}

template <typename S>
PaperFitter<S>::PaperFitter(const FitOptions& options) : options_(options) {
  requireUsable(options);
}

template <typename S>
PaperFitter<S>::~PaperFitter() = default;

template <typename S>
kIOS<S> PaperFitter<S>::fitPoints(const fcl::Vector3<S>* points, int n) const {
  kIOS<S> bv;
  fit(points, n, bv, options_);
  return bv;
}

template void fit(const fcl::Vector3<double>*, int, kIOS<double>&, const FitOptions&);
template void fit(const fcl::Vector3<float>*, int, kIOS<float>&, const FitOptions&);
template class PaperFitter<double>;
template class PaperFitter<float>;

}  // namespace kios
