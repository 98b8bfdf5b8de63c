// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "fcl_kios/solid/closedness.h"
#include "solid/convexity.h"
#include "solid/inner_balls.h"
#include "tree/tree_cache.h"

namespace kios {

/// Says what queries want to know of a solid in one state of its model. Immutable, but for what is
/// found out at its first use.
template <typename S>
class SolidState {
 public:
  explicit SolidState(const Model<S>& model);

  const Closedness<S>& closedness() const { return closedness_; }
  /// Holds the vertices of a component that are extreme along the axes, from -x to +z.
  using Extremes = std::array<int, 6>;
  const std::vector<Extremes>& components() const { return components_; }
  /// The model must be in this state.
  const Convexity& convexity(const Model<S>& model) const;
  const InnerBalls& balls(const Model<S>& model) const;

 private:
  Closedness<S> closedness_;
  std::vector<Extremes> components_;
  mutable std::once_flag convexity_known_, balls_known_;
  mutable Convexity convexity_;
  mutable InnerBalls balls_;
};

/// The mark of a model and of its copies. It examines each state of them once: fits and merges
/// stamp a model's root volume, so that no two states share a stamp.
template <typename S>
class SolidMark final : public engine::TreeCache::Attachment {
 public:
  SolidMark();
  ~SolidMark() override;
  SolidMark(const SolidMark&) = delete;

  /// Throws std::invalid_argument if the model's present state is no solid. Takes no lock if that
  /// is known.
  void check(const Model<S>& model) {
    const std::uint64_t stamp = model.getBV(0).bv.stamp;
    for (const auto& good : good_) {
      if (good.load(std::memory_order_relaxed) == stamp) return;
    }
    require(model);
  }
  /// Does the same, and returns the state.
  std::shared_ptr<const SolidState<S>> require(const Model<S>& model);
  /// Returns the state without that check.
  std::shared_ptr<const SolidState<S>> stateOf(const Model<S>& model);

 private:
  struct Known {
    std::uint64_t stamp = 0;
    std::shared_ptr<const SolidState<S>> state;
  };
  std::array<std::atomic<std::uint64_t>, 32> good_{};  ///< stamps of states that are solids
  std::mutex mutex_;
  std::array<Known, 32> known_;
  std::size_t next_ = 0;
};

namespace detail {
/// Counts the marks of all models. While it is 0, no query looks for marks.
extern std::atomic<int> num_solid_marks;

template <typename S>
SolidMark<S>* findMark(const Model<S>& model);
}  // namespace detail

/// Returns true if any model is marked.
inline bool marksExist() { return detail::num_solid_marks.load(std::memory_order_relaxed) != 0; }

/// Returns the model's mark; nullptr if it has none.
template <typename S>
SolidMark<S>* markOf(const Model<S>& model) {
  return marksExist() ? detail::findMark(model) : nullptr;
}

/// Returns true if both models are marked. Throws std::invalid_argument if one that is is no solid
/// any more.
template <typename S>
bool areSolids(const Model<S>& a, const Model<S>& b) {
  SolidMark<S>*const mark_a = markOf(a), *const mark_b = markOf(b);
  if (!mark_a && !mark_b) return false;
  if (mark_a) mark_a->check(a);
  if (mark_b) mark_b->check(b);
  return mark_a && mark_b;
}

/// Throws std::invalid_argument if the model is unfinished, not marked, or no solid any more.
template <typename S>
void checkSolid(const Model<S>& model);
/// Checks it, and returns the solid's state. Throws std::invalid_argument if the model is
/// unfinished, not marked, or no solid any more.
template <typename S>
std::shared_ptr<const SolidState<S>> requireSolid(const Model<S>& model);

}  // namespace kios
