// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace kios::inspect {

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), said_(Clock::now()) {}

void Progress::step(const std::string& what) {
  done();
  what_ = what;
  begun_ = Clock::now();
  if (terminal_ && !quiet_) {
    std::fprintf(stderr, "\r\033[K%s ...", what.c_str());
    std::fflush(stderr);
  }
}

double Progress::done() {
  if (what_.empty()) return 0;
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - begun_).count();
  if (terminal_ && !quiet_) std::fprintf(stderr, "\r\033[K");
  if (!terminal_ && !quiet_ && now - said_ > std::chrono::seconds(1)) {
    std::fprintf(stderr, "%s: %.1f s\n", what_.c_str(), seconds);
    said_ = now;
  }
  what_.clear();
  return seconds;
}

}  // namespace kios::inspect
