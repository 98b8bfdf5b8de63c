// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/root_bound.h"

#include <algorithm>
#include <cmath>

#include "volume/rounding.h"

namespace kios::engine {
namespace {

/// Rows of a box in double.
struct RootBox {
  explicit RootBox(const Box& box) {
    const float* const rows[3] = {box.x, box.y, box.z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < kBoxColumns; ++j) at[i][j] = double{rows[i][j]};
      half[i] = double{box.half[i]};
    }
  }
  double at[3][kBoxColumns];  ///< axes and the centre, by coordinate
  double half[3];
};

double square(double gap) { return gap > 0 ? gap * gap : 0.0; }

/// The bound of simd/box_test-inl.h along the axes of both boxes, and along their products where
/// that proves nothing. Roundings are far fewer than those that box_pad is for: what of it is left
/// are the stored floats.
double betweenBoxes(const RootBox& a, const RootBox& b, const TreePose& X, double required) {
  double moved[3][kBoxColumns];  // b in a's frame, its centre from a's
  const auto moveColumn = [&](int i, int j) {
    moved[i][j] = X.R(i, 0) * b.at[0][j] + X.R(i, 1) * b.at[1][j] + X.R(i, 2) * b.at[2][j];
  };
  double C[3][kBoxColumns], abs_C[3][3];  // along a's axes
  const auto alongA = [&](int i, int j) {
    C[i][j] = a.at[0][i] * moved[0][j] + a.at[1][i] * moved[1][j] + a.at[2][i] * moved[2][j];
  };
  for (int i = 0; i < 3; ++i) {
    moveColumn(i, kCenter);
    moved[i][kCenter] += X.t[i] - a.at[i][kCenter];
  }
  bool is_inside = true;  // b's centre within a's box, as a link is within a room
  const double radius =
      std::sqrt(b.half[0] * b.half[0] + b.half[1] * b.half[1] + b.half[2] * b.half[2]);
  // By the ball around b's box, whose reach is its radius at most; stored axes are of length 1 to
  // their rounding, 2^-22 of it, for which box_pad pays.
  double by_ball = 0;
  for (int i = 0; i < 3; ++i) {
    alongA(i, kCenter);
    is_inside &= std::abs(C[i][kCenter]) <= a.half[i];
    by_ball += square(std::abs(C[i][kCenter]) - (a.half[i] + radius + X.box_pad));
  }
  if (is_inside) return 0;
  if (by_ball > required * required) return std::sqrt(by_ball);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < kCenter; ++j) moveColumn(i, j);
  }
  double by_a = 0, by_b = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < kCenter; ++j) {
      alongA(i, j);
      abs_C[i][j] = std::abs(C[i][j]);
    }
    const double reach =
        abs_C[i][0] * b.half[0] + abs_C[i][1] * b.half[1] + abs_C[i][2] * b.half[2];
    by_a += square(std::abs(C[i][kCenter]) - (a.half[i] + reach + X.box_pad));
  }
  if (by_a > required * required) return std::sqrt(by_a);
  for (int j = 0; j < 3; ++j) {
    const double apart = moved[0][j] * moved[0][kCenter] + moved[1][j] * moved[1][kCenter] +
                         moved[2][j] * moved[2][kCenter];
    const double reach =
        abs_C[0][j] * a.half[0] + abs_C[1][j] * a.half[1] + abs_C[2][j] * a.half[2];
    by_b += square(std::abs(apart) - (b.half[j] + reach + X.box_pad));
  }
  if (by_a > 0 || by_b > 0) return std::sqrt(std::max(by_a, by_b));
  double widest = -kInfinity;
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      const double apart = std::abs(C[i2][kCenter] * C[i1][j] - C[i1][kCenter] * C[i2][j]);
      const double own = a.half[i1] * abs_C[i2][j] + a.half[i2] * abs_C[i1][j];
      const double reach = b.half[j1] * abs_C[i][j2] + b.half[j2] * abs_C[i][j1];
      widest = std::max(widest, apart - (own + reach + 2 * X.box_pad));
    }
  }
  return widest;
}

}  // namespace

[[gnu::hot]] double rootBound(const TreeRoot& a, const TreeRoot& b, const TreePose& X_AB,
                              double required) {
  return betweenBoxes(RootBox(a.root_box), RootBox(b.root_box), X_AB, required);
}

}  // namespace kios::engine
