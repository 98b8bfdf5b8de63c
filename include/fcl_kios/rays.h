// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <fcl/common/types.h>
#include "fcl_kios/detail/counts.h"
#include "fcl_kios/model.h"
#include "fcl_kios/volume.h"

// Rays against k-IOS and against meshes over k-IOS: the paper's future work (VI).

namespace kios {

/// The points origin + t direction, t_min <= t <= t_max. The direction need not be a unit vector: t
/// counts directions, not lengths. t_max may be infinite, which means the largest finite S.
template <typename S>
struct Ray {
  fcl::Vector3<S> origin = fcl::Vector3<S>::Zero();
  fcl::Vector3<S> direction = fcl::Vector3<S>::UnitX();
  S t_min = 0;
  S t_max = std::numeric_limits<S>::infinity();
};
using Rayd = Ray<double>;
using Rayf = Ray<float>;

// All functions below throw std::invalid_argument, naming what is wrong, if a ray has an origin or
// direction that is not finite or exceeds 2^1000 (float: 2^120) in a coordinate, a direction of
// zero, a t_min that is not finite, a t_max that is NaN, or t_min > t_max.

/// Part of a ray, by its parameter.
template <typename S>
struct RayInterval {
  S enter, exit;  ///< enter <= exit, in the ray's t
};
using RayIntervald = RayInterval<double>;
using RayIntervalf = RayInterval<float>;

/// Returns the part of a ray in the volume's frame that may lie in the volume: a lower bound of the
/// t at which it has entered all k spheres, and an upper bound of the t at which it leaves the
/// first, both within [t_min, t_max]; none if the ray provably misses the volume. No point of the
/// content that lies on the ray is ever left out. No wider than for spheres larger by 2^-45
/// (|origin - c| + reach), as much longer at both ends, c and reach the centre of S0 and what the
/// spheres reach from there.
template <typename S>
std::optional<RayInterval<S>> rayInterval(const kIOS<S>& bv, const Ray<S>& ray);

/// Returns true if rayInterval() finds an interval.
template <typename S>
bool overlap(const Ray<S>& ray, const kIOS<S>& bv);

/// Names the side of the triangle that a ray hits; its normal is (p1 - p0) x (p2 - p0).
enum class RaySide {
  kFront,  ///< the ray goes against the normal
  kBack,   ///< the ray goes with the normal
  kEdgeOn  ///< the ray lies in the triangle's plane, or the triangle is a segment or a point
};

/// Says where a ray meets a triangle.
template <typename S>
struct RayHit {
  /// Parameter at which the ray first meets the closed triangle: exact, rounded once to double (and
  /// then to S). Triangles that are hit in one point have bitwise one t.
  S t;
  /// That point in the world, to 8 eps (S) of the triangle's coordinates there and in the model.
  fcl::Vector3<S> point;
  /// Its barycentric coordinates: >= 0, each to 2^-50 (float: and one rounding).
  fcl::Vector3<S> weights;
  int triangle;  ///< index in the model
  RaySide side;  ///< exact
};
using RayHitd = RayHit<double>;
using RayHitf = RayHit<float>;

/// Finds the first triangle that a ray meets: the hit with the least t, of equal ones the least
/// triangle; none if the ray misses the model. X_WM is the model's pose in the world, the ray's
/// frame.
///
/// Verdicts are exact, for the ray as mapped into the model's frame: origin to R^-1 (origin - T),
/// direction to R^-1 direction, R as given. The identity maps exactly; other poses move a
/// coordinate of the origin by at most 2^-48 |origin - T|_1, of the direction by 2^-48
/// |direction|_1. Triangles are closed: a ray through an edge or a vertex hits every triangle
/// there, so that nothing passes between triangles that share it. A ray in a triangle's plane hits
/// it in the first point that they share, segments and points (degenerate triangles) likewise.
///
/// Safe from many threads. `counts`, if given, is added to (leaf_pairs: leaves reached; exact:
/// triangles tested). Throws std::invalid_argument also if the model is not a finished mesh or the
/// pose is not rigid.
template <typename S>
std::optional<RayHit<S>> firstHit(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                                  const Ray<S>& ray, SearchCounts* counts = nullptr);

/// Returns true if firstHit() finds a hit, in less time.
template <typename S>
bool anyHit(const Model<S>& model, const fcl::Transform3<S>& X_WM, const Ray<S>& ray,
            SearchCounts* counts = nullptr);

/// Lists every triangle that the ray meets, once, by t and then by triangle; of more than `limit`
/// the first.
template <typename S>
std::vector<RayHit<S>> allHits(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                               const Ray<S>& ray,
                               std::size_t limit = std::numeric_limits<std::size_t>::max(),
                               SearchCounts* counts = nullptr);

}  // namespace kios
