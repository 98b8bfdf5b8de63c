// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "text_file.h"

namespace kios::robot {

/// How many threads are worth it; 0 asks for one a core.
inline int threadsFor(int asked, long long items) {
  if (asked < 0) refuse("the number of threads is negative.");
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return static_cast<int>(std::max(1LL, std::min<long long>(asked > 0 ? asked : cores, items)));
}

/// Calls work(i, thread) for every i < count; the threads take `few` at a time. The first exception
/// ends it, and is thrown again.
template <typename Work>
void forAll(long long count, int threads, long long few, const Work& work) {
  std::atomic<long long> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto run = [&](int thread) {
    try {
      for (;;) {
        const long long first = next.fetch_add(few);
        if (first >= count) return;
        for (long long i = first; i < std::min(count, first + few); ++i) work(i, thread);
      }
    } catch (...) {
      next = count;
      const std::lock_guard<std::mutex> lock(guard);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(threads));
  try {
    for (int t = 1; t < threads; ++t) others.emplace_back(run, t);
  } catch (const std::system_error&) {  // those that could be started do
  }
  run(0);
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

template <typename Work>
void forAll(long long count, int threads, const Work& work) {
  forAll(count, threads, std::max(1LL, std::min(64LL, count / (8LL * threads))), work);
}

}  // namespace kios::robot
