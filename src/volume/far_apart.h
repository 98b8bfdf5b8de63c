// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/volume/kios.h"
#include "volume/lanes.h"
#include "volume/rotation.h"

// What every query of a pair begins with, after the check of its rotations. Most pairs of a scene
// need no more, so both are inlined: they read the same entries.

namespace kios {

/// The way from the centre of one volume's central sphere to that of another's, in W: w = (t_B -
/// t_A) + (R_B c_b - R_A c_a).
struct CentralWay {
  /// Stands for a volume that is the origin of its frame.
  template <typename S>
  struct Origin {
    S center0[3] = {0, 0, 0}, radius0 = 0;
  };

  template <typename A, typename S>
  [[gnu::always_inline]] inline CentralWay(const A& a, const fcl::Transform3<S>& X_WA,
                                           const kIOS<S>& b, const fcl::Transform3<S>& X_WB)
      : radii(double{a.radius0} + double{b.radius0}) {
    const auto &m_a = X_WA.matrix(), &m_b = X_WB.matrix();
    const auto entry = [&](int i, int j) {
      return lanes::Double2{double{m_a(i, j)}, double{m_b(i, j)}};
    };
    const auto center = [&](int j) {
      return lanes::Double2{double{a.center0[j]}, double{b.center0[j]}};
    };
    const lanes::Double2 cx = center(0), cy = center(1), cz = center(2);
    const lanes::Double2 norms = lanes::abs(cx) + lanes::abs(cy) + lanes::abs(cz);
    lengths = radii + (norms[0] + norms[1]);
    for (int i = 0; i < 3; ++i) {
      const lanes::Double2 turned = entry(i, 0) * cx + entry(i, 1) * cy + entry(i, 2) * cz;
      const double between = double{m_b(i, 3)} - double{m_a(i, 3)};
      w[i] = between + (turned[1] - turned[0]);
      lengths += std::abs(between);
    }
  }

  /// With e the root of `squared_errors`, which squaredRotationErrors() gave, and m = `lengths`:
  /// R_A^T w is the way in A but for |R_A^T R_A - I| |c_a|, |R_A^T w| >= (1 - e) |w|, and b's
  /// radius in A is (1 + e) r_b: these terms with e are below 3 e m, and all roundings, here and in
  /// the common frame (volume/error_bounds.h), below 256 u m. kSlack m is more than both where e is
  /// at most kSlack / 4. NaN, infinities, and lengths of kFar and more prove nothing: the common
  /// frame judges them.
  template <typename S>
  static constexpr double kSlack = sizeof(S) == sizeof(double) ? 0x1p-36 : 0x1p-12;
  static constexpr double kFar = 0x1p40;
  template <typename S>
  static bool canProve(double m, double squared_errors) {
    constexpr double kMost = kSlack<S> / 4;
    return m < kFar && squared_errors <= kMost * kMost;
  }

  double w[3];
  double radii;
  double lengths;  ///< |t_B - t_A|_1 + |c_a|_1 + |c_b|_1 + r_a + r_b
};

/// True only if the central spheres alone prove the contents of two volumes farther apart than
/// `margin` >= 0, as separation() would prove it, rounding of the common frame included; false says
/// nothing. They are at least |R_A^T w| - e |c_a| - r_a - (1 + e) r_b apart, for |w| far above what
/// vanishes.
template <typename S>
[[gnu::always_inline]] inline bool farApart(const CentralWay& way, double squared_errors,
                                            double margin) {
  constexpr double kLeastSquare = 0x1p-200;
  const double lengths = way.lengths + margin;
  const double square = way.w[0] * way.w[0] + way.w[1] * way.w[1] + way.w[2] * way.w[2];
  const double least = way.radii + margin + CentralWay::kSlack<S> * lengths;
  return square > least * least && square > kLeastSquare &&
         CentralWay::canProve<S>(lengths, squared_errors);
}

}  // namespace kios
