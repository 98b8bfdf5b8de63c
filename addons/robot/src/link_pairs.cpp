// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>

#include "batch.h"
#include "pair_search.h"
#include "robot_impl.h"

namespace kios {

std::vector<LinkPair> Robot::linkPairs(const PairRequest& options) const {
  if (options.max_boxes < 0) robot::refuse("max_boxes is negative.");
  if (!(options.max_seconds >= 0)) robot::refuse("max_seconds must be >= 0.");
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
  using Clock = std::chrono::steady_clock;
  const auto secondsSince = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const Clock::time_point start = Clock::now();
  std::mutex guard;
  std::size_t settled = 0;
  const auto count_settled = [&] {
    const std::lock_guard<std::mutex> lock(guard);
    ++settled;
    if (options.progress) options.progress(settled, result.size());
  };
  // Each round looks at more boxes a pair, so that none takes the time that others need.
  constexpr long long kFirst = 4096, kMore = 16;
  const long long size = static_cast<long long>(tasks.size());
  for (long long boxes = std::min(kFirst, options.max_boxes);; boxes *= kMore) {
    boxes = std::min(boxes, options.max_boxes);
    const bool first = boxes <= kFirst;
    robot::forEachAlone(size, robot::threadsFor(options.threads, size), [&](long long i) {
      LinkPair& pair = result[static_cast<std::size_t>(i)];
      if (!first && pair.verdict != PairVerdict::kOpen) return;
      const Clock::time_point begin = Clock::now();
      if (!pair.adjacent) {
        const Task& task = tasks[static_cast<std::size_t>(i)];
        robot::PairSearch search(arm, task.a, task.b);
        if (!first || !search.look(pair)) {
          search.prove(
              boxes, [&] { return secondsSince(start) >= options.max_seconds; }, pair);
        }
        pair.seconds += secondsSince(begin);
      }
      if (pair.verdict != PairVerdict::kOpen) count_settled();
    });
    if (boxes == options.max_boxes || settled == result.size() ||
        secondsSince(start) >= options.max_seconds) {
      return result;
    }
  }
}

void Robot::ignore(const std::vector<LinkPair>& pairs) {
  for (const LinkPair& pair : pairs) {
    impl_->requireLink(pair.a);
    impl_->requireLink(pair.b);
  }
  for (const LinkPair& pair : pairs) {
    const bool ignored =
        pair.verdict == PairVerdict::kAlways || pair.verdict == PairVerdict::kNever;
    if (ignored) ignorePair(pair.a, pair.b);
  }
}

namespace {

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const char* const entity = c == '&'    ? "&amp;"
                               : c == '<'  ? "&lt;"
                               : c == '>'  ? "&gt;"
                               : c == '"'  ? "&quot;"
                               : c == '\n' ? "&#10;"
                               : c == '\t' ? "&#9;"
                               : c == '\r' ? "&#13;"
                                           : nullptr;
    if (entity) {
      text += entity;
    } else {
      text += c;
    }
  }
  return text;
}

using Reasons = std::map<robot::NamePair, std::string>;

/// The SRDF that allows pairs for `known` reasons, but for what linkPairs() says.
std::string srdfOf(const std::string& robot, const std::vector<std::string>& elements,
                   Reasons known, const std::vector<LinkPair>& pairs) {
  for (const LinkPair& pair : pairs) {
    const robot::NamePair names = robot::namePair(pair.a, pair.b);
    const auto told = known.find(names);
    const bool always = pair.verdict == PairVerdict::kAlways;
    if (always || pair.verdict == PairVerdict::kNever) {
      known[names] = pair.adjacent ? "Adjacent" : always ? "Default" : "Never";
    } else if (told != known.end() && pair.verdict == PairVerdict::kSometimes &&
               told->second == "Never") {
      known.erase(told);
    }
  }
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(robot) + "\">\n";
  for (const std::string& element : elements) text += element + "\n";
  for (const auto& [names, reason] : known) {
    text += "  <disable_collisions link1=\"" + escaped(names.first) + "\" link2=\"" +
            escaped(names.second) + "\" reason=\"" + escaped(reason) + "\"/>\n";
  }
  return text + "</robot>\n";
}

}  // namespace

std::string toSrdf(const std::vector<LinkPair>& pairs, const std::string& robot) {
  return srdfOf(robot, {}, {}, pairs);
}

std::string Robot::toSrdf(const std::vector<LinkPair>& pairs) const {
  const robot::Description& files = impl_->arm->description;
  return srdfOf(files.name, files.srdf, files.reasons, pairs);
}

}  // namespace kios
