// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "turns.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "without_gil.h"

namespace kios::python {
namespace {

int reading = 0;           // of all threads
thread_local int own = 0;  // of this one

std::mutex mutex;
std::condition_variable changed;
std::uint64_t changes = 0;  // guarded by the mutex

void notify() {
  {
    const std::lock_guard<std::mutex> lock(mutex);
    ++changes;
  }
  changed.notify_all();
}

/// Waits for the next notify(), 20 ms at most.
void waitForChange() {
  std::unique_lock<std::mutex> lock(mutex);  // before others get the GIL, who may notify
  const std::uint64_t seen = changes;
  lock.unlock();
  {
    const WithoutGil released(true);
    lock.lock();
    changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return changes != seen; });
    lock.unlock();
  }
  listen();
}

}  // namespace

Turns& crowdTurns() {
  static Turns turns{};
  return turns;
}

Reading::Reading(Turns* a, Turns* b, Turns* c, Turns* d) : turns_{a, b, c, d} {
  const auto awaited = [](const Turns* t) { return t && t->waiting > 0; };
  while (own == 0 && std::any_of(turns_.begin(), turns_.end(), awaited)) waitForChange();
  for (Turns* const t : turns_) {
    if (t) ++t->readers;
  }
  ++reading;
  ++own;
}

Reading::Reading(Reading&& other) noexcept
    : turns_(std::exchange(other.turns_, {})), own_(std::exchange(other.own_, false)) {
  ++reading;  // as `other` still counts
}

Reading::~Reading() {
  bool awaited = false;
  for (Turns* const t : turns_) {
    if (t && --t->readers == 0) awaited |= t->waiting > 0;
  }
  --reading;
  leave();
  if (awaited) notify();
}

void Reading::leave() {
  if (std::exchange(own_, false)) --own;
}

int Reading::others() { return reading - own; }

void readInterruptibly(Reading reading, std::shared_ptr<void> kept, std::function<void()> work) {
  struct Held {
    Reading reading;
    std::shared_ptr<void> kept;
  };
  const auto held = std::make_shared<Held>(Held{std::move(reading), std::move(kept)});
  struct Left {
    Reading& reading;
    ~Left() { reading.leave(); }
  } const left{held->reading};
  runInterruptibly(std::move(work), held);
}

void waitWhileRead(Turns& turns, const char* what) {
  if (own > 0) {
    throw std::runtime_error(std::string("fcl_kios: the ") + what +
                             " can't be changed while a query reads it.");
  }
  struct Waiting {
    explicit Waiting(Turns& t) : turns(t) { ++turns.waiting; }
    Waiting(const Waiting&) = delete;
    ~Waiting() {
      if (--turns.waiting == 0) notify();
    }
    Turns& turns;
  } waiting(turns);
  while (turns.readers > 0) waitForChange();
}

void awaitGeometry(const fcl::CollisionGeometryd& geometry, const char* what) {
  Turns& turns = turnsOf(geometry);
  awaitTurn(
      [&] {
        const std::shared_ptr<Turns> read = ifRead(turns);
        return read || turns.placed == 0 ? read : ifRead(crowdTurns());
      },
      what);
}

}  // namespace kios::python
