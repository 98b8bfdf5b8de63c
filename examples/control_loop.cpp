// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A safety check at 1 kHz: is a tool nearer to a part than the margin? Both are bumpy tori of
// 20,000 triangles. Prints how long the check took, how late the cycle began, and missed deadlines.
//
// usage: control_loop [SECONDS [float]]
#include <fcl_kios/fcl_kios.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "shapes.h"

namespace {

constexpr long long kPeriod = 1000000;  // nanoseconds
constexpr double kMargin = 0.05;

long long now() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1000000000LL + t.tv_nsec;
}

/// Until an absolute time, so that late cycles don't shift those after them.
void sleepUntil(long long deadline) {
  const timespec t = {deadline / 1000000000LL, deadline % 1000000000LL};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) != 0) {
  }
}

/// The tool circles over the part, comes near to it, and touches it.
template <typename S>
fcl::Transform3<S> toolPose(long long cycle) {
  const double t = 1e-3 * static_cast<double>(cycle);
  const fcl::Vector3d place(std::cos(t), std::sin(1.7 * t), 1.5 + 0.9 * std::sin(2.3 * t));
  fcl::Transform3d X_W = fcl::Transform3d::Identity();
  X_W.linear() = fcl::AngleAxisd(0.8 * t, fcl::Vector3d(2, 1, 2) / 3).toRotationMatrix();
  X_W.translation() = place;
  return X_W.cast<S>();
}

/// Microseconds: percentiles, and a bar for each factor of two.
void report(const char* title, std::vector<long long> ns) {
  std::sort(ns.begin(), ns.end());
  std::printf("\n%s, us:", title);
  for (const double q : {50.0, 90.0, 99.0, 99.9}) {
    const auto i = static_cast<std::size_t>(q / 100 * static_cast<double>(ns.size() - 1));
    std::printf("  %g%% %.1f", q, 1e-3 * static_cast<double>(ns[i]));
  }
  std::printf("  max %.1f\n", 1e-3 * static_cast<double>(ns.back()));
  auto begin = ns.begin();
  for (long long edge = 250; begin != ns.end(); edge *= 2) {
    const auto end = std::lower_bound(begin, ns.end(), edge);
    const auto count = static_cast<std::size_t>(end - begin);
    if (begin != ns.begin() || count != 0) {
      const std::string bar((60 * count + ns.size() - 1) / ns.size(), '#');
      std::printf("%9.2f .. %-9.2f %7zu %s\n", 0.5e-3 * static_cast<double>(edge),
                  1e-3 * static_cast<double>(edge), count, bar.c_str());
    }
    begin = end;
  }
}

template <typename S>
int run(double seconds) {
  const auto torus = shapes::bumpyTorus<S>(S(1), S(0.35), 200, 50);
  const auto part = kios::makeModel(torus.vertices, torus.triangles);
  const auto tool = kios::makeModel(torus.vertices, torus.triangles);
  const fcl::Transform3<S> X_part = fcl::Transform3<S>::Identity();

  const auto cycles = static_cast<long long>(1000 * seconds);
  std::vector<long long> took, late;
  std::vector<char> verdicts;
  took.reserve(static_cast<std::size_t>(cycles));
  late.reserve(static_cast<std::size_t>(cycles));
  verdicts.reserve(static_cast<std::size_t>(cycles));

  kios::WarmStart last;  // the triangles that decided last time are looked at first
  long long missed = 0;
  long long deadline = now() + kPeriod;
  for (long long cycle = 0; cycle < cycles; ++cycle) {
    sleepUntil(deadline);
    const long long woken = now();
    const bool too_near =
        kios::closerThan(*tool, toolPose<S>(cycle), *part, X_part, kMargin, nullptr, &last);
    const long long done = now();
    late.push_back(woken - deadline);
    took.push_back(done - woken);
    verdicts.push_back(too_near ? 1 : 0);
    deadline += kPeriod;
    for (; deadline < done; deadline += kPeriod) ++missed;  // periods that began during this one
  }

  std::printf(
      "closerThan(%g) of 20,000 and 20,000 triangles (%s, %s): %lld cycles of 1 ms, too near "
      "in %td, %lld missed\n",
      kMargin, sizeof(S) == sizeof(float) ? "float" : "double", kios::simdTarget(), cycles,
      std::count(verdicts.begin(), verdicts.end(), 1), missed);
  report("the check", took);
  report("the start of the cycle after its time", late);

  for (long long cycle = 0; cycle < cycles; cycle += 10) {
    const auto answer = kios::distanceBracket(*tool, toolPose<S>(cycle), *part, X_part);
    if ((answer.distance <= S(kMargin)) != (verdicts[static_cast<std::size_t>(cycle)] == 1)) {
      std::fprintf(stderr, "cycle %lld: distance %g, but the check said otherwise\n", cycle,
                   static_cast<double>(answer.distance));
      return 1;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 5;
  if (!(seconds >= 0.01 && seconds <= 3600) || (argc > 2 && std::strcmp(argv[2], "float") != 0)) {
    std::fprintf(stderr, "usage: control_loop [SECONDS [float]], 0.01 to 3600 seconds\n");
    return 2;
  }
  return argc > 2 ? run<float>(seconds) : run<double>(seconds);
}
