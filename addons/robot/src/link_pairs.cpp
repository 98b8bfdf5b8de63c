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
    double pace = 0;  ///< seconds a query
  };
  std::vector<Task> tasks;
  std::vector<LinkPair> result;
  const int links = static_cast<int>(arm.links.size());
  const auto hasBodies = [&](int link) {
    return !arm.description.links[static_cast<std::size_t>(link)].elements.empty();
  };
  for (int a = 0; a < links; ++a) {
    for (int b = a + 1; b < links; ++b) {
      if (!hasBodies(a) || !hasBodies(b)) continue;
      LinkPair pair;
      pair.a = arm.links[static_cast<std::size_t>(a)];
      pair.b = arm.links[static_cast<std::size_t>(b)];
      pair.adjacent = joined.count(robot::namePair(pair.a, pair.b)) != 0;
      tasks.push_back({a, b});
      result.push_back(std::move(pair));
    }
  }
  using Clock = std::chrono::steady_clock;
  const auto secondsSince = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const Clock::time_point start = Clock::now();
  const robot::PairSearch search(arm);
  std::mutex guard;
  std::size_t settled = 0;
  const auto count = static_cast<long long>(tasks.size());
  const auto forOpen = [&](const auto& work) {
    robot::forAll(count, robot::threadsFor(options.threads, count), 1, [&](long long i, int) {
      LinkPair& pair = result[static_cast<std::size_t>(i)];
      if (pair.verdict != PairVerdict::kOpen) return;
      const Clock::time_point begin = Clock::now();
      work(tasks[static_cast<std::size_t>(i)], pair);
      pair.seconds += secondsSince(begin);
      if (pair.verdict == PairVerdict::kOpen) return;
      const std::lock_guard<std::mutex> lock(guard);
      ++settled;
      if (options.progress) options.progress(settled, result.size());
    });
  };
  forOpen([&](const Task& task, LinkPair& pair) {
    if (pair.adjacent) {
      pair.verdict = PairVerdict::kAlways;
    } else {
      search.sample(task.a, task.b, pair);
    }
  });
  // Each round makes more queries a pair, so that none takes the time that others need; and no more
  // than time is left for, at the pace of the round before.
  constexpr long long kFirst = 256, kMore = 4;
  for (long long most = std::min(kFirst, options.max_boxes);;
       most = std::min(most * kMore, options.max_boxes)) {
    forOpen([&](Task& task, LinkPair& pair) {
      const Clock::time_point begin = Clock::now();
      const double left = options.max_seconds - secondsSince(start);
      if (!(left > 0)) return;
      const double few = std::min(static_cast<double>(most), left / task.pace);
      search.prove(task.a, task.b, static_cast<long long>(few), pair);
      task.pace = secondsSince(begin) / std::max(1.0, static_cast<double>(pair.boxes));
    });
    if (most <= kFirst) {
      forOpen([&](const Task& task, LinkPair& pair) {
        if (secondsSince(start) < options.max_seconds) search.look(task.a, task.b, pair);
      });
    }
    if (most == options.max_boxes || settled == result.size() ||
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
