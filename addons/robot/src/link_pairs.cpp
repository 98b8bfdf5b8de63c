// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <set>

#include "batch.h"
#include "pair_search.h"
#include "robot_impl.h"

namespace kios {

std::vector<LinkPair> Robot::linkPairs(const PairOptions& options) const {
  if (options.max_boxes < 0) robot::refuse("PairOptions::max_boxes is negative.");
  const robot::Arm& arm = *impl_->arm;
  std::set<robot::NamePair> joined;
  for (const robot::UrdfJoint& joint : arm.description.joints) {
    joined.insert(robot::namePair(arm.links[static_cast<std::size_t>(joint.parent)],
                                  arm.links[static_cast<std::size_t>(joint.child)]));
  }
  struct Task {
    int a, b;
  };
  std::vector<Task> tasks;
  std::vector<LinkPair> result;
  const int count = static_cast<int>(arm.links.size());
  const auto hasBodies = [&](int link) {
    return !arm.description.links[static_cast<std::size_t>(link)].elements.empty();
  };
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (!hasBodies(a) || !hasBodies(b)) continue;
      LinkPair pair;
      pair.a = arm.links[static_cast<std::size_t>(a)];
      pair.b = arm.links[static_cast<std::size_t>(b)];
      pair.adjacent = joined.count(robot::namePair(pair.a, pair.b)) != 0;
      if (pair.adjacent) pair.verdict = PairVerdict::kAlways;
      tasks.push_back({a, b});
      result.push_back(std::move(pair));
    }
  }
  const long long size = static_cast<long long>(tasks.size());
  robot::forEachAlone(size, robot::threadsFor(options.threads, size), [&](long long i) {
    LinkPair& pair = result[static_cast<std::size_t>(i)];
    if (pair.adjacent) return;
    const auto begin = std::chrono::steady_clock::now();
    const Task& task = tasks[static_cast<std::size_t>(i)];
    robot::PairSearch(arm, task.a, task.b).run(options, pair);
    pair.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  });
  return result;
}

std::string toSrdf(const std::vector<LinkPair>& pairs) {
  std::string text;
  for (const LinkPair& pair : pairs) {
    const bool always = pair.verdict == PairVerdict::kAlways;
    if (!always && pair.verdict != PairVerdict::kNever) continue;
    const char* const reason = pair.adjacent ? "Adjacent" : always ? "Default" : "Never";
    text += "  <disable_collisions link1=\"" + pair.a + "\" link2=\"" + pair.b + "\" reason=\"" +
            reason + "\"/>\n";
  }
  return text;
}

}  // namespace kios
