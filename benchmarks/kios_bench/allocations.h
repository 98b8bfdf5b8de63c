// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace kios::bench {

/// Counts the bytes that operator new hands out and gets back, in all threads, while it lives; one
/// at a time. Where the C library can't tell the size of a block, they are 0.
class Allocations {
 public:
  Allocations();
  Allocations(const Allocations&) = delete;
  ~Allocations();

  long long held() const;  ///< since it began; blocks from before that were freed count below 0
  long long peak() const;  ///< the most that were held
  void resetPeak();        ///< to what is held now
};

}  // namespace kios::bench
