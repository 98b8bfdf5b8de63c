// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "fcl_kios/solid/closedness.h"
#include "model/prepared.h"
#include "solid/convexity.h"
#include "solid/inner_balls.h"

namespace kios {

/// The mark of a model as a solid, and what queries want to know of it in one state of the model.
/// Immutable, but for what is found out at its first use.
template <typename S>
class SolidState final : public Attachment {
 public:
  explicit SolidState(const Model<S>& model);
  std::shared_ptr<const Attachment> renewed(const void* model) const override;

  const Closedness<S>& closedness() const { return closedness_; }
  /// Throws std::invalid_argument if the model was changed so that it bounds no solid.
  void check() const {
    if (!closedness_.isSolid()) refuseOpened();
  }
  /// Holds some vertices of a component: of its first triangle and of its last.
  using Vertices = std::array<int, 6>;
  const std::vector<Vertices>& components() const { return components_; }
  /// The model must be in this state.
  const Convexity& convexity(const Model<S>& model) const;
  const InnerBalls& balls(const Model<S>& model) const;

 private:
  [[noreturn]] void refuseOpened() const;

  Closedness<S> closedness_;
  std::vector<Vertices> components_;
  mutable std::once_flag convexity_known_, balls_known_;
  mutable Convexity convexity_;
  mutable InnerBalls balls_;
};

/// Returns the model's mark; nullptr if it has none.
template <typename S>
const SolidState<S>* markOf(const Model<S>& model) {
  return static_cast<const SolidState<S>*>(preparedOf(model).attachment.get());
}

/// Returns true if both models are marked. Throws std::invalid_argument if one that is is no solid
/// any more.
template <typename S>
bool areSolids(const Model<S>& a, const Model<S>& b) {
  const SolidState<S>*const mark_a = markOf(a), *const mark_b = markOf(b);
  if (mark_a) mark_a->check();
  if (mark_b) mark_b->check();
  return mark_a && mark_b;
}

/// Returns the state of a marked model. Throws std::invalid_argument if it is unfinished, not
/// marked, or no solid any more.
template <typename S>
const SolidState<S>& requireSolid(const Model<S>& model);

}  // namespace kios
