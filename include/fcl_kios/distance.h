// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <type_traits>

#include <fcl/common/types.h>
#include "fcl_kios/detail/counts.h"
#include "fcl_kios/model.h"

// Distance of two meshes with what FCL's request can't say: a proven bracket instead of a number,
// bounds at which to stop, a budget, a start from the last frame's answer.

namespace kios {

/// Triangles of an earlier answer, from which a search may start: the caller's, one for each pair
/// of models. Any content is allowed; ids that a model doesn't have are ignored. An exact answer
/// (both tolerances 0, no budget, not stopped by near_enough or far_enough) is bitwise the same
/// with and without, but that of hundreds of equally near pairs another may be named.
struct WarmStart {
  int triangle_a = -1, triangle_b = -1;
};

/// Options of a distance query. The search stops as soon as one of these holds; the defaults ask
/// for the exact distance. Lengths are in the models' units.
template <typename S>
struct DistanceBracketRequest {
  /// The distance may exceed the exact one by max(rel_err * exact, abs_err): either suffices. >= 0.
  S rel_err = 0, abs_err = 0;
  /// Ends the search once the models are proven at least so far apart. Not NaN; nothing is looked
  /// at if <= 0.
  S far_enough = std::numeric_limits<S>::infinity();
  /// Ends the search once two triangles at most so far apart are found. Not NaN.
  S near_enough = 0;
  /// Ends the search after this many expanded pairs of nodes. A larger budget never gives a larger
  /// distance or a smaller lower bound; upper_bound may differ by its own rounding term. >= 0.
  long long max_expansions = std::numeric_limits<long long>::max();
  /// If true, the nearest points of the answer are set.
  bool nearest_points = true;
  /// Read at the start, and set to the answer's triangles if there are any. No other thread may use
  /// it meanwhile.
  WarmStart* warm_start = nullptr;
};
using DistanceBracketRequestd = DistanceBracketRequest<double>;
using DistanceBracketRequestf = DistanceBracketRequest<float>;
template <typename S>
using DistanceOptions [[deprecated("now DistanceBracketRequest")]] = DistanceBracketRequest<S>;
using DistanceOptionsd [[deprecated("now DistanceBracketRequest")]] = DistanceBracketRequestd;
using DistanceOptionsf [[deprecated("now DistanceBracketRequest")]] = DistanceBracketRequestf;

/// Says why a search ended; if several hold, the first of them.
enum class DistanceStop {
  kTolerance,  ///< the distance is as exact as the options want
  kFar,        ///< lower_bound >= far_enough
  kNear,       ///< distance <= near_enough
  kBudget      ///< the budget was spent before any of these, or, with a budget, the distance is
               ///< within rounding of far_enough and nothing more was looked at
};

/// Answer of a distance query. In every case lower_bound <= exact distance <= upper_bound, for the
/// models' vertices and poses as they are given, in the common frame of docs/guarantees.md.
template <typename S>
struct DistanceBracketResult {
  /// Distance of the triangles below, right to 16 eps of their extent. It is 0 if and only if they
  /// intersect. Infinity if no pair of triangles was looked at.
  S distance = std::numeric_limits<S>::infinity();
  S lower_bound = 0;  ///< proven; 0 at contact
  /// `distance` with its own error and the common frame's; infinity if that is.
  S upper_bound = std::numeric_limits<S>::infinity();
  int triangle_a = -1, triangle_b = -1;  ///< of the models; -1 if no pair was looked at
  /// Nearest points of those triangles in the world frame: NaN if there are none, or none were
  /// asked for.
  fcl::Vector3<S> point_a = fcl::Vector3<S>::Constant(std::numeric_limits<S>::quiet_NaN());
  fcl::Vector3<S> point_b = fcl::Vector3<S>::Constant(std::numeric_limits<S>::quiet_NaN());
  DistanceStop stop = DistanceStop::kTolerance;
  SearchCounts counts;  ///< work done
};
using DistanceBracketResultd = DistanceBracketResult<double>;
using DistanceBracketResultf = DistanceBracketResult<float>;
template <typename S>
using DistanceAnswer [[deprecated("now DistanceBracketResult")]] = DistanceBracketResult<S>;
using DistanceAnswerd [[deprecated("now DistanceBracketResult")]] = DistanceBracketResultd;
using DistanceAnswerf [[deprecated("now DistanceBracketResult")]] = DistanceBracketResultf;

/// Finds the distance of two meshes at poses X_WA, X_WB in the world. Where both tolerances are 0
/// and nothing else stops the search, `distance` and the triangles are fcl::distance's. Safe from
/// many threads. Throws std::invalid_argument if a model is not a finished mesh, a pose is not
/// rigid, or an option is out of range. Source of the search: paper, Algorithm 2 and IV, best
/// first.
template <typename S>
DistanceBracketResult<S> distanceBracket(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                         const Model<S>& b, const fcl::Transform3<S>& X_WB,
                                         const DistanceBracketRequest<S>& options = {});
template <typename S>
[[deprecated("now distanceBracket")]] DistanceBracketResult<S> distance(
    const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
    const fcl::Transform3<S>& X_WB, const DistanceBracketRequest<S>& options = {}) {
  return distanceBracket(a, X_WA, b, X_WB, options);
}

/// Returns true if and only if the models are at most t apart: the exact
/// distanceBracket(...).distance is <= t, bit for bit. If the answer is clear, this is much faster:
/// a pair of triangles nearer than t ends the search, and all pairs that are farther are left out.
/// False for t < 0, true for +infinity. Throws as distanceBracket() does, and if t is NaN.
///
/// The certificate, if asked for, proves the verdict: a pair of triangles with distance <= t, or
/// lower_bound > t; where t is within rounding of the distance, an exact answer decides. Its points
/// are not set.
template <typename S>
bool closerThan(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                const fcl::Transform3<S>& X_WB, std::common_type_t<S> t,
                std::common_type_t<DistanceBracketResult<S>>* certificate = nullptr,
                WarmStart* warm_start = nullptr);

}  // namespace kios
