// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/pair_memory.h"

namespace kios::scene {

template <typename S>
Proof<S>* PairMemory<S>::find(int id_a, const Body<S>& a, int id_b, const Body<S>& b) {
  const auto found = proofs_.find(pairKey(id_a, id_b));
  if (found == proofs_.end() || !found->second.tellsOf(a, b)) return nullptr;
  use(found->second);
  return &found->second;
}

template <typename S>
Proof<S>* PairMemory<S>::obtain(int id_a, int id_b) {
  const std::uint64_t key = pairKey(id_a, id_b);
  if (proofs_.size() >= capacity_ && proofs_.count(key) == 0) return nullptr;
  Proof<S>& proof = proofs_[key];
  use(proof);
  return &proof;
}

template <typename S>
void PairMemory<S>::endQuery() {
  if (proofs_.size() <= 2 * used_ + kSpare) return;
  for (auto it = proofs_.begin(); it != proofs_.end();) {
    it = it->second.used == query_ ? std::next(it) : proofs_.erase(it);
  }
}

template class PairMemory<double>;
template class PairMemory<float>;

}  // namespace kios::scene
