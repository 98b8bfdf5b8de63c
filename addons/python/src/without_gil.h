// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include <pybind11/pybind11.h>

namespace kios::python {

namespace py = pybind11;

/// Releases the GIL for its lifetime. Once the interpreter is about to end it keeps it: a thread
/// that asked for it later would be ended within C++ code.
class WithoutGil {
 public:
  WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  ~WithoutGil();

  /// True once the interpreter is about to end. Any thread may ask.
  static bool isClosing();
  /// To be called at exit: no query releases the GIL any more, and when this returns none runs.
  static void close();
  /// To be called in the child of a fork, which has no other threads.
  static void forget();

 private:
  PyThreadState* state_ = nullptr;
};

/// Takes the GIL back within WithoutGil; does nothing where that kept it.
class WithGil {
 public:
  WithGil()
      : held_(PyGILState_Check() != 0), state_(held_ ? PyGILState_STATE{} : PyGILState_Ensure()) {}
  WithGil(const WithGil&) = delete;
  ~WithGil() {
    if (!held_) PyGILState_Release(state_);
  }

 private:
  const bool held_;
  const PyGILState_STATE state_;
};

/// Counts the queries that read something while they don't hold the GIL. Written under the GIL.
using Readers = int;

/// Marks what a query reads, until it ends.
class Reading {
 public:
  explicit Reading(Readers& readers) : readers_(&readers) { ++readers; }
  Reading(Reading&& other) noexcept : readers_(other.readers_) { other.readers_ = nullptr; }
  Reading& operator=(Reading&&) = delete;
  ~Reading() {
    if (readers_) --*readers_;
  }

 private:
  Readers* readers_;
};

/// Throws RuntimeError if a query of another thread, or the one that called back, reads it.
inline void requireUnread(Readers readers, const char* what) {
  if (readers == 0) return;
  throw std::runtime_error(std::string("fcl_kios: the ") + what +
                           " can't be changed while a query reads it.");
}

}  // namespace kios::python
