// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_mark.h"

#include <stdexcept>
#include <utility>

#include "fcl_kios/solid/solids.h"
#include "model/kios_model.h"
#include "model/members.h"
#include "solid/components.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
template <typename S>
SolidState<S>::SolidState(const Model<S>& model) {
  const Components<S> parts(viewOf(model));
  closedness_ = parts.closedness();
  for (int c = 0; c < closedness_.components; ++c) {
    const auto triangles = parts.trianglesOf(c);
    const fcl::Triangle &first = model.tri_indices[*triangles.begin()],
                        &last = model.tri_indices[*(triangles.end() - 1)];
    Vertices& vertices = components_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[k] = static_cast<int>(first[static_cast<int>(k)]);
      vertices[k + 3] = static_cast<int>(last[static_cast<int>(k)]);
    }
  }
}

template <typename S>
const Convexity& SolidState<S>::convexity(const Model<S>& model) const {
  std::call_once(convexity_known_, [&] {
    if (closedness_.components == 1) convexity_ = measureConvexity(model);
  });
  return convexity_;
}

template <typename S>
const InnerBalls& SolidState<S>::balls(const Model<S>& model) const {
  std::call_once(balls_known_, [&] { balls_ = innerBalls(model); });
  return balls_;
}

template <typename S>
std::shared_ptr<const Attachment> SolidState<S>::renewed(const void* model) const {
  return std::make_shared<const SolidState<S>>(*static_cast<const Model<S>*>(model));
}

template <typename S>
void SolidState<S>::refuseOpened() const {
  refuse("the model is marked as a solid, but was changed since, so that it is none: " +
         faultsOf(closedness_) + "; close it, or call kios::unmarkSolid().");
}

template <typename S>
const SolidState<S>& requireSolid(const Model<S>& model) {
  requireFinished(model);
  const SolidState<S>* const mark = markOf(model);
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
  auto state = std::make_shared<const SolidState<S>>(model);
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
  const SolidState<S>* const mark = markOf(model);
  if (!mark) return false;
  try {
    requireFinished(model);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return mark->closedness().isSolid();
}

KIOS_INSTANTIATE_CLASS(SolidState);
KIOS_INSTANTIATE_FUNCTION(requireSolid);
KIOS_INSTANTIATE_FUNCTION(markSolid);
KIOS_INSTANTIATE_FUNCTION(unmarkSolid);
KIOS_INSTANTIATE_FUNCTION(isSolid);

}  // namespace kios
