// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "paper/packed_policy.h"

namespace kios::paper {

/// A cap's place by its height: rounded alike wherever it is computed, so that the radius that was
/// measured from there stays the right one.
inline fcl::Vector3f placeAt(float height, const fcl::Vector3f& direction) {
  return {height * direction[0], height * direction[1], height * direction[2]};
}

template <typename Visit>
void PackedPolicy::visitCaps(PackedStore::Packed v, const Shared& model, Visit visit) const {
  if (v.pairs == 0) return;
  const bool by_height = axes_ != Axes::kOfTheVolume;
  const bool shared_radius = options_.shared_radius;
  const fcl::Vector3f* const along = by_height ? directions(model).data() : nullptr;
  const float* in = v.data + 4;
  const float shared = shared_radius ? *in++ : 0;
  int i = 0;
  for (int pair = 0; v.pairs >> pair != 0; ++pair) {
    if ((v.pairs >> pair & 1) == 0) continue;
    for (int side = 0; side < 2; ++side, ++i) {
      if (by_height) {
        const float height = *in++;
        const fcl::Vector3f o = placeAt(height, along[pair]);
        visit(i, height, o[0], o[1], o[2], shared_radius ? shared : *in++);
      } else {
        const float x = in[0], y = in[1], z = in[2];
        in += 3;
        visit(i, 0.0F, x, y, z, shared_radius ? shared : *in++);
      }
    }
  }
}

}  // namespace kios::paper
