// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "race.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>

namespace kios::bench {
namespace {

double wallMicroseconds() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(time).count();
}

}  // namespace

void Race::run(std::vector<Competitor>& competitors) const {
  const auto now = wall_clock ? wallMicroseconds : nowMicroseconds;
  const std::size_t of_block = std::min(block, questions), of_step = std::min(step, of_block);
  for (Competitor& competitor : competitors) {
    competitor.us.clear();
    if (warm_up) competitor.answer(0, questions);
  }
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Competitor& competitor : competitors) {
      competitor.us.emplace_back((questions + of_step - 1) / of_step, 0.0);
    }
    int rounds = 1;
    for (const Competitor& competitor : competitors) rounds = std::max(rounds, competitor.rounds);
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t begin = 0, number = 0; begin < questions; begin += of_block, ++number) {
        const std::size_t end = std::min(begin + of_block, questions);
        for (std::size_t turn = 0; turn < competitors.size(); ++turn) {
          Competitor& competitor =
              competitors[(turn + number + repeat + round) % competitors.size()];
          if (round >= competitor.rounds) continue;
          if (competitor.before) competitor.before(begin, end);
          for (std::size_t at = begin; at < end; at += of_step) {
            if (at / of_step % competitor.stride != 0) continue;
            const double start = now();
            competitor.answer(at, std::min(at + of_step, end));
            const double us = now() - start;
            double& least = competitor.us.back()[at / of_step];
            least = round == 0 ? us : std::min(least, us);
          }
        }
      }
    }
  }
}

Times timesOf(const Competitor& competitor, std::size_t frames, const Competitor* reference) {
  std::vector<double> repeats, ratios;
  for (std::size_t repeat = 0; repeat < competitor.us.size(); ++repeat) {
    const std::vector<double>& us = competitor.us[repeat];
    repeats.push_back(std::accumulate(us.begin(), us.end(), 0.0) / static_cast<double>(frames));
    if (!reference) continue;
    double theirs = 0, own = 0;
    for (std::size_t step = 0; step < us.size(); ++step) {
      if (us[step] == 0 || reference->us[repeat][step] == 0) continue;
      theirs += reference->us[repeat][step];
      own += us[step];
    }
    ratios.push_back(theirs / own);
  }
  Times times = {median(repeats), *std::min_element(repeats.begin(), repeats.end()), {}};
  if (reference) times.ratio_to_fcl_obbrss = median(std::move(ratios));
  times.repeats_us = std::move(repeats);
  return times;
}

const Competitor* named(const std::string& name, const std::vector<Competitor>& competitors) {
  const auto found = std::find_if(competitors.begin(), competitors.end(),
                                  [&name](const Competitor& c) { return c.name == name; });
  return found == competitors.end() ? nullptr : &*found;
}

double nowMicroseconds() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
#else
  return wallMicroseconds();
#endif
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace kios::bench
