// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bv/stamp.h"

#include <atomic>

namespace kios {
namespace {

/// Stamps are handed out to threads in blocks, so that they share no counter on the way.
struct Block {
  std::uint64_t next, end;
};
std::atomic<std::uint64_t> next_block{1};
__attribute__((tls_model("initial-exec"))) thread_local Block block{0, 0};

}  // namespace

std::uint64_t nextStamp() {
  constexpr std::uint64_t kBlock = 4096;
  if (block.next == block.end) {
    block.next = next_block.fetch_add(kBlock, std::memory_order_relaxed);
    block.end = block.next + kBlock;
  }
  return block.next++;
}

}  // namespace kios
