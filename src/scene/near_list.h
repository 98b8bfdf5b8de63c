// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/body.h"

namespace kios::scene {

/// Holds the pairs of objects whose boxes were within a reach of each other at one query. As long
/// as no object has moved much since then, they include all pairs within a smaller limit, and the
/// tree need not be searched (Verlet's list).
template <typename S>
class NearList {
 public:
  using Pairs = std::vector<std::pair<int, int>>;

  /// Returns true if all pairs within `limit` are listed. The list is valid while the same objects
  /// are there, in the same states, and no rotation is worse; other pairs came nearer by their
  /// paths at most.
  bool covers(double limit) const { return valid_ && limit + 2 * moved_ <= reach_; }
  const Pairs& pairs() const { return pairs_; }

  /// Has to be called at each query once all bodies are up to date.
  void follow(const std::vector<Body<S>>& bodies);

  /// Starts a list at the present poses that serves `limit` and is likely to do so for a few more
  /// queries. Returns its reach, or the limit if there is none: bodies move too fast for that to
  /// pay, or there were too many pairs of late.
  double startFor(double limit, const std::vector<Body<S>>& bodies);
  /// Adds a pair within reach. Returns false if they have become too many, and there is no list.
  bool add(int a, int b);
  /// Has to be called once all pairs within reach were added: a search that throws leaves no list.
  void finish() { valid_ = listing_; }

 private:
  void rest();
  struct Mark {
    std::uint64_t generation;
    double path, rotation_error;
  };

  Pairs pairs_;
  std::vector<Mark> marks_;  // of the bodies when the list was started, by id
  double reach_ = 0;
  double moved_ = 0;       // at most, by any body since then
  long long age_ = 0;      // queries since then
  long long resting_ = 0;  // queries for which no list is tried
  double size_ = 0;        // mean radius of the bodies
  std::size_t capacity_ = 0;
  bool listing_ = false;  // pairs are being added
  bool valid_ = false;    // all were
};

}  // namespace kios::scene
