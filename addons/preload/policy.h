// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "preload/fcl_search.h"

namespace kios::preload {

enum class Kind : std::uint32_t { kVerdict, kContacts, kDistance };

/// Holds a pair of models and what is asked about it.
struct Question {
  std::uint32_t serial_a, serial_b;
  Kind kind;
  double copies_cost;  ///< what the copies need, in nanoseconds
};

/// Returns what it takes to compare so many bytes, in nanoseconds.
double timeOfComparison(std::size_t bytes);

/// Returns what the copies need for a query: to compare so many bytes, and to search.
double costOfCopies(Kind kind, std::size_t bytes_to_compare);

/// Decides for each pair whether FCL or the copies are asked first, from what FCL's searches of
/// that pair have cost: in tests, not in time, so that a program's answers don't depend on the
/// machine's load. FCL is cheaper where its volumes decide soon, and for contacts, which it has to
/// list; the copies' price is the comparison of their contents. A pair without a history, which may
/// also be lost, begins with that of its first model.
class Policy {
 public:
  /// Returns how much FCL's search may cost before the copies are asked: 0 if they come first,
  /// infinity if FCL alone, and kHandOn if its search need not even be watched.
  double fclLimit(const Question& question);
  static constexpr double kHandOn = -1;

  /// Notes how FCL's search ended, and whether it found contacts.
  void note(const Question& question, const Search& search, double limit, bool touches);

  /// Notes that the copies touch; FCL has to list the contacts if they are wanted.
  void noteContact(const Question& question);

 private:
  struct Past {
    std::uint32_t tag = 0;   ///< of the question; 0: none
    std::uint16_t cost = 0;  ///< of FCL's search, in units of 64 ns
    std::uint8_t until_probe = 0;
    bool touched = false;
  };

  std::atomic<Past>& placeOf(const Question& question);
  Past find(const Question& question);
  void noteOne(const Question& question, const Search& search, double limit, bool touches);

  std::array<std::atomic<Past>, 1 << 15> pasts_{};
};

}  // namespace kios::preload
