// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_map>

#include "scene/body.h"

namespace kios::scene {

/// Returns a key of the pair (a, b), which is another than that of (b, a).
inline std::uint64_t pairKey(int a, int b) {
  return std::uint64_t{static_cast<std::uint32_t>(a)} << 32 | static_cast<std::uint32_t>(b);
}
inline std::uint64_t keyOfEither(int a, int b) { return pairKey(std::min(a, b), std::max(a, b)); }

/// Holds the last answer of the narrow phase about two bodies, and their poses then. It says
/// nothing of other states of their geometries.
struct Proof {
  std::uint64_t generation_a = 0, generation_b = 0;  ///< 0: nothing was proven
  fcl::Matrix3d R;                                   ///< pose of b in a, as RelativePose has it
  fcl::Vector3d T;
  std::uint64_t pose_a = 0, pose_b = 0;
  double apart = 0;     ///< the narrow phase would compute at least that there
  double distance = 0;  ///< the distance that it computes there, if `exact`
  bool exact = false;
  std::intptr_t triangle_a = -1, triangle_b = -1;  ///< near each other there, if not negative
  std::uint64_t used = 0;                          ///< number of the query that last did

  bool tellsOf(const Body& a, const Body& b) const {
    return generation_a == a.generation && generation_b == b.generation;
  }
};

/// Holds the proofs of the pairs that queries came near. Their number is bounded: a query forgets
/// the proofs that it didn't use as soon as they are more than those that it used, plus kSpare.
class PairMemory {
 public:
  static constexpr std::size_t kSpare = 1024;

  explicit PairMemory(std::size_t capacity) : capacity_(capacity) {}

  void beginQuery() {
    ++query_;
    used_ = 0;
  }
  void endQuery() {
    if (proofs_.size() <= 2 * used_ + kSpare) return;
    for (auto it = proofs_.begin(); it != proofs_.end();) {
      it = it->second.used == query_ ? std::next(it) : proofs_.erase(it);
    }
  }
  std::uint64_t query() const { return query_; }

  /// The proof of the pair in their present states; nullptr if there is none.
  Proof* find(int id_a, const Body& a, int id_b, const Body& b) {
    const auto found = proofs_.find(pairKey(id_a, id_b));
    if (found == proofs_.end() || !found->second.tellsOf(a, b)) return nullptr;
    return use(found->second);
  }
  /// Returns a place for a proof; nullptr if there is no room.
  Proof* obtain(int id_a, int id_b) {
    const std::uint64_t key = pairKey(id_a, id_b);
    if (proofs_.size() >= capacity_ && proofs_.count(key) == 0) return nullptr;
    return use(proofs_[key]);
  }

  std::size_t size() const { return proofs_.size(); }
  void clear() { proofs_.clear(); }

 private:
  struct Hash {
    std::size_t operator()(std::uint64_t key) const {
      key *= 0x9e3779b97f4a7c15U;
      return key ^ key >> 32;
    }
  };
  Proof* use(Proof& proof) {
    if (proof.used != query_) ++used_;
    proof.used = query_;
    return &proof;
  }

  std::unordered_map<std::uint64_t, Proof, Hash> proofs_;
  std::size_t capacity_;
  std::uint64_t query_ = 0;
  std::size_t used_ = 0;
};

}  // namespace kios::scene
