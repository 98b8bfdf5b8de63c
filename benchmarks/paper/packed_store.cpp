// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "paper/visit_caps.h"

namespace kios::paper {

void PackedStore::add(const CapSpheres& v) {
  if (!v.empty) {
    floats_.insert(floats_.end(), {v.center[0], v.center[1], v.center[2], v.radius});
    if (v.shared_radius && v.caps > 0) floats_.push_back(v.r[0]);
    for (int i = 0; i < v.caps; ++i) {
      if (v.by_height) {
        floats_.push_back(v.height[i]);
      } else {
        floats_.insert(floats_.end(), {v.x[i], v.y[i], v.z[i]});
      }
      if (!v.shared_radius) floats_.push_back(v.r[i]);
    }
  }
  if (floats_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("fcl_kios: a store of packed volumes holds at most 2^32 floats.");
  }
  begin_.push_back(static_cast<std::uint32_t>(floats_.size()));
  pairs_.push_back(v.pairs);
}

CapSpheres PackedPolicy::unpack(PackedStore::Packed v, const Shared& model) const {
  CapSpheres s;
  s.empty = v.data == nullptr;
  s.by_height = axes_ != Axes::kOfTheVolume;
  s.shared_radius = options_.shared_radius;
  s.pairs = v.pairs;
  if (s.empty) return s;
  std::copy_n(v.data, 3, s.center);
  s.radius = v.data[3];
  visitCaps(v, model, [&s](int i, float height, float x, float y, float z, float r) {
    s.caps = i + 1;
    s.height[i] = height;
    s.x[i] = x;
    s.y[i] = y;
    s.z[i] = z;
    s.r[i] = r;
  });
  return s;
}

const std::vector<fcl::Vector3f>& PackedPolicy::directions(const Shared& model) const {
  return axes_ == Axes::kCoordinates ? given_ : model.directions;
}

}  // namespace kios::paper
