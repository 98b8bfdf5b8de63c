// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/point_rows.h"

#include <algorithm>
#include <limits>

#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/point_rows.cpp"
#include <hwy/foreach_target.h>  // NOLINT(llvm-include-order)
#include <hwy/highway.h>         // NOLINT(llvm-include-order)

HWY_BEFORE_NAMESPACE();
namespace kios::shape::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
constexpr D d;

/// Products with a vector, never fused, so that all machines give the same.
struct Along {
  HWY_INLINE explicit Along(const double* v)
      : x(hn::Set(d, v[0])), y(hn::Set(d, v[1])), z(hn::Set(d, v[2])) {}

  HWY_INLINE V operator()(const double* rows, size_t count, size_t i) const {
    const V xs = hn::Mul(hn::LoadU(d, rows + i), x);
    const V ys = hn::Mul(hn::LoadU(d, rows + count + i), y);
    return hn::Add(hn::Add(xs, ys), hn::Mul(hn::LoadU(d, rows + 2 * count + i), z));
  }

  V x, y, z;
};

/// The index of the first of the largest of `count` values, a multiple of 8, and that value.
template <class Values>
HWY_INLINE size_t firstLargest(size_t count, const Values& values, double& most) {
  constexpr size_t kChunk = 256;
  const size_t width = hn::Lanes(d);
  HWY_ALIGN double of_chunk[kChunk];
  most = -std::numeric_limits<double>::infinity();
  size_t best = 0;
  for (size_t from = 0; from < count; from += kChunk) {
    const size_t size = count - from < kChunk ? count - from : kChunk;
    V largest = hn::Set(d, most);
    for (size_t i = 0; i < size; i += width) {
      const V value = values(from + i);
      hn::Store(value, d, of_chunk + i);
      largest = hn::Max(value, largest);
    }
    const double here = hn::GetLane(hn::MaxOfLanes(d, largest));
    if (!(here > most)) continue;
    most = here;
    const V wanted = hn::Set(d, most);
    for (size_t i = 0; i < size; i += width) {
      const auto first = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, of_chunk + i), wanted));
      if (first < 0) continue;
      best = from + i + static_cast<size_t>(first);
      break;
    }
  }
  return best;
}

size_t farthestOf(const double* HWY_RESTRICT rows, size_t count, const double* HWY_RESTRICT n) {
  const Along along(n);
  double most;
  return firstLargest(
      count, [&](size_t i) HWY_ATTR { return along(rows, count, i); }, most);
}

size_t highestOver(const double* HWY_RESTRICT normals, const double* HWY_RESTRICT offsets,
                   size_t count, const double* HWY_RESTRICT triangle, double* HWY_RESTRICT most) {
  const Along a(triangle), b(triangle + 3), c(triangle + 6);
  const auto height = [&](size_t i) HWY_ATTR {
    const V low =
        hn::Min(hn::Min(a(normals, count, i), b(normals, count, i)), c(normals, count, i));
    return hn::Sub(low, hn::LoadU(d, offsets + i));
  };
  return firstLargest(count, height, *most);
}

}  // namespace kios::shape::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::shape {

HWY_EXPORT(farthestOf);
HWY_EXPORT(highestOver);

PointRows::PointRows(const std::vector<Point<double>>& points) {
  constexpr std::size_t kWidest = 8;
  const std::size_t count = (points.size() + kWidest - 1) / kWidest * kWidest;
  rows_.resize(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Point<double>& p = points[std::min(i, points.size() - 1)];
    rows_[i] = p.x();
    rows_[count + i] = p.y();
    rows_[2 * count + i] = p.z();
  }
}

std::size_t PointRows::farthestAlong(const Point<double>& n) const {
  return HWY_DYNAMIC_DISPATCH(farthestOf)(rows_.data(), rows_.size() / 3, n.data());
}

std::size_t PlaneRows::highestOver(const TriangleVertices<double>& t, double& height) const {
  const double corners[9] = {t[0].x(), t[0].y(), t[0].z(), t[1].x(), t[1].y(),
                             t[1].z(), t[2].x(), t[2].y(), t[2].z()};
  return HWY_DYNAMIC_DISPATCH(highestOver)(normals, offsets, count, corners, &height);
}

}  // namespace kios::shape
#endif  // HWY_ONCE
