// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "fcl_kios/solids.h"
#include "model/prepared.h"
#include "solid/convexity.h"
#include "solid/inner_balls.h"

namespace kios {

/// The mark of a model as a solid, and what queries want to know of it in one state of the model.
/// Immutable, but for what is found out at its first use.
class SolidState final : public Attachment {
 public:
  explicit SolidState(const Mesh& mesh);
  std::shared_ptr<const Attachment> renewed(const Mesh& mesh) const override {
    return std::make_shared<const SolidState>(mesh);
  }

  const Closedness& closedness() const { return closedness_; }
  /// Throws std::invalid_argument if the model was changed so that it bounds no solid.
  void check() const {
    if (!closedness_.isSolid()) refuseOpened();
  }
  /// Some vertices of a component: of its first triangle and of its last.
  using Vertices = std::array<Pointd, 6>;
  const std::vector<Vertices>& components() const { return components_; }
  /// Whether a component, by its place, encloses a negative volume.
  const std::vector<bool>& inwards() const { return inwards_; }
  /// `mesh` must be the model's in this state.
  const Convexity& convexity(const Mesh& mesh) const;
  const InnerBalls& balls(const Mesh& mesh) const;
  bool hasInnerWalls(const Mesh& mesh) const;

 private:
  [[noreturn]] void refuseOpened() const;

  Closedness closedness_;
  std::vector<Vertices> components_;
  std::vector<bool> inwards_;
  mutable std::once_flag convexity_known_, balls_known_, walls_known_;
  mutable Convexity convexity_;
  mutable InnerBalls balls_;
  mutable bool walls_ = false;
};

/// The model's mark; nullptr if it has none.
template <typename S>
const SolidState* markOf(const Model<S>& model) {
  return static_cast<const SolidState*>(preparedOf(model).attachment.get());
}

/// Returns true if both models are marked. Throws std::invalid_argument if one that is is no solid
/// any more.
template <typename S>
bool areSolids(const Model<S>& a, const Model<S>& b) {
  const SolidState *const mark_a = markOf(a), *const mark_b = markOf(b);
  if (mark_a) mark_a->check();
  if (mark_b) mark_b->check();
  return mark_a && mark_b;
}

/// The state of a marked model. Throws std::invalid_argument if it is not marked, or no solid any
/// more.
const SolidState& requireSolid(const Mesh& mesh);

}  // namespace kios
