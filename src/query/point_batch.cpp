// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/point_batch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "fcl_kios/volume.h"
#include "query/threads.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Puts two zeros behind each of 21 bits.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32U) & 0x1F00000000FFFFU;
  v = (v | v << 16U) & 0x1F0000FF0000FFU;
  v = (v | v << 8U) & 0x100F00F00F00F00FU;
  v = (v | v << 4U) & 0x10C30C30C30C30C3U;
  return (v | v << 2U) & 0x1249249249249249U;
}

}  // namespace

void requireValidPoint(const Pointd& p, Eigen::Index column) {
  const bool valid = p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate<double>;
  if (!valid) {
    refuse("the point of column ", column, " is ", p.transpose(), ", but must be ",
           kCoordinateRange<double>, ".");
  }
}

PointBatch::PointBatch(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                       const PointRequest& request)
    : points_(points), X_WM_(request.X_WM), inverse_(request.X_WM.linear().inverse()) {
  const RelativePose<double> rigid(X_WM_.linear(), X_WM_.translation());  // or it throws
  require(request.within >= 0, "`within`", request.within, "0 or more");
  for (Eigen::Index i = 0; i < points.cols(); ++i) requireValidPoint(points.col(i), i);
  constexpr std::size_t kFew = 256;  // points, which no thread is worth
  num_threads_ =
      std::min(threadsFor(request.threads), 1 + static_cast<std::size_t>(points.cols()) / kFew);
}

void PointBatch::requireSize(Eigen::Index size, const char* array) const {
  if (size == points_.cols()) return;
  refuse("there are ", points_.cols(), " points, but the array of ", array, " has room for ", size,
         ".");
}

Pointd PointBatch::inModel(Eigen::Index column) const {
  return detail::rotate<double>(inverse_, points_.col(column) - X_WM_.translation());
}

Pointd PointBatch::toPoints(const Pointd& p_M) const {
  return detail::transform<double>(X_WM_, p_M);
}

std::vector<std::pair<std::uint64_t, Eigen::Index>> PointBatch::alongCurve() const {
  constexpr double kCells = 1U << 21U;
  std::vector<std::pair<std::uint64_t, Eigen::Index>> keys(
      static_cast<std::size_t>(points_.cols()));
  const Pointd low = points_.rowwise().minCoeff(), high = points_.rowwise().maxCoeff();
  // Halves, so that no difference overflows.
  const double extent = (0.5 * high - 0.5 * low).maxCoeff();
  const double per_cell = extent > 0x1p-900 ? 0.5 * kCells * (1 - 0x1p-40) / extent : 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i].second = static_cast<Eigen::Index>(i);
    for (int c = 0; c < 3; ++c) {
      const double at = (0.5 * points_(c, keys[i].second) - 0.5 * low[c]) * per_cell * 2;
      keys[i].first |= spread(static_cast<std::uint64_t>(std::min(at, kCells - 1))) << (2U - c);
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

void PointBatch::forAll(const std::function<Look()>& make_look) const {
  if (points_.cols() == 0) return;
  const auto order = alongCurve();
  inThreads(num_threads_, num_threads_, [&](std::size_t share) {
    const Look look = make_look();
    const std::size_t end = (share + 1) * order.size() / num_threads_;
    for (std::size_t i = share * order.size() / num_threads_; i < end; ++i) look(order[i].second);
  });
}

}  // namespace kios
