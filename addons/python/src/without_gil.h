// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include <pybind11/pybind11.h>

namespace kios::python {

namespace py = pybind11;

/// Releases the GIL for its lifetime. It keeps it while a thread forks, so that the child finds
/// nothing half done, unless it only waits; and once the interpreter is about to end: a thread that
/// asked for it later would be ended within C++ code.
class WithoutGil {
 public:
  explicit WithoutGil(bool waits = false);
  WithoutGil(const WithoutGil&) = delete;
  ~WithoutGil();

  /// True once the interpreter is about to end. Any thread may ask.
  static bool isClosing();
  /// To be called at exit: no query releases the GIL any more, and when this returns none runs.
  static void close();
  /// To be called before and after a fork, in the parent and in the child. The first waits for what
  /// other threads do without the GIL, and for their queries; what is begun meanwhile keeps it.
  static void beforeFork();
  static void afterFork(bool in_child);

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

/// Raises what signals raise, KeyboardInterrupt above all, and where the interpreter ends. Needs
/// the GIL.
void listen();

/// Calls work() without the GIL in a thread of its own, and listens meanwhile. What signals raise
/// is raised at once: the work then goes on to its end, unheard. So it must own all that it uses,
/// but for what `kept` owns, which is let go under the GIL once it has ended. Throws what it
/// throws.
void runInterruptibly(std::function<void()> work, std::shared_ptr<void> kept = nullptr);

}  // namespace kios::python
