// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "linkage/local_slabs.h"
#include "linkage/near_pairs.h"

namespace kios::articulated {

/// A pair that its bounding volumes don't prove for the whole path at once.
struct Suspect {
  Pair pair;
  /// Where it was found: the bound by volumes, and what would prove all of an interval.
  double roots = 0, enough = 0;
  double seen = -1;  ///< where a slab was looked for last
  // In tests of volumes: slabs between triangles may spend what queries did.
  long long asked = 0;     ///< spent on queries
  long long retry = 0;     ///< what is to be spent before slabs are tried again
  double way = 0;          ///< how much of the path a query proves of late
  bool undecided = false;  ///< somewhere
  bool turns = true;       ///< turns were not tried yet
  int place = -1;          ///< of its LocalSlabs, if there are any
};

/// An interval that is not proven yet for a suspect.
struct Task {
  int suspect;
  double from, to;
  double look_at;  ///< in the interval
  /// Distance less motion, by what is known of a configuration nearby; `from` where the first
  /// contact is looked for. The least comes first.
  double margin = 0;
};

/// The task that is the most urgent comes first from a heap.
struct MostUrgent {
  bool operator()(const Task& a, const Task& b) const { return a.margin > b.margin; }
};

/// A number in the middle of an interval with few bits, so that many pairs are asked about in one
/// configuration.
double middleOf(double from, double to);

/// The memory of a search, which the next one takes over.
struct Scratch {
  std::vector<Configuration> configurations;
  std::vector<Suspect> suspects;
  std::vector<Pair> pairs;
  std::vector<std::pair<double, int>> near;
  std::vector<std::pair<double, double>> intervals;
  std::vector<Task> waiting;
  NearPairs near_pairs;
};

/// The search for a contact on a path, or for the proof that there is none. A pair of bodies that
/// is proven to be d apart at a configuration stays apart as long as its motion (PairMotion) uses
/// up less than d and the separation asked for leave. A query in the middle of an interval asks
/// whether it is proven as a whole; if not, the rest of it on both sides is asked about later.
class MotionSearch {
 public:
  /// Searches for all pairs, or for one alone.
  MotionSearch(const Path& path, const MotionRequest& request, const Pair* only = nullptr);
  MotionSearch(const MotionSearch&) = delete;
  ~MotionSearch();
  MotionSearch& operator=(const MotionSearch&) = delete;

  MotionResult run();

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
  /// Gathers the pairs that aren't proven apart within `time` of s.
  std::vector<Pair>& gather(double s, double time);
  /// Finds the pairs that nothing proves clear for all of the path at its middle, and tasks for
  /// them. True if a contact is found there, at the end, or of a pair that nothing moves.
  bool findSuspects();
  /// Adds the pairs that move and that volumes at s don't prove within `time` of it.
  void addSuspects(const std::vector<Pair>& pairs, double s, double time);
  /// Drops the suspects from `first` on that a slab in the middle of an interval proves for all of
  /// it, and adds tasks for the others.
  void dismissBySlabs(std::size_t first, double from, double to);
  /// Decides a pair that nothing moves by the configuration s, as far as that can be. True if it is
  /// in contact.
  bool stillTouching(Pair pair, double s);
  /// True if one of the suspects from `first` on, which were found at s, is in contact there.
  bool touching(double s, std::size_t first);
  bool touchingAtEnd();
  /// True if one of two solids lies in the other at s; only then it may do so where the surfaces
  /// are proven apart from s on, or up to s.
  bool containedAt(double s);
  Look look(const Task& task);
  /// By what turns leave as it is, or by slabs between triangles, once a pair has been looked at
  /// often; else nothing.
  Look local(const Task& task);
  /// What the last such search proved of an interval, which it may have passed.
  Look knownLocally(const Task& task) const;
  Look proven(const Task& task, double s, double apart, const PairMotion& motion) const;
  /// By a slab across the pair's direction; see SlabMotion.
  Look bySlab(const Task& task, const Pair& pair, const Configuration& c, double width,
              bool planes) const;
  /// True if that spares an interval a query.
  static bool isMuch(const Look& look, const Task& task);
  bool contactAt(double s, int suspect);
  bool budgetSpent() const { return counts_.queries >= request_.max_queries; }

  /// Looks at what waits until a contact ends the search, or nothing is left.
  void search();
  /// Adds what is left of a task once [from, to] is proven, or can't be.
  void pushRest(const Task& task, double from, double to, const Look& look);
  void push(int suspect, double from, double to, const Look& look);
  void enqueue(const Task& task);
  /// True if what can't be proven of an interval isn't looked at in shorter ones.
  bool isShortest(const Task& task) const;
  /// Notes a short interval that can't be proven, or a contact at one of its ends.
  void undecided(const Task& task, double s);
  /// True if nothing that waits can change the answer.
  bool decided() const;
  /// All is proven up to there, where the first contact is looked for.
  double provenUpTo() const;
  void noteProven(int suspect, double from, double to);
  void conclude();

  const Path& path_;
  const MotionRequest& request_;
  const Pair* const only_;
  MotionCounts counts_;
  const BodyQueries queries_;
  const bool looks_for_touch_;  ///< at single configurations, before intervals are looked at
  std::unique_ptr<Scratch> own_;
  Scratch& scratch_;
  std::vector<Configuration>& cache_;
  std::size_t cached_ = 0, next_ = 0;  ///< configurations of this path; the one to be overwritten
  std::vector<Suspect>& suspects_;
  /// Holds what is tried for a suspect that nothing else proves.
  struct Local {
    std::unique_ptr<LocalSlabs> slabs;
    double from = 0, to = 0;  ///< what was proven last
  };
  std::vector<Local> local_;
  std::vector<Task>& waiting_;
  End end_;
  End contact_, undecided_;  ///< the earliest that are known
};

}  // namespace kios::articulated
