// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/paper.h"

namespace kios::paper {

/// kIOS<double> with any of its fits, as BVHModel's nodes hold it.
class KiosPolicy {
 public:
  struct Shared {};
  using Volume = kIOS<double>;
  using Placed = RelativePose<double>;

  explicit KiosPolicy(const FitOptions& options = {}) : options_(options) {}

  Shared share(const fcl::Vector3d* /*points*/, int /*n*/) const { return {}; }
  Volume fit(const fcl::Vector3d* points, int n, const Shared& /*model*/) const {
    Volume v;
    kios::fit(points, n, v, options_);
    return v;
  }
  const Placed& place(const Shared& /*a*/, const Shared& /*b*/,
                      const RelativePose<double>& X_AB) const {
    return X_AB;
  }
  double separation(const Volume& a, const Volume& b, const Placed& X_AB, double enough) const {
    return kios::separation(a, b, X_AB, enough);
  }

 private:
  FitOptions options_;
};

}  // namespace kios::paper
