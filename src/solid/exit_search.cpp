// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/exit_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds the translations that the plane between two nearest points admits: normal . x >= least.
struct Plane {
  Vec normal;
  double least;
};

/// Returns the point of all half-spaces that is nearest to the origin, to about a percent:
/// Hildreth's method.
Vec nearestToOrigin(const std::vector<Plane>& planes) {
  std::vector<double> weights(planes.size(), 0.0);
  Vec x = Vec::Zero();
  constexpr int kSweeps = 60;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double weight = std::max(0.0, weights[i] + planes[i].least - planes[i].normal.dot(x));
      x += (weight - weights[i]) * planes[i].normal;
      weights[i] = weight;
    }
  }
  return x;
}

template <typename S>
class ExitSearch {
 public:
  ExitSearch(SolidPair<S>& pair, const BallPairs& balls, const Exit& exit, long long last_test)
      : pair_(pair), balls_(balls), best_(exit), last_test_(last_test) {}

  Exit nearby(const std::vector<Vec>& directions) {
    descend(stepOut(directions));
    shortenToRounding();
    return best_;
  }

  Exit anywhere(const std::vector<Vec>& directions, const std::vector<BallPairs::Way>& ways) {
    descend(tryStarts(directions, ways));
    return best_;
  }

 private:
  using Test = typename SolidPair<S>::Test;

  bool exhausted() const { return pair_.tests() >= last_test_; }

  bool accept(const Vec& x, const Test& test) {
    const double length = x.norm();
    if (!test.apart || !(length < best_.length)) return false;
    best_.translation = x;
    best_.length = length;
    if (test.nearest) best_.on_a = test.on_a;
    return true;
  }

  Vec rounded(const Vec& x) const { return x.template cast<S>().template cast<double>(); }

  bool seemsApart(const Vec& x) {  // balls that meet spare the search
    return !balls_.meet(pair_.R_WA().transpose() * x) && pair_.seemsApart(x);
  }

  /// Bodies that only just overlap leave by a small step, though a larger one may meet something
  /// else.
  Vec stepOut(const std::vector<Vec>& directions) {
    constexpr std::size_t kFirst = 3;
    const double length = best_.length;
    for (std::size_t i = 0; i < std::min(kFirst, directions.size()); ++i) {
      for (double share = 1.0 / 512; share < 0.6 && !exhausted(); share *= 4) {
        const Vec x = rounded(share * length * directions[i]);
        if (x.norm() > 16 * pair_.rounding() && seemsApart(x)) return x;
      }
    }
    return best_.translation;
  }

  /// Shortens it for bodies that all but touch: to the least length that can be proven.
  void shortenToRounding() {
    if (!(best_.length < 1e-6 * pair_.size())) return;
    const Vec n = best_.translation / best_.length;
    for (double length = 16 * pair_.rounding(); length < 0.5 * best_.length; length *= 4) {
      const Vec x = rounded(length * n);
      if (accept(x, pair_.test(x, best_.length))) return;
    }
  }

  /// Moves b towards the origin by a little less than the gap: surfaces stay apart as b moves by
  /// less than their distance. Poses are rounded, so that b's true way is measured.
  void slide(const Vec& at, const Test& test) {
    const double length = at.norm(), step = std::min(0.98 * test.gap, length);
    if (!(step > 1e-3 * length)) return;
    const Vec x = rounded((1 - step / length) * at);
    if (pair_.wayBetween(at, x) < 0.99 * test.gap - 16 * pair_.rounding()) accept(x, test);
  }

  /// Calls test(), unless inner balls meet.
  Test testOf(const Vec& x) {
    if (balls_.meet(pair_.R_WA().transpose() * x)) return {};
    return pair_.test(x, best_.length);
  }

  /// Returns the shortest translation that seems to part the solids, of those about which their
  /// balls part.
  Vec tryStarts(const std::vector<Vec>& directions, const std::vector<BallPairs::Way>& ways) {
    Vec best = best_.translation;
    const auto tryStart = [&](const Vec& start) {
      for (const double grow : {0.95, 1.15, 1.6}) {
        const Vec x = rounded(grow * start);
        if (!(x.norm() < 0.97 * best.norm()) || exhausted()) break;
        if (!(x.norm() > 16 * pair_.rounding()) || !seemsApart(x)) continue;
        best = x;
        break;
      }
    };
    for (const Vec& wall : pair_.walls()) tryStart(wall);
    for (const Vec& start : startsOf(directions, ways)) tryStart(start);
    return best;
  }

  /// Returns a few, the shortest first.
  std::vector<Vec> startsOf(const std::vector<Vec>& directions,
                            const std::vector<BallPairs::Way>& ways) const {
    std::vector<Vec> starts;
    const auto add = [&](const Vec& x_A) {
      const Vec x = pair_.R_WA() * x_A;
      if (!(x.norm() < best_.length)) return;
      for (const Vec& other : starts) {
        if ((x - other).norm() < 0.1 * best_.length) return;
      }
      starts.push_back(x);
    };
    constexpr std::size_t kStraight = 6, kBent = 3, kByContacts = 1;
    for (std::size_t i = 0; i < std::min(kStraight, ways.size()); ++i) {
      const Vec x = ways[i].reach * ways[i].direction;
      add(x);
      if (i < kBent) add(balls_.escape(0.5 * x, balls_.gap()));
    }
    for (std::size_t i = 0; i < std::min(kByContacts, directions.size()); ++i) {
      const Vec n = pair_.R_WA().transpose() * directions[i];
      add(balls_.reach(n, 0) * n);
      for (const double grown : {0.0, balls_.gap()}) {
        add(balls_.escape(1e-3 * pair_.size() * n, grown));
      }
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Vec& a, const Vec& b) { return a.norm() < b.norm(); });
    constexpr std::size_t kMost = 6;
    if (starts.size() > kMost) starts.resize(kMost);
    return starts;
  }

  // The planes between nearest points bound where b may go without passing a there, as long as it
  // doesn't turn another corner of a: so the nearest translation that they all admit is a guess,
  // and a test decides.
  void descend(Vec at) {
    std::vector<Plane> planes;
    Test test = pair_.test(at, best_.length);
    for (int i = 0; i < 8 && !test.apart && 4 * at.norm() < best_.length; ++i) {
      at = rounded(4 * at);  // too close to be proven
      test = pair_.test(at, best_.length);
    }
    if (!test.apart) {
      at = best_.translation;
      test = pair_.test(at, best_.length);
      if (test.nearest) best_.on_a = test.on_a;
    }
    accept(at, test);
    constexpr double kEnough = 0.98;
    constexpr std::size_t kPlanes = 6;
    while (!exhausted()) {
      const double before = best_.length;
      if (test.nearest) {
        best_.on_a = test.on_a;
        planes.push_back({test.normal, test.normal.dot(at) - test.gap + 4 * pair_.rounding()});
        if (planes.size() > kPlanes) planes.erase(planes.begin());
      }
      Vec guess = planes.empty() ? Vec(0.5 * at) : nearestToOrigin(planes);
      if (!(guess.norm() < kEnough * best_.length)) {
        // The planes admit nothing shorter. The last one alone may: the others are of places that
        // no longer matter.
        if (planes.size() < 2) break;
        planes.erase(planes.begin(), planes.end() - 1);
        guess = nearestToOrigin(planes);
        if (!(guess.norm() < kEnough * best_.length)) break;
      }
      guess = rounded(guess);
      Test next = testOf(guess);
      for (int i = 0; i < 2 && !next.apart && !exhausted(); ++i) {
        guess = rounded(0.5 * (at + guess));
        next = testOf(guess);
      }
      if (!next.apart) {
        slide(at, test);
        break;
      }
      at = guess;
      test = next;
      accept(at, test);
      if (!(best_.length < kEnough * before)) break;
    }
  }

  SolidPair<S>& pair_;
  const BallPairs& balls_;
  Exit best_;
  const long long last_test_;
};

}  // namespace

template <typename S>
Exit goAlong(SolidPair<S>& pair, const Vec& n, double length, double reach) {
  double margin = 8 * pair.rounding();
  constexpr int kTries = 60;
  for (int i = 0; i < kTries; ++i, margin *= 4) {
    const Vec x = ((std::max(length, 0.0) + margin) * n).template cast<S>().template cast<double>();
    const auto test = pair.test(x, reach);
    if (test.apart) return {x, x.norm(), test.on_a};
  }
  refuse<std::logic_error>("no translation parts the hulls of two solids.");
}

// From b's centre c beyond a's, at the origin: |c + length n| = size.
template <typename S>
Exit leaveRoots(SolidPair<S>& pair, const Vec& direction) {
  const MeshPair<S>& frame = pair.frame();
  const Vec a = frame.rootA().center0.template cast<double>(),
            b = frame.rootB().center0.template cast<double>();
  const Vec n = direction.normalized(), c = pair.R_WA() * (pair.R_AB() * b + pair.T_AB() - a);
  const double middle = n.dot(c);
  const double square = pair.size() * pair.size() - c.squaredNorm() + middle * middle;
  return goAlong(pair, n, std::sqrt(std::max(square, 0.0)) - middle + 1e-6 * pair.size(), 0);
}

template <typename S>
Exit leaveNearby(SolidPair<S>& pair, const Exit& exit, const std::vector<Vec>& directions,
                 const BallPairs& balls, long long last_test) {
  return ExitSearch<S>(pair, balls, exit, last_test).nearby(directions);
}

template <typename S>
Exit leaveAnywhere(SolidPair<S>& pair, const Exit& exit, const std::vector<Vec>& directions,
                   const std::vector<BallPairs::Way>& ways, const BallPairs& balls,
                   long long last_test) {
  return ExitSearch<S>(pair, balls, exit, last_test).anywhere(directions, ways);
}

KIOS_INSTANTIATE_FUNCTION(goAlong);
KIOS_INSTANTIATE_FUNCTION(leaveRoots);
KIOS_INSTANTIATE_FUNCTION(leaveNearby);
KIOS_INSTANTIATE_FUNCTION(leaveAnywhere);

}  // namespace kios
