// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "without_gil.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace kios::python {
namespace {

std::atomic<bool> closing{false};
std::atomic<int> running{0};

}  // namespace

WithoutGil::WithoutGil() {
  if (closing.load()) return;
  ++running;
  state_ = PyEval_SaveThread();
}

WithoutGil::~WithoutGil() {
  if (!state_) return;
  PyEval_RestoreThread(state_);
  --running;
}

bool WithoutGil::isClosing() { return closing.load(std::memory_order_relaxed); }

void WithoutGil::close() {
  closing = true;
  while (running.load() > 0) {
    const py::gil_scoped_release others_go_on;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void WithoutGil::forget() { running = 0; }

}  // namespace kios::python
