// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/near_list.h"

#include <algorithm>

namespace kios::scene {

template <typename S>
void NearList<S>::follow(const std::vector<Body<S>>& bodies) {
  ++age_;
  if (resting_ > 0 && --resting_ > 0) return;
  moved_ = 0;
  if (bodies.size() != marks_.size()) valid_ = false;
  const std::size_t known = std::min(bodies.size(), marks_.size());
  for (std::size_t id = 0; id < known; ++id) {
    const Body<S>& body = bodies[id];
    const Mark& mark = marks_[id];
    if (body.generation == mark.generation) {
      moved_ = std::max(moved_, addUp(body.path, -mark.path));
      valid_ = valid_ && body.rotation_error <= mark.rotation_error;
    } else {
      valid_ = false;
    }
  }
}

template <typename S>
double NearList<S>::startFor(double limit, const std::vector<Body<S>>& bodies) {
  constexpr double kMostQueries = 16, kLeastQueries = 2, kLimitShare = 0.125, kSizeShare = 1;
  valid_ = listing_ = false;
  if (resting_ > 0) return limit;
  const double per_query = 2 * moved_ / static_cast<double>(std::max(1LL, age_));
  const double ahead = std::min(kMostQueries * per_query, kSizeShare * size_);

  marks_.clear();
  double radii = 0;
  for (const Body<S>& body : bodies) {
    marks_.push_back({body.generation, body.path, body.rotation_error});
    radii += std::min(body.sphere.radius, 1e300);
  }
  size_ = bodies.empty() ? 0 : radii / static_cast<double>(bodies.size());
  moved_ = 0;
  age_ = 0;
  if (!(ahead >= kLeastQueries * per_query)) {
    rest();
    return limit;
  }
  pairs_.clear();
  capacity_ = 8 * bodies.size() + 1024;
  reach_ = limit + ahead + kLimitShare * std::max(limit, 0.0);
  listing_ = reach_ > limit;
  return listing_ ? reach_ : limit;
}

template <typename S>
bool NearList<S>::add(int a, int b) {
  if (pairs_.size() == capacity_) rest();
  if (listing_) pairs_.emplace_back(a, b);
  return listing_;
}

template <typename S>
void NearList<S>::rest() {
  pairs_.clear();
  valid_ = listing_ = false;
  resting_ = 16;
}

template class NearList<double>;
template class NearList<float>;

}  // namespace kios::scene
