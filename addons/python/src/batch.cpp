// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "batch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "without_gil.h"

namespace kios::python {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// Hands out items in chunks and takes what their work throws.
class Batch {
 public:
  Batch(std::size_t n, const std::function<void(std::size_t)>& work) : n_(n), work_(work) {}

  /// Works on chunks that take about 0.3 ms each until none is left, calling between() after each.
  template <typename Between>
  void run(const Between& between) {
    std::size_t chunk = 1;
    while (!stop_.load(std::memory_order_relaxed)) {
      const std::size_t begin = next_.fetch_add(chunk, std::memory_order_relaxed);
      if (begin >= n_) return;
      const std::size_t end = std::min(n_, begin + chunk);
      const Clock::time_point start = Clock::now();
      work(begin, end);
      done_.fetch_add(end - begin, std::memory_order_relaxed);
      const Clock::duration took = Clock::now() - start;
      if (took < microseconds(200) && chunk < 4096) chunk *= 2;
      if (took > microseconds(600) && chunk > 1) chunk /= 2;
      between();
    }
  }

  void stop() { stop_.store(true, std::memory_order_relaxed); }
  std::size_t done() const { return std::min(n_, done_.load(std::memory_order_relaxed)); }
  bool isHandedOut() const {
    return stop_.load(std::memory_order_relaxed) || next_.load(std::memory_order_relaxed) >= n_;
  }

  /// The failure of the least item. Chunks are handed out in order and each is worked on to its
  /// first failure, so that it doesn't depend on the threads.
  void rethrow(const char* what) const {
    if (!failure_) return;
    try {
      std::rethrow_exception(failure_);
    } catch (const std::invalid_argument& error) {
      if (*what == '\0') throw;
      throw std::invalid_argument(std::string(error.what()) + " (" + what + "[" +
                                  std::to_string(failed_) + "])");
    }
  }

 private:
  void work(std::size_t begin, std::size_t end) {
    std::size_t i = begin;
    try {
      for (; i < end; ++i) work_(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_ || i < failed_) {
        failure_ = std::current_exception();
        failed_ = i;
      }
      stop();
    }
  }

  const std::size_t n_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
};

/// Threads that help, ended and joined with it.
class Helpers {
 public:
  explicit Helpers(Batch& batch) : batch_(batch) {}
  Helpers(const Helpers&) = delete;
  ~Helpers() {
    batch_.stop();
    for (std::thread& thread : threads_) thread.join();
  }

  void start(int n) {
    try {
      for (int i = 0; i < n; ++i) {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          ++running_;
        }
        threads_.emplace_back([this] {
          batch_.run([] {});
          const std::lock_guard<std::mutex> lock(mutex_);
          --running_;
          ended_.notify_one();
        });
      }
    } catch (const std::system_error&) {  // the others do
      const std::lock_guard<std::mutex> lock(mutex_);
      --running_;
    }
  }
  /// False if some still work after that time.
  bool waitFor(Clock::duration time) {
    std::unique_lock<std::mutex> lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return running_ == 0; });
  }
  bool any() const { return !threads_.empty(); }

 private:
  Batch& batch_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable ended_;
  int running_ = 0;
};

}  // namespace

int threadsOf(const py::object& threads) {
  if (threads.is_none()) return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(threads.ptr()));
  const Py_ssize_t n = index ? PyNumber_AsSsize_t(index.ptr(), nullptr) : 0;  // numpy's as well
  PyErr_Clear();
  if (n < 1)
    throw std::invalid_argument("fcl_kios: threads must be an int of at least 1, or None.");
  return static_cast<int>(std::min<Py_ssize_t>(n, 1024));
}

void runBatch(std::size_t n, const BatchOptions& options, const char* what,
              const std::function<void(std::size_t)>& work) {
  const int threads = threadsOf(options.threads);
  const bool tell = !options.progress.is_none();
  Batch batch(n, work);
  std::exception_ptr raised;
  std::size_t told = 0;
  const auto hear = [&] {
    const WithGil gil;
    try {
      listen();
      const std::size_t done = batch.done();
      if (tell && done > told) options.progress(done - std::exchange(told, done));
    } catch (...) {
      raised = std::current_exception();
      batch.stop();
    }
  };
  {
    const WithoutGil released;
    Helpers helpers(batch);
    const Clock::time_point start = Clock::now();
    Clock::time_point listened = start;
    batch.run([&] {
      const Clock::time_point now = Clock::now();
      if (threads > 1 && !helpers.any() && now - start > microseconds(300) &&
          !batch.isHandedOut()) {
        const auto items = static_cast<double>(n) / static_cast<double>(batch.done());
        if ((now - start) * items > microseconds(800)) helpers.start(threads - 1);
      }
      if (now - listened > milliseconds(20)) {
        hear();
        listened = now;
      }
    });
    while (!helpers.waitFor(milliseconds(20))) {
      if (!raised) hear();
    }
  }
  if (!raised && n > 0) hear();
  if (raised) std::rethrow_exception(raised);
  batch.rethrow(what);
}

}  // namespace kios::python
