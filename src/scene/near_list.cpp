// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/near_list.h"

#include <algorithm>

namespace kios::scene {

template <typename S>
void NearList<S>::follow(const std::vector<Body<S>>& bodies) {
  ++query_;
  ++age_;
  moved_ = 0;
  if (bodies.size() != marks_.size()) valid_ = false;
  const std::size_t known = std::min(bodies.size(), marks_.size());
  for (std::size_t id = 0; id < known; ++id) {
    const Body<S>& body = bodies[id];
    const Mark& mark = marks_[id];
    if (body.state == mark.state) {
      moved_ = std::max(moved_, addUp(body.path, -mark.path));
      valid_ = valid_ && body.rotation_error <= mark.rotation_error;
    } else {
      valid_ = false;
    }
  }
}

template <typename S>
double NearList<S>::reachFor(double limit, const std::vector<Body<S>>& bodies) const {
  constexpr double kMostQueries = 8, kLeastQueries = 2, kLimitShare = 0.125, kSizeShare = 0.5;
  if (query_ < tired_until_ || bodies.empty()) return limit;
  double radii = 0;
  for (const Body<S>& body : bodies) radii += std::min(body.sphere.radius, 1e300);
  const double size = radii / static_cast<double>(bodies.size());
  const double per_query = 2 * moved_ / static_cast<double>(std::max(1LL, age_));
  const double ahead = std::min(kMostQueries * per_query, kSizeShare * size);
  if (!(ahead >= kLeastQueries * per_query)) return limit;
  return limit + ahead + kLimitShare * std::max(limit, 0.0);
}

template <typename S>
void NearList<S>::start(double reach, const std::vector<Body<S>>& bodies) {
  pairs_.clear();
  capacity_ = 8 * bodies.size() + 1024;
  reach_ = reach;
  moved_ = 0;
  age_ = 0;
  valid_ = true;
  marks_.clear();
  for (const Body<S>& body : bodies) {
    marks_.push_back({body.state, body.path, body.rotation_error});
  }
}

template <typename S>
bool NearList<S>::add(int a, int b) {
  constexpr int kRest = 16;
  if (pairs_.size() == capacity_) {
    tired_until_ = query_ + kRest;
    pairs_.clear();
    valid_ = false;
  }
  if (valid_) pairs_.emplace_back(a, b);
  return valid_;
}

template class NearList<double>;
template class NearList<float>;

}  // namespace kios::scene
