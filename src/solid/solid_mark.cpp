// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_mark.h"

#include <stdexcept>
#include <utility>

#include "fcl_kios/solids.h"
#include "model/kios_model.h"
#include "model/members.h"
#include "solid/components.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {

SolidState::SolidState(const Mesh& mesh) {
  const Components parts(mesh);
  closedness_ = parts.closedness();
  inwards_ = parts.inwards();
  for (const std::vector<int>& triangles : parts.triangles()) {
    const auto first = static_cast<std::size_t>(triangles.front()),
               last = static_cast<std::size_t>(triangles.back());
    Vertices& vertices = components_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[k] = mesh.corner(first, k);
      vertices[k + 3] = mesh.corner(last, k);
    }
  }
}

const Convexity& SolidState::convexity(const Mesh& mesh) const {
  std::call_once(convexity_known_, [&] {
    if (closedness_.components == 1) convexity_ = measureConvexity(mesh);
  });
  return convexity_;
}

const InnerBalls& SolidState::balls(const Mesh& mesh) const {
  std::call_once(balls_known_, [&] { balls_ = innerBalls(mesh); });
  return balls_;
}

bool SolidState::hasInnerWalls(const Mesh& mesh) const {
  std::call_once(walls_known_, [&] { walls_ = mayHaveInnerWalls(mesh, closedness_); });
  return walls_;
}

void SolidState::refuseOpened() const {
  refuse("the model is marked as a solid, but was changed since, so that it is none: " +
         faultsOf(closedness_) + "; close it, or call kios::unmarkSolid().");
}

const SolidState& requireSolid(const Mesh& mesh) {
  const auto* const mark = static_cast<const SolidState*>(mesh.attachment());
  if (!mark) refuse("the model is no solid: call kios::markSolid() first.");
  mark->check();
  return *mark;
}

namespace {

/// The model is a new one to all that remember its state, such as scenes.
template <typename S>
void setMark(Model<S>& model, std::shared_ptr<const Attachment> mark) {
  const Members<S> members = membersOf(model);
  members.own();
  Prepared& prepared = members.prepared();
  prepared.attachment = std::move(mark);
  prepared.generation = nextGeneration();
}

}  // namespace

template <typename S>
void markSolid(Model<S>& model) {
  validate(model);
  auto state = std::make_shared<const SolidState>(meshOf(model));
  if (!state->closedness().isSolid()) {  // before anything changes
    refuse("the model bounds no solid: " + faultsOf(state->closedness()) + ".");
  }
  setMark(model, std::move(state));
}

template <typename S>
void unmarkSolid(Model<S>& model) {
  if (markOf(model)) setMark(model, nullptr);
}

template <typename S>
bool isSolid(const Model<S>& model) {
  const SolidState* const mark = markOf(model);
  if (!mark) return false;
  try {
    requireFinished(model);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return mark->closedness().isSolid();
}

KIOS_INSTANTIATE_FUNCTION(markSolid);
KIOS_INSTANTIATE_FUNCTION(unmarkSolid);
KIOS_INSTANTIATE_FUNCTION(isSolid);

}  // namespace kios
