// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What became of a linkage's geometry since it was measured.

#include <algorithm>

#include <fcl/geometry/shape/convex.h>
#include "linkage/link_tree.h"
#include "model/kios_model.h"
#include "model/shape_values.h"
#include "volume/errors.h"

namespace kios {
namespace articulated {
namespace {

/// The solid refers to a convex shape's faces where they lay.
bool sameShape(const Content& body) {
  if (!hasShapeValues(*body.geometry, body.shape_values)) return false;
  return body.solid.kind != shape::Kind::kConvex ||
         static_cast<const fcl::Convexd&>(*body.geometry).getFaces().data() == body.solid.faces;
}

void requireSame(bool same, const char* what, std::size_t id) {
  if (same) return;
  refuse("the ", what, " of body ", id, " was changed since it was added; build the linkage anew.");
}

}  // namespace

void Content::requireUnchanged(std::size_t id) const {
  if (kind == BodyKind::kMesh) {
    requireFinished(*model);
    requireSame(stateOf(*model) == state, "mesh", id);
  } else if (kind == BodyKind::kShape) {
    requireSame(sameShape(*this), "shape", id);
  }
  requireSame(geometry->isOccupied() == occupied, "occupancy", id);
}

bool Content::holdsCells() const {
#if FCL_HAVE_OCTOMAP
  if (kind == BodyKind::kOctree) {
    return cells.contains(continuous::occupiedBox(static_cast<const fcl::OcTreed&>(*geometry)));
  }
#endif
  return true;
}

std::shared_ptr<const Linkage::Impl> RenewedLinkage::of(const Linkage::Impl& linkage) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!impl_ || !impl_->holdsCells()) {
    auto renewed = std::make_shared<Linkage::Impl>(linkage);
    renewed->measureOctrees();
    impl_ = std::move(renewed);
  }
  return impl_;
}

long long RenewedLinkage::pairsOf(const Linkage::Impl& linkage) const {
  if (pairs_.load(std::memory_order_relaxed) == kUnknown) pairs_ = linkage.pairs();
  return pairs_.load(std::memory_order_relaxed);
}

}  // namespace articulated

std::shared_ptr<const Linkage::Impl> Linkage::Impl::current() const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].own) bodies[i].own->requireUnchanged(i);
  }
  if (!holdsCells()) return renewed.of(*this);
  return {std::shared_ptr<const Impl>(), this};
}

bool Linkage::Impl::holdsCells() const {
  return std::all_of(bodies.begin(), bodies.end(),
                     [](const auto& body) { return !body.own || body.own->holdsCells(); });
}

}  // namespace kios
