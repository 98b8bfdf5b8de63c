// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/scene.h"

#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "scene/body_pair.h"
#include "scene/content.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {

template <typename S>
class ManagerQuery<S>::Impl {
 public:
  explicit Impl(Filter filter) : filter_(std::move(filter)) {}

  void start(bool closest, S margin) {
    memory_.endQuery();
    if (bodies_.size() > 2 * met_ + PairMemory::kSpare) forgetUnmet();
    memory_.beginQuery();
    met_ = 0;
    closest_ = closest;
    bound_ = margin;
    pairs.clear();
    asked_.clear();
    counts = SceneCounts();
  }

  bool ask(const Object* o1, const Object* o2, S& dist) {
    dist = bound_;
    if (done()) return true;
    const Known &a = meet(o1), &b = meet(o2);
    // Some managers come up with a pair twice, in either order.
    if (!asked_.insert(scene::keyOfEither(a.id, b.id)).second) return false;
    ++counts.total;
    if (filter_ && !filter_(o1, o2)) {
      ++counts.filtered;
      return false;
    }
    // A proof of (b, a) is no help: that distance may differ in its last bits.
    scene::BodyPair pair(a.id, a.body, b.id, b.body, memory_);
    const double limit = std::nextafter(double{bound_}, -kInfinity);
    const auto answer = pair.answer(limit, true, counts);
    if (answer.within) {
      if (closest_) {
        pairs.clear();
        dist = bound_ = roundedTo<S>(answer.distance);
      }
      pairs.push_back(
          {o1, o2, roundedTo<S>(answer.distance), answer.triangle_a, answer.triangle_b});
    }
    return done();
  }

  std::vector<Pair> pairs;
  SceneCounts counts;

 private:
  using PairMemory = scene::PairMemory;

  struct Known {
    scene::Body body;
    int id = 0;
    std::uint64_t met = 0;
  };

  bool done() const { return closest_ && bound_ <= 0; }

  Known& meet(const Object* object) {
    Known& known = bodies_[object];
    if (known.met == memory_.query()) return known;
    if (known.body.used()) {
      known.body.content->refresh(known.body);
    } else {
      known.body = scene::makeBody(*object);
      known.id = next_id_++;
    }
    known.met = memory_.query();
    ++met_;
    return known;
  }

  void forgetUnmet() {
    for (auto it = bodies_.begin(); it != bodies_.end();) {
      it = it->second.met == memory_.query() ? std::next(it) : bodies_.erase(it);
    }
  }

  Filter filter_;
  std::unordered_map<const Object*, Known> bodies_;
  std::unordered_set<std::uint64_t> asked_;  // pairs, in this query
  PairMemory memory_{SceneDistance<S>::kMaxRemembered};
  std::size_t met_ = 0;
  int next_id_ = 0;
  bool closest_ = true;
  S bound_ = std::numeric_limits<S>::max();  // pairs so far apart don't matter
};

template <typename S>
ManagerQuery<S>::ManagerQuery(Filter filter) : impl_(std::make_unique<Impl>(std::move(filter))) {
  findClosest();
}
template <typename S>
ManagerQuery<S>::~ManagerQuery() = default;
template <typename S>
ManagerQuery<S>::ManagerQuery(ManagerQuery&&) noexcept = default;
template <typename S>
ManagerQuery<S>& ManagerQuery<S>::operator=(ManagerQuery&&) noexcept = default;

template <typename S>
void ManagerQuery<S>::findClosest() {
  impl_->start(true, std::numeric_limits<S>::max());
}

template <typename S>
void ManagerQuery<S>::findWithin(S margin) {
  if (!(margin == margin)) refuse("a margin is NaN.");
  impl_->start(false, std::nextafter(margin, std::numeric_limits<S>::infinity()));
}

template <typename S>
bool ManagerQuery<S>::callback(Object* o1, Object* o2, void* query, S& dist) {
  return static_cast<ManagerQuery*>(query)->impl_->ask(o1, o2, dist);
}

template <typename S>
const std::vector<typename ManagerQuery<S>::Pair>& ManagerQuery<S>::pairs() const {
  return impl_->pairs;
}

template <typename S>
const SceneCounts& ManagerQuery<S>::counts() const {
  return impl_->counts;
}

template class ManagerQuery<double>;
template class ManagerQuery<float>;

}  // namespace kios
