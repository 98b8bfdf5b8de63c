// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include <fcl/geometry/collision_geometry.h>

// Queries don't hold the GIL. What they read can't change meanwhile: a change waits until they have
// ended, and a query begins after the changes that wait. All this is counted under the GIL.

namespace kios::python {

/// Counts of an object, a geometry or a manager, in the bits of a pointer: a geometry's lie where
/// FCL has its user data.
struct __attribute__((may_alias)) Turns {
  enum : unsigned int { kBits = 8 * sizeof(void*) };
  std::uintptr_t readers : kBits / 4;  ///< queries
  std::uintptr_t waiting : kBits / 4;  ///< changes
  std::uintptr_t placed : kBits / 2;   ///< objects, in scenes or by themselves, of a geometry
};
static_assert(sizeof(Turns) == sizeof(void*));

inline Turns& turnsOf(const fcl::CollisionGeometryd& geometry) {
  return reinterpret_cast<Turns&>(const_cast<void*&>(geometry.user_data));
}

/// Queries of managers and scenes, which don't count at each geometry that they may read.
Turns& crowdTurns();

/// Marks what a query reads, until it ends; for no longer, as numpy's copies release the GIL, too,
/// and changes and forks wait for it. It waits for changes first, unless it is a callback's.
class Reading {
 public:
  /// Ignores those that are null.
  explicit Reading(Turns* a, Turns* b = nullptr, Turns* c = nullptr, Turns* d = nullptr);
  Reading(Reading&& other) noexcept;
  Reading& operator=(Reading&&) = delete;
  ~Reading();

  /// To be called where a thread leaves it to another to end this.
  void leave();
  /// How many there are of other threads.
  static int others();

 private:
  std::array<Turns*, 4> turns_;
  bool own_ = true;
};

/// Calls work(), which reads what `reading` marks and uses what `kept` owns, as runInterruptibly()
/// does: both are held until it ends.
void readInterruptibly(Reading reading, std::shared_ptr<void> kept, std::function<void()> work);

void waitWhileRead(Turns& turns, const char* what);

/// Waits until firstRead() finds no turns that are read; it returns them as a std::shared_ptr.
/// Throws RuntimeError in a callback of a query, which would wait for itself.
template <typename FirstRead>
void awaitTurn(const FirstRead& firstRead, const char* what) {
  while (const std::shared_ptr<Turns> read = firstRead()) waitWhileRead(*read, what);
}

/// Turns that outlive a call, if they are read.
inline std::shared_ptr<Turns> ifRead(Turns& turns) {
  return turns.readers > 0 ? std::shared_ptr<Turns>(std::shared_ptr<void>(), &turns) : nullptr;
}

/// Waits until no query reads the geometry.
void awaitGeometry(const fcl::CollisionGeometryd& geometry, const char* what);

}  // namespace kios::python
