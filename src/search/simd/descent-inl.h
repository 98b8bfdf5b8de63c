// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// From the roots to the nearest child, each time: two leaves that are near give an upper bound
/// before the search begins. All that is passed by joins the frontier when that bound is known.
class Descent {
 public:
  /// Takes at most so many expansions.
  Descent(const Expander& expander, long long max_steps) : expander_(expander) {
    const auto isInner = [&] { return !expander.areLeaves(end_.pair); };
    while (isInner() && steps_ < kMaxSteps && static_cast<long long>(steps_) < max_steps) {
      if (!step()) return;
    }
    at_leaves_ = !isInner();
  }

  size_t steps() const { return steps_; }
  bool atLeaves() const { return at_leaves_; }
  /// Whether all children at the end are as far as cull_distance.
  bool lost() const { return steps_ > 0 && taken_[steps_ - 1] == 0; }
  /// The pair at the end, unless lost.
  const NodePairList::Entry& end() const { return end_; }
  float leastPassed() const { return passed_; }

  /// What was passed joins the frontier, and the end if it isn't a pair of leaves.
  void spread(Frontier& frontier) {
    for (size_t i = 0; i < steps_; ++i) expander_.spread<true>(path_[i], frontier, taken_[i]);
    if (at_leaves_ || lost()) return;
    frontier.reserve();
    frontier.inner.push(end_.bound, end_.pair);
  }

 private:
  static constexpr size_t kMaxSteps = 32;  ///< more than most trees are deep

  /// False if no child is near enough.
  bool step() {
    Expansion& e = path_[steps_];
    e.bound = end_.bound;
    expander_.start(end_.pair, e);
    expander_.test(e);
    // Where few are flat it costs less to wait for the bound that excludes most.
    const Tightener& tightener = expander_.tightener();
    if (2 * hwy::PopCount(tightener.flatOf(e)) >= hwy::PopCount(e.near)) tightener.tighten(e);
    taken_[steps_++] = 0;
    if (e.near == 0) return false;
    uint32_t nearest = firstOf(e.near);
    float second = kInfinityFloat;
    for (uint32_t left = e.near & (e.near - 1); left != 0; left &= left - 1) {
      const uint32_t lane = firstOf(left);
      const bool nearer = e.bounds[lane] < e.bounds[nearest];
      second = std::min(second, e.bounds[nearer ? nearest : lane]);
      nearest = nearer ? lane : nearest;
    }
    passed_ = std::min(passed_, std::max(second, e.bound));
    taken_[steps_ - 1] = 1U << nearest;
    end_ = {std::max(end_.bound, e.bounds[nearest]), Sides::childPair(e, nearest)};
    return true;
  }

  const Expander& expander_;
  Expansion path_[kMaxSteps];
  uint32_t taken_[kMaxSteps];
  size_t steps_ = 0;
  NodePairList::Entry end_ = {-kInfinityFloat, {0, 0}};
  float passed_ = kInfinityFloat;
  bool at_leaves_ = false;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
