// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <stdexcept>

#include "fcl_kios/variants/packed_policy.h"

namespace kios {

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
  const float* in = v.data;
  for (float& c : s.center) c = *in++;
  s.radius = *in++;
  float shared = 0;
  if (s.shared_radius && v.pairs != 0) shared = *in++;
  for (int pair = 0; v.pairs >> pair != 0; ++pair) {
    if ((v.pairs >> pair & 1) == 0) continue;
    for (int side = 0; side < 2; ++side) {
      const int i = s.caps++;
      if (s.by_height) {
        s.height[i] = *in++;
        alongDirection(directions(model)[pair], i, s);
      } else {
        s.x[i] = *in++;
        s.y[i] = *in++;
        s.z[i] = *in++;
      }
      s.r[i] = s.shared_radius ? shared : *in++;
    }
  }
  return s;
}

/// A cap's place by its height: rounded alike whenever it is computed, so that the radius that was
/// measured from there still is the right one.
void PackedPolicy::alongDirection(const fcl::Vector3f& direction, int i, CapSpheres& v) {
  v.x[i] = v.height[i] * direction[0];
  v.y[i] = v.height[i] * direction[1];
  v.z[i] = v.height[i] * direction[2];
}

const std::vector<fcl::Vector3f>& PackedPolicy::directions(const Shared& model) const {
  static const std::vector<fcl::Vector3f> coordinate_axes = {
      fcl::Vector3f::UnitX(), fcl::Vector3f::UnitY(), fcl::Vector3f::UnitZ()};
  return axes_ == Axes::kCoordinates ? coordinate_axes : model.directions;
}

}  // namespace kios
