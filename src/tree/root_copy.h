// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "tree/tree.h"

namespace kios::engine {

/// Holds a copy of a tree's root for readers that need no more of the tree, and so needn't keep it
/// in use. Any thread may read while one writes.
class RootCopy {
 public:
  /// Copies the root of the tree for this state of the model (TreeKey::root_stamp); false if it is
  /// not what is held, or is being written: `root` is unspecified then. No lock is taken and
  /// nothing is written.
  bool read(std::uint64_t stamp, TreeRoot& root) const {
    // Odd while it is written. Whoever reads a word of another writing sees this changed, as words
    // are acquired.
    const unsigned int version = version_.load(std::memory_order_acquire);
    if ((version & 1U) != 0 || stamp_.load(std::memory_order_acquire) != stamp) return false;
    copyWords(static_cast<unsigned char*>(static_cast<void*>(&root)),
              std::make_index_sequence<kWords>());
    return version_.load(std::memory_order_relaxed) == version;
  }

  /// Returns true if a tree's root for this state is held, which read() then will copy unless it is
  /// being written.
  bool isOf(std::uint64_t stamp) const { return stamp_.load(std::memory_order_relaxed) == stamp; }

  /// By one thread at a time.
  void write(std::uint64_t stamp, const TreeRoot& root) {
    std::array<std::uint64_t, kWords> words;
    std::memcpy(words.data(), static_cast<const void*>(&root), sizeof(words));
    version_.fetch_add(1, std::memory_order_relaxed);
    stamp_.store(stamp, std::memory_order_release);
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    version_.fetch_add(1, std::memory_order_release);
  }

 private:
  static constexpr std::size_t kWords = 12;
  static_assert(std::is_trivially_copyable_v<TreeRoot> && sizeof(TreeRoot) >= 8 * kWords &&
                offsetof(TreeRoot, reach) + sizeof(float) <= 8 * kWords);

  template <std::size_t... i>
  void copyWords(unsigned char* to, std::index_sequence<i...> /*all*/) const {
    const auto copy = [to](std::size_t at, std::uint64_t word) {
      std::memcpy(to + sizeof(word) * at, &word, sizeof(word));
    };
    (copy(i, words_[i].load(std::memory_order_acquire)), ...);
  }

  std::atomic<unsigned int> version_{0};
  std::atomic<std::uint64_t> stamp_{0};  ///< 0: none
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace kios::engine
