// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/policy.h"

#include <algorithm>

#include "volume/rounding.h"

namespace kios::preload {
namespace {

constexpr double kUnit = 64;              // nanoseconds
constexpr std::uint8_t kProbeEvery = 64;  // queries; FCL may have become the cheaper
constexpr std::uint8_t kWatchEvery = 8;   // a pair of which contacts are listed may part

std::uint64_t mixed(const Question& question) {
  std::uint64_t x = std::uint64_t{question.serial_a} << 34 ^ std::uint64_t{question.serial_b} << 2 ^
                    static_cast<std::uint64_t>(question.kind);
  x = (x ^ x >> 31) * 0x9E3779B97F4A7C15U;
  return (x ^ x >> 29) * 0xBF58476D1CE4E5B9U;
}

/// Is never 0.
std::uint32_t tagOf(const Question& question) {
  return static_cast<std::uint32_t>(mixed(question)) | 1;
}

/// Asks about all pairs with the first model that have no history.
Question ofFirst(Question question) {
  question.serial_b = 0;
  return question;
}

std::uint16_t inUnits(double nanoseconds) {
  return static_cast<std::uint16_t>(std::min(nanoseconds / kUnit, 65535.0));
}

}  // namespace

double timeOfComparison(std::size_t bytes) {
  constexpr double kByte = 1.0 / 30;  // a core compares 20 to 60 bytes a nanosecond
  return kByte * static_cast<double>(bytes);
}

double costOfCopies(Kind kind, std::size_t bytes_to_compare) {
  constexpr double kSearch[] = {2000, 2000, 7000};
  return timeOfComparison(bytes_to_compare) + kSearch[static_cast<std::size_t>(kind)];
}

std::atomic<Policy::Past>& Policy::placeOf(const Question& question) {
  return pasts_[mixed(question) >> 40 & (pasts_.size() - 1)];
}

Policy::Past Policy::find(const Question& question) {
  const Past past = placeOf(question).load(std::memory_order_relaxed);
  return past.tag == tagOf(question) ? past : Past{};
}

double Policy::fclLimit(const Question& question) {
  Question about = question;
  Past past = find(about);
  if (past.tag == 0) {
    about = ofFirst(question);
    past = find(about);
    if (past.tag == 0) return question.copies_cost;
  }
  if (!past.touched && past.cost * kUnit <= question.copies_cost) return 2 * question.copies_cost;
  const bool probes = past.until_probe == 0;
  const std::uint8_t every = past.touched ? kWatchEvery : kProbeEvery;
  past.until_probe = probes ? every - 1 : static_cast<std::uint8_t>(past.until_probe - 1);
  placeOf(about).store(past, std::memory_order_relaxed);
  if (past.touched) return probes ? kInfinity : kHandOn;
  return probes ? question.copies_cost : 0;
}

void Policy::note(const Question& question, const Search& search, double limit, bool touches) {
  noteOne(question, search, limit, touches);
  noteOne(ofFirst(question), search, limit, false);
}

void Policy::noteOne(const Question& question, const Search& search, double limit, bool touches) {
  const Past past = find(question);
  const std::uint16_t cost = inUnits(search.done ? search.nanoseconds : 2 * limit);
  Past next = past;
  next.tag = tagOf(question);
  if (!search.done) {
    next.cost = std::max(past.cost, cost);
    next.until_probe = kProbeEvery - 1;
  } else {
    next.cost = past.tag != 0 ? static_cast<std::uint16_t>((3 * past.cost + cost + 2) / 4) : cost;
    next.touched = touches && question.kind == Kind::kContacts;
  }
  if (next.tag == past.tag && next.cost == past.cost && next.until_probe == past.until_probe &&
      next.touched == past.touched) {
    return;  // no other thread's cache has to learn of it
  }
  placeOf(question).store(next, std::memory_order_relaxed);
}

void Policy::noteContact(const Question& question) {
  if (question.kind != Kind::kContacts) return;
  Past past = find(question);
  past.tag = tagOf(question);
  past.touched = true;
  placeOf(question).store(past, std::memory_order_relaxed);
}

}  // namespace kios::preload
