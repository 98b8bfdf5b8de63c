// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/solid_off_box.h"

#include <cmath>

#include "model/prepared.h"
#include "search/double_bound.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"

namespace kios {

// In double, in the solid's frame: its range, and the root's box with the axes C. Along w content
// reaches to what reachAlong() gives for R^T w, whatever R is; as the box's axes are orthonormal
// but for 4 u, u = 2^-24, |w . C| h is that but for 8 u of h, which tells whether to ask.
template <typename S>
[[gnu::hot]] bool solidOffBox(const Model<S>& model, const PosedSolid<S>& posed) {
  using shape::Vec;
  if (!posed.hasUnit1() || !posed.solid().bounded()) return false;
  engine::TreeRoot root;
  if (!copyRoot(model, root)) return false;
  const engine::Box& box = root.root_box;
  const Eigen::Matrix3d& R = posed.R();
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) axes.col(i) = engine::columnOf(box, i);
  const Eigen::Matrix3d C = R * axes;
  const Vec h(box.half[0], box.half[1], box.half[2]);
  const Eigen::Map<const Vec> origin(root.origin);
  const shape::Range& range = posed.range();
  const Vec half = 0.5 * (range.high - range.low);
  const double margin = posed.solid().margin();
  const Vec middle = 0.5 * (range.high + range.low);
  const Vec center = R * (engine::columnOf(box, engine::kCenter) + origin) + posed.T();
  const Vec way = center - middle;
  const double extent = engine::extentOf(box);
  const double slack = 0x1p-20 * extent;
  const auto isGap = [&](const Vec& w) {
    const double pad = engine::kStored * extent +
                       error_bounds::solidError(2 * (origin.lpNorm<1>() + 2 * extent) +
                                                posed.T().template lpNorm<1>() + posed.reach());
    const double reach = engine::reachAlong(box, R.transpose() * w) + w.cwiseAbs().dot(half);
    return std::abs(w.dot(way)) - reach > (margin + pad) * w.norm();
  };
  for (int k = 0; k < 3; ++k) {
    const double own = std::abs(way[k]) - half[k] - margin - C.row(k).cwiseAbs().dot(h);
    if (own > -slack && isGap(Vec::Unit(k))) return true;
    const Vec w = C.col(k);
    const double other = std::abs(w.dot(way)) - h[k] - margin - w.cwiseAbs().dot(half);
    if (other > -slack && isGap(w)) return true;
  }
  return false;
}

KIOS_INSTANTIATE_FUNCTION(solidOffBox);

}  // namespace kios
