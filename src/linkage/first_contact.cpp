// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The search for the first contact of a path. Intervals of all pairs are looked at in the order of
// their beginnings, so that all before the earliest one is proven; what lies after a contact that
// is known waits.

#include <algorithm>

#include "linkage/motion_search.h"

namespace kios::articulated {
namespace {

// Bodies close in more slowly than the bounds say: what is proven must come nearer to a contact
// than the resolution is long.
constexpr double kApproach = 0x1p-8;

}  // namespace

void MotionSearch::pushEarliest(const Task& task) {
  if (!(task.from < task.to)) return;
  waiting_.push_back(task);
  std::push_heap(waiting_.begin(), waiting_.end(), Earliest());
}

void MotionSearch::splitAround(const Task& task, double s) {
  pushEarliest({task.suspect, task.from, s, 0});
  pushEarliest({task.suspect, s, task.to, 0});
}

// A contact that FCL's GJK sees between shapes is none if a slab proves them apart there.
void MotionSearch::noteProven(int suspect, double from, double to) {
  if (contact_.suspect == suspect && from <= contact_.to && contact_.to <= to) contact_ = {};
}

void MotionSearch::lookForFirst(Task task) {
  using Outcome = Look::Outcome;
  const double middle = middleOf(task.from, task.to);
  if (middle != task.look_at) task.roots = -kInfinity;
  task.look_at = middle;
  const Look result = look(task);
  switch (result.outcome) {
    case Outcome::kContact:
      contact_ = {MotionVerdict::kContact, result.s, result.s, task.suspect};
      splitAround(task, result.s);
      return;
    case Outcome::kProven:
      noteProven(task.suspect, task.from, task.to);
      return;
    case Outcome::kPart:
      if (task.to - task.from > kApproach * request_.resolution) {
        if (result.from < result.to) noteProven(task.suspect, result.from, result.to);
        pushEarliest({task.suspect, task.from, result.from, 0});
        pushEarliest({task.suspect, result.to, task.to, 0});
        return;
      }
      break;
    case Outcome::kUndecided:
      break;
  }
  // Paths begin and end in poses that touch.
  const double half = 0.25 * request_.resolution;
  const double from = std::max(task.from, result.s - half), to = std::min(task.to, result.s + half);
  const bool starts = contactAt(from, task.suspect);
  if (starts || contactAt(to, task.suspect)) {
    const double s = starts ? from : to;
    contact_ = {MotionVerdict::kContact, s, s, task.suspect};
  }
  pushEarliest({task.suspect, task.from, from, 0});
  pushEarliest({task.suspect, from, to, 0, 0, true});
  pushEarliest({task.suspect, to, task.to, 0});
}

void MotionSearch::firstContact() {
  std::make_heap(waiting_.begin(), waiting_.end(), Earliest());
  while (!waiting_.empty()) {
    const double proven = waiting_.front().from;  // but for what is undecided
    const bool stuck = undecided_.suspect >= 0, known = contact_.suspect >= 0;
    const double before = stuck ? undecided_.from : proven;
    if (known && (contact_.to <= proven || contact_.to - before <= request_.resolution)) break;
    // A contact a resolution after what is undecided would not be the first one for sure.
    const double last = before + request_.resolution;
    if (stuck && proven >= last) break;
    std::pop_heap(waiting_.begin(), waiting_.end(), Earliest());
    Task task = waiting_.back();
    waiting_.pop_back();
    if (budgetSpent()) {
      end_ = {MotionVerdict::kBudgetSpent, before, task.to, task.suspect};
      return;
    }
    if (task.undecided) {
      if (!stuck) undecided_ = {MotionVerdict::kUnresolved, task.from, task.to, task.suspect};
      continue;
    }
    const double end = task.to;
    if (known) task.to = std::min(task.to, contact_.to);
    if (stuck) task.to = std::min(task.to, last);
    if (task.to < end) pushEarliest({task.suspect, task.to, end, 0});
    lookForFirst(task);
  }
  conclude();
}

void MotionSearch::conclude() {
  if (contact_.suspect < 0) {
    end_ = undecided_;
    return;
  }
  contact_.from = contact_.to;
  if (!waiting_.empty()) contact_.from = std::min(contact_.from, waiting_.front().from);
  if (undecided_.suspect >= 0) contact_.from = std::min(contact_.from, undecided_.from);
  end_ = contact_.to - contact_.from <= request_.resolution ? contact_ : undecided_;
  const bool starts = end_.verdict == MotionVerdict::kContact && end_.from == 0 && end_.to > 0;
  if (starts && contactAt(0, end_.suspect)) end_.to = 0;
}

}  // namespace kios::articulated
