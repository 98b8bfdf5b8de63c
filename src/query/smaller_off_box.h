// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "model/kios_model.h"
#include "volume/balls.h"
#include "volume/far_apart.h"

namespace kios {

/// True only if the central sphere of the smaller model proves it farther than `margin` >= 0 from
/// the box of the larger one, or its own box does: nothing else of the pair need be looked at.
/// Asked next to what is much larger, as a floor is, and by spheres next to what is thin, as a rod
/// is, unless both are. False says nothing; nothing is prepared. The other arguments are
/// farApart()'s.
template <typename S>
bool smallerOffBox(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                   const fcl::Transform3<S>& X_WB, const CentralWay& way, double squared_errors,
                   double margin);

/// Returns true if one model is so much larger than the other, as a floor than a link, that its
/// spheres are of no use near it: where both balls don't prove the models apart, boxes must.
template <typename S>
bool areUnlike(const kIOS<S>& a, const kIOS<S>& b) {
  constexpr S kMuch = 16;
  return a.radius0 > kMuch * b.radius0 || b.radius0 > kMuch * a.radius0;
}

/// Returns true if the content is so thin, as a rod or a plate, that the spheres of its root reach
/// as far out as such spheres do: its box tells more than they.
template <typename S>
bool isThin(const kIOS<S>& root) {
  return scaled(double{root.reach}, root.exponent) > 3.55 * double{root.radius0};
}

}  // namespace kios
