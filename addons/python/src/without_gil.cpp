// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "without_gil.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "turns.h"

namespace kios::python {
namespace {

std::atomic<bool> closing{false};
std::atomic<int> forking{0};  // threads
std::atomic<int> running{0};
thread_local int own = 0;  ///< of `running`, this thread's

void letOthersGoOn() {
  const py::gil_scoped_release released;
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

WithoutGil::WithoutGil(bool waits) {
  if (closing.load() || (forking.load() > 0 && !waits)) return;
  ++running;
  ++own;
  state_ = PyEval_SaveThread();
}

WithoutGil::~WithoutGil() {
  if (!state_) return;
  PyEval_RestoreThread(state_);
  --own;
  --running;
}

bool WithoutGil::isClosing() { return closing.load(std::memory_order_relaxed); }

void WithoutGil::close() {
  closing = true;
  while (running.load() > 0) letOthersGoOn();
}

void WithoutGil::beforeFork() {
  ++forking;  // first, or others' queries might take turns for ever
  while (running.load() > own || Reading::others() > 0) letOthersGoOn();
}

void WithoutGil::afterFork(bool in_child) {
  --forking;
  if (!in_child) return;
  forking = 0;
  running = own;
}

void listen() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (WithoutGil::isClosing()) throw std::runtime_error("fcl_kios: the interpreter ends.");
}

void runInterruptibly(std::function<void()> work, std::shared_ptr<void> kept) {
  struct State {
    std::function<void()> work;
    std::shared_ptr<void> kept;
    std::exception_ptr failure;
    std::mutex mutex;
    std::condition_variable changed;
    bool ended = false;

    void run() {
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      work = nullptr;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        ended = true;
      }
      changed.notify_one();
      if (kept) {
        const WithGil gil;
        kept.reset();
      }
      --running;
    }
  };
  const auto state = std::make_shared<State>();
  state->work = std::move(work);
  state->kept = std::move(kept);
  ++running;  // until run() ends
  try {
    std::thread([state] { state->run(); }).detach();
  } catch (const std::system_error&) {  // there is no thread to be had
    const WithoutGil released;
    state->run();
  }
  for (bool ended = false; !ended;) {
    {
      const WithoutGil released;
      std::unique_lock<std::mutex> lock(state->mutex);
      ended = state->changed.wait_for(lock, std::chrono::milliseconds(20),
                                      [&] { return state->ended; });
    }
    listen();
  }
  if (state->failure) std::rethrow_exception(state->failure);
}

}  // namespace kios::python
