// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/near_list.h"

#include <algorithm>

#include "scene/tuning.h"

namespace kios::scene {

void NearList::follow(const std::vector<Body>& bodies, bool others) {
  ++age_;
  if (others) valid_ = false;
  if (resting_ > 0 && --resting_ > 0) return;
  moved_ = 0;
  for (std::size_t id = 0; id < std::min(bodies.size(), boxes_.size()); ++id) {
    if (bodies[id].used()) moved_ = std::max(moved_, shift(boxes_[id], bodies[id].box));
  }
}

double NearList::startFor(double gap, const std::vector<Body>& bodies) {
  valid_ = listing_ = false;
  if (resting_ > 0) return gap;
  const double per_query = 2 * moved_ / static_cast<double>(std::max(1LL, age_));
  const double ahead = std::min(static_cast<double>(tuning::kQueries) * per_query, size_);

  boxes_.clear();
  double radii = 0;
  for (const Body& body : bodies) {
    boxes_.push_back(body.box);
    radii += std::min(body.sphere.radius, 1e300);
  }
  size_ = bodies.empty() ? 0 : radii / static_cast<double>(bodies.size());
  moved_ = 0;
  age_ = 0;
  if (!(ahead >= per_query)) {
    rest();
    return gap;
  }
  pairs_.clear();
  capacity_ = tuning::kPairsOfBody * bodies.size() + 1024;
  reach_ = gap + ahead;
  listing_ = reach_ > gap;
  return listing_ ? reach_ : gap;
}

bool NearList::add(int a, int b) {
  if (pairs_.size() == capacity_) rest();
  if (listing_) pairs_.emplace_back(a, b);
  return listing_;
}

void NearList::rest() {
  pairs_.clear();
  valid_ = listing_ = false;
  resting_ = tuning::kQueries;
}

}  // namespace kios::scene
