// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "scene/body.h"

namespace kios::scene {

/// Holds the pairs of objects whose boxes were within a reach of each other at one query. As long
/// as no box has moved much since then, they include all pairs within a smaller gap, and the tree
/// need not be searched (Verlet's list).
class NearList {
 public:
  using Pairs = std::vector<std::pair<int, int>>;

  /// Returns true if all pairs within `gap` are listed.
  bool covers(double gap) const { return valid_ && (gap + 2 * moved_) * (1 + 0x1p-50) <= reach_; }
  const Pairs& pairs() const { return pairs_; }

  /// Has to be called at each query once all bodies are up to date; `others` if some were added or
  /// removed.
  void follow(const std::vector<Body>& bodies, bool others);

  /// Starts a list at the present poses that serves `gap` and is likely to do so for a few more
  /// queries. Returns its reach, or the gap if there is none: bodies move too fast for that to pay,
  /// or there were too many pairs of late.
  double startFor(double gap, const std::vector<Body>& bodies);
  /// Adds a pair within reach. Returns false if they have become too many, and there is no list.
  bool add(int a, int b);
  /// Has to be called once all pairs within reach were added: a search that throws leaves no list.
  void finish() { valid_ = listing_; }

 private:
  void rest();

  Pairs pairs_;
  std::vector<Box> boxes_;  // of the bodies when the list was started, by id
  double reach_ = 0;
  double moved_ = 0;       // at most, by any box since then
  long long age_ = 0;      // queries since then
  long long resting_ = 0;  // queries for which no list is tried
  double size_ = 0;        // mean radius of the bodies
  std::size_t capacity_ = 0;
  bool listing_ = false;  // pairs are being added
  bool valid_ = false;    // all were
};

}  // namespace kios::scene
