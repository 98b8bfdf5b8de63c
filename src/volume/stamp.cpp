// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "volume/stamp.h"

#include <atomic>

namespace kios {
namespace {

/// Stamps are handed out to threads in blocks, so that they share no counter on the way. A block
/// has no destructor, so that it may be used to the very end of a thread; and no TLS model, so that
/// a process can open the library at run time.
struct Block {
  std::uint64_t next, end;
};
std::atomic<std::uint64_t> next_block{1};
thread_local Block block{0, 0};

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
