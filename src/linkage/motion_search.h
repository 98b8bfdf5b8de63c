// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "linkage/local_slabs.h"
#include "linkage/near_pairs.h"

namespace kios::articulated {

/// A pair that its bounding volumes don't prove for the whole path at once.
struct Suspect {
  Pair pair;
  double roots;  ///< rootBound() where it was found
  int looks = 0;
  long long expansions = 0;  ///< of its queries
  double way = 0;            ///< how much of the path a query proves of late
  bool undecided = false;    ///< somewhere
  /// Looks in a row by which turns may prove it; kNoOrbits once they were tried.
  int orbits = 0;
  static constexpr int kNoOrbits = -1;
  int place = -1;  ///< of its LocalSlabs, if there are any
};

/// An interval that is not proven yet for a suspect.
struct Task {
  int suspect;
  double from, to;
  double look_at;             ///< in the interval
  double margin = 0;          ///< distance less motion, by what is known of a configuration nearby
  bool undecided = false;     ///< nothing can be proven of it
  double roots = -kInfinity;  ///< rootBound() where it is looked at, if that is known
};

struct Interval {
  double from, to;
};

/// The task whose distance falls short of its motion most comes first from a heap.
struct LeastProven {
  bool operator()(const Task& a, const Task& b) const { return a.margin > b.margin; }
};
struct Earliest {
  bool operator()(const Task& a, const Task& b) const { return a.from > b.from; }
};

/// A number in the middle of an interval with few bits, so that many pairs are asked about in one
/// configuration.
double middleOf(double from, double to);

/// The memory of a search.
struct Scratch {
  std::vector<Configuration> configurations;
  std::vector<Suspect> suspects, near;
  std::vector<Pair> pairs;
  std::vector<Task> waiting;
  std::vector<Interval> intervals;
  NearPairs near_pairs;
};

/// The search for a contact on a path, or for the proof that there is none. A pair of bodies that
/// is proven to be d apart at a configuration stays apart as long as its motion (PairMotion) uses
/// up less than d and the separation asked for leave. A query in the middle of an interval asks
/// whether it is proven as a whole; if not, the rest of it on both sides is asked about later.
class MotionSearch {
 public:
  MotionSearch(const Path& path, const MotionRequest& request);
  ~MotionSearch();
  MotionSearch(const MotionSearch&) = delete;
  MotionSearch& operator=(const MotionSearch&) = delete;

  MotionAnswer run();

 private:
  /// What a task came to: the whole interval is proven; the part `from` to `to` of it is, which may
  /// be empty; there is a contact at `s`; or nothing can be proven of `s`, by no shorter interval.
  struct Look {
    enum class Outcome { kProven, kPart, kContact, kUndecided } outcome;
    double s = 0, from = 0, to = 0, way = 0;
  };
  /// Where the path isn't clear.
  struct End {
    MotionVerdict verdict = MotionVerdict::kClear;
    double from = 0, to = 1;
    int suspect = -1;
  };

  const Configuration& at(double s);
  /// Gathers the pairs that aren't proven apart within `time` of s, until there are more than
  /// `most`.
  std::vector<Pair>& gather(double s, double time, std::size_t most);
  /// True if no body moves farther on the whole path than so many of its radii.
  bool movesWithin(double radii) const;
  /// Finds the suspects, or a contact: true.
  bool findSuspects();
  /// Adds those of the pairs that root volumes at s don't prove clear from `from` to `to`.
  void suspect(const std::vector<Pair>& pairs, double from, double s, double to);
  void notProvenAtOnce(std::size_t count) {
    counts_.proven_at_once = counts_.pairs - static_cast<long long>(count);
  }
  /// True if a contact is found at the end of the path. Finds the suspects of a short one too.
  bool touchingAtEnd();
  /// Those of the pairs whose root volumes overlap.
  std::vector<Suspect>& overlapping(const std::vector<Pair>& pairs, double s);
  /// Those of the suspects from `first` on.
  std::vector<Suspect>& overlapping(std::size_t first);
  bool touching(std::vector<Suspect>& near, double s);
  /// True if one of two solids lies in the other at s; only then it may do so where the surfaces
  /// are proven apart from s on, or up to s.
  bool containedAt(double s);
  Look look(const Task& task);
  /// By what turns leave as it is, or by slabs between triangles, once a pair has been looked at
  /// often; else nothing.
  Look local(const Task& task);
  /// Tries to prove the suspect for the whole path, once some looks found nothing against it.
  void tryOrbits(int suspect, const Configuration& c);
  /// What the last such search proved of an interval, which it may have passed.
  Look knownLocally(const Task& task) const;
  Look proven(const Task& task, double s, double apart, const PairMotion& motion) const;
  /// `slab` is the width of one across the pair's direction; if there is none, one is looked for.
  Look widened(const Task& task, const Look& look, double slab, Pair& pair,
               const Configuration& c) const;
  bool contactAt(double s, int suspect);
  bool budgetSpent() const { return counts_.queries >= request_.max_queries; }

  void anyContact();
  bool undecided(const Task& task, const Look& look);

  void firstContact();
  void lookForFirst(Task task);
  void splitAround(const Task& task, double s);
  void pushEarliest(const Task& task);
  void noteProven(int suspect, double from, double to);
  void conclude();

  const Path& path_;
  const MotionRequest& request_;
  MotionCounts counts_;
  const BodyQueries queries_;
  std::unique_ptr<Scratch> scratch_;
  std::vector<Configuration>& cache_;
  std::size_t cached_ = 0, next_ = 0;  ///< configurations of this path; the one to be overwritten
  std::vector<Suspect>& suspects_;
  /// Holds what is tried for a suspect that nothing else proves.
  struct Local {
    std::unique_ptr<LocalSlabs> slabs;
    double from = 0, to = 0;  ///< what was proven last
    int rest = 0, pause = 0;  ///< looks to be spared after a search that didn't pay, and next time
  };
  std::vector<Local> local_;
  bool looked_at_end_ = false, suspected_ = false;  ///< the suspects are found
  std::vector<Task>& waiting_;
  End end_;
  // These serve the search for the first contact: the earliest that is known, and the earliest
  // interval of which nothing can be proven.
  End contact_, undecided_;
};

}  // namespace kios::articulated
