// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/shrink.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "fuzz/mesh_fuzz/hard_meshes.h"

namespace kios::fuzz {
namespace {

class Shrinker {
 public:
  Shrinker(Case c, double seconds)
      : best_(std::move(c)),
        throws_(throws(ask(best_))),
        end_(Clock::now() + std::chrono::milliseconds(static_cast<long long>(1000 * seconds))) {}

  Case run() {
    do {
      better_ = false;
      parts();
      poses();
    } while (better_ && inTime());
    return best_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool inTime() const { return Clock::now() < end_; }

  static bool throws(const Verdict& wrong) { return wrong && wrong->what.rfind("throws", 0) == 0; }

  /// Takes the case if it fails; not if only then it is refused, as a pose that is not rigid.
  bool attempt(const Case& c) {
    if (!inTime()) return false;
    const Verdict wrong = ask(c);
    if (!wrong || (throws(wrong) && !throws_)) return false;
    best_ = c;
    better_ = true;
    return true;
  }

  void parts() {
    for (bool Case::*flag : {&Case::in_float, &Case::foreign}) {
      Case c = best_;
      if (c.*flag) {
        c.*flag = false;
        attempt(c);
      }
    }
    const Question& q = *best_.question;
    for (std::size_t f = best_.frames.size(); f-- > 0;) {
      if (static_cast<int>(best_.frames.size()) <= q.least_frames) break;
      Case c = best_;
      c.frames.erase(c.frames.begin() + static_cast<std::ptrdiff_t>(f));
      attempt(c);
    }
    for (std::size_t m = best_.meshes.size(); m-- > 0;) {
      if (static_cast<int>(best_.meshes.size()) <= q.least_meshes) break;
      Case c = best_;
      c.meshes.erase(c.meshes.begin() + static_cast<std::ptrdiff_t>(m));
      for (auto& frame : c.frames) frame.erase(frame.begin() + static_cast<std::ptrdiff_t>(m));
      attempt(c);
    }
    for (std::size_t m = 0; m < best_.meshes.size(); ++m) triangles(m);
  }

  /// Leaves out runs of triangles, long ones first.
  void triangles(std::size_t m) {
    for (std::size_t run = best_.meshes[m].triangles.size() / 2; run > 0; run /= 2) {
      for (std::size_t first = 0; first < best_.meshes[m].triangles.size();) {
        const std::size_t count = best_.meshes[m].triangles.size();
        std::vector<std::size_t> kept;
        for (std::size_t t = 0; t < count; ++t) {
          if (t < first || t >= first + run) kept.push_back(t);
        }
        Case c = best_;
        if (kept.empty()) break;
        c.meshes[m] = partOf(best_.meshes[m], kept);
        if (!attempt(c)) first += run;
      }
    }
  }

  void poses() {
    Case c = best_;  // in the first object's frame
    for (auto& frame : c.frames) {
      const Transform3d inverse = c.frames[0][0].inverse();
      for (Transform3d& X : frame) X = inverse * X;
    }
    if (!best_.frames[0][0].matrix().isIdentity(0)) attempt(c);
    for (std::size_t f = 0; f < best_.frames.size(); ++f) {
      for (std::size_t m = 0; m < best_.frames[f].size(); ++m) pose(f, m);
    }
  }

  void pose(std::size_t f, std::size_t m) {
    const auto change = [&](const auto& how) {
      Case c = best_;
      how(c.frames[f][m]);
      if ((c.frames[f][m].matrix() - best_.frames[f][m].matrix()).isZero(0)) return false;
      return attempt(c);
    };
    if (change([](Transform3d& X) { X.setIdentity(); })) return;
    if (f > 0 && change([&](Transform3d& X) { X = best_.frames[f - 1][m]; })) return;
    change([](Transform3d& X) { X.linear().setIdentity(); });
  }

  Case best_;
  const bool throws_;
  const Clock::time_point end_;
  bool better_ = false;
};

}  // namespace

Verdict ask(const Case& c) {
  try {
    return c.question->ask(c);
  } catch (const std::exception& e) {
    return Failure{std::string("throws: ") + e.what(), ""};
  }
}

Case shrunk(Case c, double seconds) { return Shrinker(std::move(c), seconds).run(); }

}  // namespace kios::fuzz
