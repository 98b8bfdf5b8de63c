// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interior/exit_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Translations that the plane between two nearest points admits: normal . x >= least.
struct Plane {
  Vec normal;
  double least;
};

/// The point of all half-spaces that is nearest to the origin, to about a percent: Hildreth's
/// method.
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
  ExitSearch(SolidPair<S>& pair, const Exit& exit, int tests)
      : pair_(pair), best_(exit), last_test_(static_cast<long long>(pair.tests()) + tests) {}

  Exit run(const std::vector<Vec>& directions) {
    descend(tryDirections(directions));
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

  /// Along each direction a shorter way is looked for until one fails. Returns the shortest, which
  /// isn't proven.
  Vec tryDirections(const std::vector<Vec>& directions) {
    Vec best = best_.translation;
    // Bodies that only just overlap leave by a small step, though a larger one may meet something
    // else.
    constexpr std::size_t kFirst = 3;
    for (std::size_t i = 0; i < std::min(kFirst, directions.size()); ++i) {
      const double length = best.norm();
      for (double share = 1.0 / 512; share < 0.2 && !exhausted(); share *= 4) {
        const Vec x = rounded(share * length * directions[i]);
        if (!pair_.seemsApart(x)) continue;
        best = x;
        break;
      }
    }
    for (const Vec& n : directions) {
      for (double share = 0.7; !exhausted(); share = 0.5) {
        const Vec x = rounded(share * best.norm() * n);
        // Shorter ones can't be proven: bodies that only just touch seem apart at any length.
        if (!(x.norm() > 16 * pair_.rounding()) || !pair_.seemsApart(x)) break;
        best = x;
      }
    }
    return relax(best);
  }

  /// If b's way out is long for the bodies, there may be room among a's parts: b is pushed out of
  /// what it meets, step by step.
  Vec relax(const Vec& best) {
    constexpr double kLong = 0.1;
    if (!(best.norm() > kLong * pair_.size())) return best;
    constexpr int kSteps = 6;
    const double step = 0.6 / kSteps * best.norm();
    Vec x = Vec::Zero();
    for (int i = 0; i < kSteps && !exhausted(); ++i) {
      const Vec n = pair_.pushOut(x);
      if (n.isZero(0)) break;
      x = rounded(x + step * n);
    }
    return x.norm() > 0 && x.norm() < best.norm() && pair_.seemsApart(x) ? x : best;
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
    }
    accept(at, test);
    constexpr double kEnough = 0.98;
    constexpr std::size_t kPlanes = 6;
    for (int idle = 0; idle < 2 && !exhausted();) {
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
      Vec high = guess;
      bool found = pair_.seemsApart(guess);
      for (int i = 0; i < 3 && !found && !exhausted(); ++i) {
        const Vec middle = rounded(0.5 * (at + high));
        if (pair_.seemsApart(middle)) {
          found = true;
          guess = middle;
        } else {
          high = middle;
        }
      }
      if (!found) break;
      const Test next = pair_.test(guess, best_.length);
      if (!next.apart) break;
      at = guess;
      test = next;
      accept(at, test);
      idle = best_.length < kEnough * before ? 0 : idle + 1;
    }
  }

  SolidPair<S>& pair_;
  Exit best_;
  const long long last_test_;
};

}  // namespace

template <typename S>
Exit leaveHull(SolidPair<S>& pair, const Differences<S>& differences, const Vec& direction,
               double reach) {
  const Vec n = (pair.R_WA().transpose() * direction).normalized();
  const double length = differences.height(n);
  double margin = 8 * pair.rounding();
  constexpr int kTries = 60;
  for (int i = 0; i < kTries; ++i, margin *= 4) {
    const Vec x = ((std::max(length, 0.0) + margin) * (pair.R_WA() * n))
                      .template cast<S>()
                      .template cast<double>();
    const auto test = pair.test(x, reach);
    if (test.apart) return {x, x.norm(), test.on_a};
  }
  throw std::logic_error("fcl_kios: no translation parts the hulls of two solids.");
}

template <typename S>
Exit shorten(SolidPair<S>& pair, const Exit& exit, const std::vector<Vec>& directions, int tests) {
  return ExitSearch<S>(pair, exit, tests).run(directions);
}

#define KIOS_INSTANTIATE(S)                                                          \
  template Exit leaveHull(SolidPair<S>&, const Differences<S>&, const Vec&, double); \
  template Exit shorten(SolidPair<S>&, const Exit&, const std::vector<Vec>&, int);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
