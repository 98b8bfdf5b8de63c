// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace kios::engine {

/// Stands for the content of two arrays of fixed lengths. Each 4 KiB give two sums of products with
/// keys of their own (NH of UMAC, Black et al. 1999), and a polynomial modulo 2^61 - 1 runs over
/// each kind of sum. Keys and points are drawn by each process: arrays of other content, whatever
/// it is, have the same fingerprint with a probability below 2^-60 up to 2^50 bytes.
struct Fingerprint {
  std::uint64_t first = 0, second = 0;

  bool operator==(const Fingerprint& o) const { return first == o.first && second == o.second; }
};

/// Returns that of two arrays of so many bytes. Reads them once, about as fast as memory allows.
Fingerprint fingerprint(const void* one, std::size_t one_bytes, const void* other,
                        std::size_t other_bytes);

}  // namespace kios::engine
