// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: mesh_fuzz [--seed N] [--seconds S] [--case K] [--only QUESTION] [--threads N] [--list]
//                  [--skip QUESTION]... [--shrink S] [--slow S] [--traps 0] [--least N]
// Asks cases 0, 1, 2 ... of a seed until the time is up, or --case's alone; it fails if they are
// fewer than --least (0). At the first failure it prints one line that repeats it, the smallest
// case that fails alike (searched for --shrink seconds), and exits with 1. A case that takes more
// than --slow (1) times the processor time of its question is a failure, and so is an operation
// that raises FE_INVALID or FE_DIVBYZERO, unless --traps is 0.

#include <atomic>
#include <cfenv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <iostream>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include <unistd.h>

#include "fcl_kios/model.h"
#include "fuzz/mesh_fuzz/draw_case.h"
#include "fuzz/mesh_fuzz/listing.h"
#include "fuzz/mesh_fuzz/shrink.h"

namespace kios::fuzz {
namespace {

struct Settings {
  std::uint64_t seed = 1;
  double seconds = 10, shrink_seconds = 20;
  long long index = -1;  ///< negative: all
  long long least = 0;   ///< cases that the time must suffice for
  int threads = 1;
  double slow = 1;  ///< times what a question's case may take
  bool traps = true;
  const Question* only = nullptr;
  std::set<const Question*> skip;
};

/// Holds the case that a thread works on, to be reported if it crashes or hangs.
struct Current {
  std::atomic<std::uint64_t> index{0};
  std::atomic<long long> since{0};  ///< milliseconds of processor time; 0 between cases
};
thread_local Current* current = nullptr;
std::uint64_t running_seed = 0;

/// Returns the processor time of all threads: what a busy or paused machine does to the clock on
/// the wall is no failure.
double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
/// Returns the processor time of this thread alone.
double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
long long milliseconds() { return 1 + static_cast<long long>(1000 * processorSeconds()); }

extern "C" void onCrash(int signal) {
  char line[128];
  const int length =
      std::snprintf(line, sizeof(line), "mesh_fuzz: signal %d in --seed %llu --case %llu\n", signal,
                    static_cast<unsigned long long>(running_seed),
                    static_cast<unsigned long long>(current ? current->index.load() : 0));
  if (write(STDERR_FILENO, line, static_cast<std::size_t>(length)) < 0) _exit(2);
  _exit(1);
}

class Run {
 public:
  explicit Run(const Settings& settings) : settings_(settings) {}

  int run() {
    end_ = std::chrono::steady_clock::now() +
           std::chrono::milliseconds(static_cast<long long>(1000 * settings_.seconds));
    std::vector<Current> states(static_cast<std::size_t>(settings_.threads));
    std::vector<std::thread> threads;
    for (int i = 0; i < settings_.threads; ++i) {
      threads.emplace_back([this, i, &states] { work(i, states[static_cast<std::size_t>(i)]); });
    }
    std::atomic<bool> done{false};
    std::thread watch([&] { watchFor(states, done); });
    for (std::thread& t : threads) t.join();
    done = true;
    watch.join();
    if (!failed_ && cases_ < settings_.least) {
      failed_ = true;
      std::cout << "FAILED: fewer than " << settings_.least << " cases\n";
    }
    std::cout << "mesh_fuzz: seed " << settings_.seed << ", " << simdTarget() << ": " << cases_
              << " cases in " << processorSeconds() << " s of processor time, "
              << (failed_ ? "FAILED" : "clean") << std::endl;
    return failed_ ? 1 : 0;
  }

 private:
  void work(int thread, Current& state) {
    current = &state;
#ifdef __GLIBC__
    if (settings_.traps) feenableexcept(FE_INVALID | FE_DIVBYZERO);
#endif
    const bool one = settings_.index >= 0;
    std::uint64_t i =
        one ? static_cast<std::uint64_t>(settings_.index) : static_cast<std::uint64_t>(thread);
    if (one && thread > 0) return;
    for (; !failed_; i += static_cast<std::uint64_t>(settings_.threads)) {
      if (!one && std::chrono::steady_clock::now() >= end_) break;
      state.index = i;
      state.since = milliseconds();
      const Case c = drawCase(settings_.seed, i, settings_.only);
      if (!one && settings_.skip.count(c.question) > 0) continue;
      const double start = threadSeconds();
      Verdict wrong = ask(c);
      const double seconds = threadSeconds() - start;
      if (!wrong && seconds > settings_.slow * c.question->seconds) {
        wrong = Failure{"takes " + std::to_string(seconds) + " s", ""};
      }
      ++cases_;
      if (wrong) report(c, i, *wrong);
      if (one) break;
    }
    state.since = 0;
  }

  void report(const Case& c, std::uint64_t index, const Failure& first) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failed_.exchange(true)) return;
    current->since = 0;
    std::cout << "FAILED: FCL_KIOS_SIMD=" << simdTarget() << " mesh_fuzz --seed " << settings_.seed
              << " --case " << index;
    if (settings_.only) std::cout << " --only " << c.question->name;
    std::cout << "  # " << c.question->name << (c.in_float ? ", float" : "") << ": " << first.what
              << "; " << first.call << std::endl;
    const Case smallest = shrunk(c, settings_.shrink_seconds);
    if (const Verdict wrong = ask(smallest)) list(smallest, *wrong, std::cout);
    std::cout << std::flush;
  }

  /// A case that takes a minute of a processor hangs.
  void watchFor(const std::vector<Current>& states, const std::atomic<bool>& done) {
    while (!done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      for (const Current& state : states) {
        const long long since = state.since;
        if (since == 0 || milliseconds() - since < 60000LL * settings_.threads) continue;
        std::cout << "FAILED: mesh_fuzz --seed " << running_seed << " --case " << state.index
                  << "  # takes more than a minute" << std::endl;
        _exit(1);
      }
    }
  }

  const Settings settings_;
  std::chrono::steady_clock::time_point end_;
  std::atomic<long long> cases_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
};

const Question* questionOf(const std::string& name) {
  for (const Question& q : questions()) {
    if (name == q.name) return &q;
  }
  std::cerr << "mesh_fuzz: no question '" << name << "'; there are:";
  for (const Question& q : questions()) std::cerr << " " << q.name;
  std::cerr << "\n";
  std::exit(2);
}

Settings parsed(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--list") {
      for (const Question& q : questions()) std::cout << q.name << "\n";
      std::exit(0);
    }
    if (i + 1 == argc) {
      std::cerr << "mesh_fuzz: " << option << " is no option, or lacks its value; see main.cpp\n";
      std::exit(2);
    }
    const std::string value = argv[++i];
    if (option == "--seed") {
      settings.seed = std::stoull(value);
    } else if (option == "--seconds") {
      settings.seconds = std::stod(value);
    } else if (option == "--shrink") {
      settings.shrink_seconds = std::stod(value);
    } else if (option == "--slow") {
      settings.slow = std::stod(value);
    } else if (option == "--traps") {
      settings.traps = value != "0";
    } else if (option == "--case") {
      settings.index = std::stoll(value);
    } else if (option == "--least") {
      settings.least = std::stoll(value);
    } else if (option == "--threads") {
      settings.threads = std::stoi(value);
    } else if (option == "--only") {
      settings.only = questionOf(value);
    } else if (option == "--skip") {
      settings.skip.insert(questionOf(value));
    } else {
      std::cerr << "mesh_fuzz: no option " << option << "\n";
      std::exit(2);
    }
  }
  return settings;
}

}  // namespace
}  // namespace kios::fuzz

int main(int argc, char** argv) {
  for (const int signal : {SIGSEGV, SIGFPE, SIGABRT, SIGILL, SIGBUS}) {
    std::signal(signal, kios::fuzz::onCrash);
  }
  const auto settings = kios::fuzz::parsed(argc, argv);
  kios::fuzz::running_seed = settings.seed;
  return kios::fuzz::Run(settings).run();
}
