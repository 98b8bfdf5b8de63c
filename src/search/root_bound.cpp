// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/root_bound.h"

#include <algorithm>
#include <cmath>

#include "search/double_bound.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using lanes::Float4;

float widest(Float4 gaps) { return std::max({gaps[0], gaps[1], gaps[2]}); }

float squareOfPositive(Float4 gaps) {
  const Float4 positive = lanes::max(gaps, Float4{});
  const Float4 squares = positive * positive;
  return squares[0] + squares[1] + squares[2];
}

Float4 next(Float4 v) { return Float4{v[1], v[2], v[0], v[3]}; }

int indexOfWidest(Float4 gaps) {
  const float least = widest(gaps);
  return gaps[0] == least ? 0 : gaps[1] == least ? 1 : 2;
}

}  // namespace

// The bound of simd/box_test-inl.h along the axes of both boxes, and along their products where
// that proves nothing: the same sums in floats, a coordinate or an axis a lane in place of a pair
// of boxes. box_pad is for both; the centre's way from a's is subtracted once, in double, before it
// is rounded, which takes less of it. Where floats are too coarse, the same axes tell it in double.
[[gnu::hot]] double rootBound(const TreeRoot& root_a, const TreeRoot& root_b, const TreePose& X,
                              double required) {
  const Box &a = root_a.root_box, &b = root_b.root_box;
  const Float4 half_a = lanes::load(a.half), half_b = lanes::load(b.half);
  const Float4 pad = lanes::broadcast(roundUpFloat(X.box_pad));
  const Float4 bx = lanes::load(b.x), by = lanes::load(b.y), bz = lanes::load(b.z);
  const float center_a[3] = {a.x[kCenter], a.y[kCenter], a.z[kCenter]};
  const Eigen::Matrix3f R = X.R.cast<float>();
  Float4 moved[3], C[3],
      abs_C[3];  // b's axes and the way to its centre in a's frame; along a's axes
  for (int i = 0; i < 3; ++i) {
    const float from_a = static_cast<float>(X.t[i] - double{center_a[i]});
    moved[i] = (R(i, 0) * bx + R(i, 1) * by) + (R(i, 2) * bz + Float4{0, 0, 0, from_a});
  }
  for (int i = 0; i < 3; ++i) {
    C[i] = a.x[i] * moved[0] + a.y[i] * moved[1] + a.z[i] * moved[2];
    abs_C[i] = lanes::abs(C[i]);
  }
  const lanes::Columns columns(abs_C[0], abs_C[1], abs_C[2]);
  const Float4 along_a = columns.at[kCenter];
  if (!lanes::any(along_a > half_a)) return 0;  // b's centre is in a's box, as a link's in a room
  const Float4 reach_b =
      columns.at[0] * b.half[0] + columns.at[1] * b.half[1] + columns.at[2] * b.half[2];
  const Float4 gaps_a = along_a - (half_a + pad + reach_b);
  if (widest(gaps_a) > required) return widest(gaps_a);
  const Float4 along_b =
      moved[0] * moved[0][kCenter] + moved[1] * moved[1][kCenter] + moved[2] * moved[2][kCenter];
  const Float4 reach_a = abs_C[0] * a.half[0] + abs_C[1] * a.half[1] + abs_C[2] * a.half[2];
  const Float4 gaps_b = lanes::abs(along_b) - (half_b + pad + reach_a);
  if (widest(gaps_b) > required) return widest(gaps_b);
  const float squared = std::max(squareOfPositive(gaps_a), squareOfPositive(gaps_b));
  if (squared > 0) return std::sqrt(double{squared});
  // Bounds are off by twice a pad at most: what is farther from 0 is no gap. Where faces are as
  // near as that, products of axes tell nothing more, which are mostly across them.
  const auto inDouble = [&] { return DoubleBound(a, b, X); };
  const float open = -2 * pad[0];
  const bool a_open = widest(gaps_a) > open, b_open = widest(gaps_b) > open;
  double bound = 0;
  if (a_open) bound = inDouble().alongA(indexOfWidest(gaps_a));
  if (bound > 0) return bound;
  if (b_open) bound = inDouble().alongB(indexOfWidest(gaps_b));
  if (bound > 0) return bound;
  const Float4 next_b = next(half_b), last_b = next(next_b);
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const Float4 apart = lanes::abs(C[i2][kCenter] * C[i1] - C[i1][kCenter] * C[i2]);
    const Float4 own = a.half[i1] * abs_C[i2] + a.half[i2] * abs_C[i1];
    const Float4 next_C = next(abs_C[i]);
    const Float4 reach = next_b * next(next_C) + last_b * next_C;
    const Float4 gaps = apart - (own + pad + pad + reach);
    double gap = double{widest(gaps)};
    if (gap <= 0 && gap > 2 * open && !a_open && !b_open)
      gap = inDouble().acrossEdges(i, indexOfWidest(gaps));
    bound = std::max(bound, gap);
  }
  return bound;
}

}  // namespace kios::engine
