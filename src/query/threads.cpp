// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "volume/errors.h"

namespace kios {

std::size_t threadsFor(int asked) {
  require(asked >= 0, "the number of threads", asked, "0 or more");
  return asked > 0 ? static_cast<std::size_t>(asked)
                   : std::max(1U, std::thread::hardware_concurrency());
}

void inThreads(std::size_t count, std::size_t threads,
               const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t failed = count;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (i < failed) failure = std::current_exception();
        failed = std::min(i, failed);
      }
    }
  };
  std::vector<std::thread> others;
  others.reserve(std::min(threads, count));
  try {
    while (others.size() + 1 < std::min(threads, count)) others.emplace_back(run);
  } catch (const std::exception&) {  // no more can start: those that run take all items
  }
  run();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace kios
