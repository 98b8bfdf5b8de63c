// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/exit_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include "solid/tuning.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds the translations that the plane between two nearest points admits: normal . x >= least.
struct Plane {
  Vec normal;
  double least;
};

/// Holds the translation beyond some planes that is nearest to the origin, in a's frame.
struct Corner {
  Vec x = Vec::Zero();
  std::vector<Plane> active;  ///< those of the planes that make it: up to three
};

/// Returns the corner of the planes if it is nearer than `most`: of those that one, two or three
/// planes alone would have. If `by_first`, the first plane is known to be one of these.
std::optional<Corner> nearestToOrigin(const std::vector<Plane>& planes, double most,
                                      bool by_first) {
  constexpr double kFlat = 1e-9, kRounding = 1e-12;
  std::optional<Corner> best;
  double least = most * most;
  fcl::Matrix3d basis;  // orthonormal, of the normals of those so far
  std::array<Plane, 3> so_far;
  const auto extend = [&](const auto& self, const Vec& x, int size, std::size_t from) -> void {
    const double square = x.squaredNorm();
    if (!(square < least)) return;  // more planes take it farther
    if ((size > 0 || !by_first) && std::all_of(planes.begin(), planes.end(), [&](const Plane& p) {
          return p.normal.dot(x) >= p.least - kRounding * std::sqrt(square);
        })) {
      least = square;
      best = {x, {so_far.begin(), so_far.begin() + size}};
    }
    const std::size_t end = size == 3 ? 0 : size == 0 && by_first ? 1 : planes.size();
    for (std::size_t i = from; i < end; ++i) {
      const Plane& p = planes[i];
      Vec across = p.normal;
      for (int k = 0; k < size; ++k) across -= basis.col(k).dot(p.normal) * basis.col(k);
      const double length = across.norm();
      if (!(length > kFlat)) continue;
      basis.col(size) = across / length;
      so_far[static_cast<std::size_t>(size)] = p;
      self(self, x + (p.least - p.normal.dot(x)) / length * basis.col(size), size + 1, i + 1);
    }
  };
  extend(extend, Vec::Zero(), 0, 0);
  return best;
}

/// Holds the translations of b, in a's frame, after which two triangles that meet still do: the
/// polytope of their differences, within planes of both faces, each on both sides, and of pairs of
/// edges.
class DifferencePolytope {
 public:
  /// The triangles meet after a translation by x.
  DifferencePolytope(const TriangleVerticesd& a, const TriangleVerticesd& b, const Vec& x) {
    const Vec normal_a = normalOf(a), normal_b = normalOf(b);
    const auto add = [&](const Vec& n) {
      const double square = n.squaredNorm();
      if (!(square > kParallel)) return;
      const Vec u = n / std::sqrt(square);
      planes_[count_++] = {u, std::max({u.dot(a[0]), u.dot(a[1]), u.dot(a[2])}) -
                                  std::min({u.dot(b[0] - x), u.dot(b[1] - x), u.dot(b[2] - x)})};
    };
    for (const Vec& n : {normal_a, normal_b}) {
      add(n);
      add(-n);
    }
    const bool parallel = normal_a.cross(normal_b).squaredNorm() < kParallel;
    for (int i = 0; i < 3; ++i) {
      const Vec &p = a[i], &to_a = a[(i + 2) % 3], e = (a[(i + 1) % 3] - p).normalized();
      if (parallel) add(e.cross(normal_a));
      for (int j = 0; j < 3; ++j) {
        const Vec &q = b[j], f = (b[(j + 1) % 3] - q).normalized();
        if (parallel) {
          if (i == 0) add(normal_b.cross(f));
          continue;
        }
        // Between both edges the triangles must lie on different sides.
        const Vec n = e.cross(f);
        const double side_a = n.dot(to_a - p), side_b = n.dot(b[(j + 2) % 3] - q);
        if (side_a <= 0 && side_b >= 0) add(n);
        if (side_a >= 0 && side_b <= 0) add(-n);
      }
    }
  }

  /// Returns how far a translation is from the nearest one that parts them, or something below
  /// `least`; at most 0 if it does.
  double depth(const Vec& x, double least) const {
    double depth = kInfinity;
    for (int i = 0; i < count_ && depth > least; ++i) {
      depth = std::min(depth, planes_[i].least - planes_[i].normal.dot(x));
    }
    return depth;
  }

  const Plane* begin() const { return planes_; }
  const Plane* end() const { return planes_ + count_; }

 private:
  static constexpr double kParallel = 1e-12;
  Plane planes_[22];
  int count_ = 0;
};

}  // namespace

std::vector<Vec> meanDirections(SolidPair& pair) {
  std::vector<Vec> directions;
  const auto add = [&](const Vec& v) {
    if (v.norm() > 1e-6) directions.push_back(v.normalized());
  };
  Vec out_of_a = Vec::Zero(), out_of_b = Vec::Zero();
  for (const auto& contact : pair.overlap().contacts) {
    out_of_a += normalOf(contact.a);
    out_of_b -= normalOf(contact.b);
  }
  add(out_of_a);
  add(out_of_b);
  if (pair.overlap().to_wall) add(*pair.overlap().to_wall / pair.size());
  if (directions.empty()) directions.emplace_back(Vec::UnitX());
  return directions;
}

void ExitSearch::leaveHulls(const Differences& differences, const std::vector<Vec>& directions) {
  Vec best = Vec::UnitX();
  double least = kInfinity;
  for (const Vec& n : directions) {
    const double height = differences.height(n);
    if (!(height < least)) continue;
    least = height;
    best = n;
  }
  constexpr int kFarOut = 60;
  if (!goAlong(pair_.inWorld(best), least, kFarOut)) {
    refuse<std::logic_error>("no translation parts the hulls of two solids.");
  }
}

/// Goes `length` along n, unit, in the world, and a little farther for rounding. Gives up where
/// that is no shorter than the best exit, up to which nearest points are looked for.
bool ExitSearch::goAlong(const Vec& n, double length, int tries) {
  double margin = 8 * pair_.rounding();
  for (int i = 0; i < tries; ++i, margin *= 4) {
    const Vec x = (std::max(length, 0.0) + margin) * n;
    if (!(x.norm() < best_.length)) break;
    const Separation after = pair_.test(x, std::min(best_.length, pair_.size()));
    if (!after.apart) continue;
    best_ = {x, x.norm(), after};
    return true;
  }
  return false;
}

bool ExitSearch::leaveByPlanes(long long last_test) {
  last_test_ = last_test;
  std::vector<Corner> queue(1);
  const auto farther = [](const Corner& p, const Corner& q) {
    return p.x.squaredNorm() > q.x.squaredNorm();
  };
  std::vector<DifferencePolytope> polytopes;
  std::vector<Vec> seen;
  constexpr double kBeyond = 1e-10, kSame = 1e-12;
  while (!queue.empty() && seen.size() < tuning::kCorners) {
    std::pop_heap(queue.begin(), queue.end(), farther);
    const Corner corner = std::move(queue.back());
    queue.pop_back();
    const Vec& x = corner.x;
    const double length = x.norm(), most = tuning::kEnough * best_.length;
    if (!(length < most)) return true;
    if (std::any_of(seen.begin(), seen.end(), [&](const Vec& other) {
          return (other - x).squaredNorm() <= kSame * length * length;
        })) {
      continue;
    }
    seen.push_back(x);
    const DifferencePolytope* deepest = nullptr;
    const auto findDeepest = [&](std::size_t from, double depth) {
      for (std::size_t i = from; i < polytopes.size(); ++i) {
        const double d = polytopes[i].depth(x, depth);
        if (!(d > depth)) continue;
        depth = d;
        deepest = &polytopes[i];
      }
    };
    findDeepest(0, 0);
    if (!deepest) {  // triangles that met once spare most tests
      if (exhausted()) return false;
      const std::size_t known = polytopes.size();
      const auto overlap =
          known == 0 ? pair_.overlap() : pair_.overlapAfter(pair_.inWorld(x), tuning::kContacts);
      if (!overlap.any() && goAlong(pair_.inWorld(x) / length, length, 1)) return true;
      for (const auto& contact : overlap.contacts) polytopes.emplace_back(contact.a, contact.b, x);
      findDeepest(known, -kInfinity);  // some only touch
    }
    if (!deepest) continue;
    for (Plane plane : *deepest) {
      plane.least += 4 * pair_.rounding() + kBeyond * std::abs(plane.least);
      if (!(plane.normal.dot(x) < plane.least)) continue;
      std::vector<Plane> planes = {plane};
      planes.insert(planes.end(), corner.active.begin(), corner.active.end());
      auto next = nearestToOrigin(planes, most, true);
      if (!next) continue;
      queue.push_back(std::move(*next));
      std::push_heap(queue.begin(), queue.end(), farther);
    }
  }
  return queue.empty() && !polytopes.empty();
}

void ExitSearch::leaveByBalls(const BallPairs& balls, long long last_test) {
  last_test_ = last_test;
  tryStarts(balls);
  descend(balls);
}

/// Looks about places where inner balls, grown by what they leave out, part: on the way to where
/// the hulls are apart.
void ExitSearch::tryStarts(const BallPairs& balls) {
  std::vector<Vec> starts;
  const auto add = [&](const Vec& n, double share) {
    starts.push_back(balls.escape(share * pair_.size() * n));
  };
  for (const Vec& n : meanDirections(pair_)) {
    add(n, tuning::kNear);
    add(n, tuning::kFar);
  }
  for (int c = 0; c < 3; ++c) {
    add(Vec::Unit(c), tuning::kFar);
    add(-Vec::Unit(c), tuning::kFar);
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Vec& a, const Vec& b) { return a.squaredNorm() < b.squaredNorm(); });
  Vec best = best_.translation;
  for (const Vec& start : starts) {
    for (const double grow : {0.95, 1.15, 1.6}) {
      const Vec x = pair_.inWorld(grow * start);
      if (!(x.norm() < 0.97 * best.norm()) || exhausted()) break;
      if (balls.meet(grow * start) || pair_.overlapAfter(x, 1).any()) continue;
      best = x;
      break;
    }
  }
  if (best != best_.translation) goAlong(best.normalized(), best.norm(), 1);
}

// The planes between nearest points bound where b may go without passing a there, as long as it
// doesn't turn another corner of a: so the nearest translation that they all admit is a guess,
// and a test decides.
void ExitSearch::descend(const BallPairs& balls) {
  constexpr std::size_t kPlanes = 3;  // make a corner of space
  std::vector<Plane> planes;
  while (!exhausted()) {
    const auto [at, length, after] = best_;
    if (after.nearest) {
      planes.push_back({after.normal, after.normal.dot(at) - after.gap + 4 * pair_.rounding()});
      if (planes.size() > kPlanes) planes.erase(planes.begin());
    }
    if (planes.empty()) planes.push_back({at.normalized(), 0.5 * length});
    const double most = tuning::kEnough * length;
    auto nearest = nearestToOrigin(planes, most, false);
    if (!nearest) {
      // The planes admit nothing shorter. The last one alone may: the others are of places that
      // no longer matter.
      planes.erase(planes.begin(), planes.end() - 1);
      nearest = nearestToOrigin(planes, most, false);
    }
    if (!nearest) break;
    Vec guess = nearest->x;
    Separation next;
    for (int i = 0; i < 3 && !next.apart && !exhausted(); ++i) {
      guess = i == 0 ? guess : Vec(0.5 * (at + guess));
      if (!balls.meet(pair_.vectorInA(guess))) next = pair_.test(guess, length);
    }
    if (!next.apart || !(guess.norm() < length)) break;
    best_ = {guess, guess.norm(), next};
    if (!(best_.length < tuning::kEnough * length)) break;
  }
}

}  // namespace kios
