// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The order in which a search looks at the intervals of its suspects. For any contact, the least
// proven come first. For the first one, the earliest do, so that all before them is proven; what
// lies after a contact that is known waits.

#include <algorithm>

#include "linkage/motion_search.h"
#include "linkage/tuning.h"

namespace kios::articulated {
void MotionSearch::push(int suspect, double from, double to, const Look& look) {
  if (!(from < to)) return;
  Task task = {suspect, from, to, middleOf(from, to), from};
  if (!request_.first_contact) {
    // What is short for the way that was proven nearby is likely to be proven from an end of the
    // path, where other pairs are looked at too.
    if (to - from < look.way && (from == 0 || to == 1)) task.look_at = to == 1 ? 1 : 0;
    // A pair that can't be decided hardly tells more elsewhere: the others come first. So they do
    // before one that takes many looks, which is then followed through time, as slabs between
    // triangles are.
    const Suspect& own = suspects_[suspect];
    const bool many = own.undecided || own.place >= 0;
    task.margin = many ? (own.undecided ? 4 : 2) + from : look.way - 0.5 * (to - from);
  }
  enqueue(task);
}

bool MotionSearch::isShortest(const Task& task) const {
  const double part = request_.first_contact ? tuning::kApproach : 1;
  return !(task.to - task.from > part * request_.resolution);
}

void MotionSearch::enqueue(const Task& task) {
  waiting_.push_back(task);
  std::push_heap(waiting_.begin(), waiting_.end(), MostUrgent());
}

void MotionSearch::pushRest(const Task& task, double from, double to, const Look& look) {
  push(task.suspect, task.from, from, look);
  push(task.suspect, to, task.to, look);
}

// A contact that FCL's GJK sees between shapes is none if a slab proves them apart there.
void MotionSearch::noteProven(int suspect, double from, double to) {
  if (contact_.suspect == suspect && from <= contact_.to && contact_.to <= to) contact_ = {};
}

// Paths begin and end in poses that touch.
void MotionSearch::undecided(const Task& task, double s) {
  const double half = 0.25 * request_.resolution;
  const double from = std::max(task.from, s - half), to = std::min(task.to, s + half);
  for (const double end : {from, to}) {
    if (!contactAt(end, task.suspect)) continue;
    contact_ = {MotionVerdict::kContact, end, end, task.suspect};
    break;
  }
  suspects_[task.suspect].undecided = true;
  if (undecided_.suspect < 0 || (request_.first_contact && from < undecided_.from)) {
    undecided_ = {MotionVerdict::kUnresolved, from, to, task.suspect};
  }
}

double MotionSearch::provenUpTo() const {
  const double waits = waiting_.empty() ? 1 : waiting_.front().from;
  return undecided_.suspect < 0 ? waits : std::min(waits, undecided_.from);
}

// A contact a resolution after what is undecided would not be the first one for sure.
bool MotionSearch::decided() const {
  if (waiting_.empty()) return true;
  if (contact_.suspect >= 0 && (!request_.first_contact || contact_.to <= waiting_.front().from ||
                                contact_.to - provenUpTo() <= request_.resolution)) {
    return true;
  }
  return request_.first_contact && undecided_.suspect >= 0 &&
         waiting_.front().from >= undecided_.from + request_.resolution;
}

void MotionSearch::search() {
  using Outcome = Look::Outcome;
  const bool first = request_.first_contact;
  for (Task& task : waiting_) task.margin = first ? task.from : task.margin;
  std::make_heap(waiting_.begin(), waiting_.end(), MostUrgent());
  for (int undecided_count = 0; !decided() && undecided_count < tuning::kMostUndecided;) {
    const double before = provenUpTo();
    std::pop_heap(waiting_.begin(), waiting_.end(), MostUrgent());
    Task task = waiting_.back();
    waiting_.pop_back();
    if (budgetSpent()) {
      end_ = {MotionVerdict::kBudgetSpent, first ? before : task.from, task.to, task.suspect};
      if (!first && undecided_.suspect >= 0) end_ = undecided_;
      return;
    }
    if (first) {
      const double end = task.to;
      if (contact_.suspect >= 0) task.to = std::min(task.to, contact_.to);
      if (undecided_.suspect >= 0) {
        task.to = std::min(task.to, undecided_.from + request_.resolution);
      }
      push(task.suspect, task.to, end, {});
      task.look_at = middleOf(task.from, task.to);
    }
    const Look result = look(task);
    if (result.outcome == Outcome::kProven) {
      noteProven(task.suspect, task.from, task.to);
    } else if (result.outcome == Outcome::kContact) {
      contact_ = {MotionVerdict::kContact, result.s, result.s, task.suspect};
      pushRest(task, result.s, result.s, result);
    } else if (result.outcome == Outcome::kPart && !isShortest(task)) {
      if (result.from < result.to) noteProven(task.suspect, result.from, result.to);
      pushRest(task, result.from, result.to, result);
    } else {
      undecided_count += first ? 0 : 1;
      undecided(task, result.s);
      const double aside = (first ? 0.25 : 1) * request_.resolution;
      if (first || result.outcome == Outcome::kUndecided) {
        pushRest(task, result.s - aside, result.s + aside, result);
      }
    }
  }
  conclude();
}

void MotionSearch::conclude() {
  end_ = contact_.suspect >= 0 ? contact_ : undecided_;
  if (!request_.first_contact || contact_.suspect < 0) return;
  contact_.from = std::min(contact_.to, provenUpTo());
  end_ = contact_.to - contact_.from <= request_.resolution ? contact_ : undecided_;
  const bool starts = end_.verdict == MotionVerdict::kContact && end_.from == 0 && end_.to > 0;
  if (starts && contactAt(0, end_.suspect)) end_.to = 0;
}

}  // namespace kios::articulated
