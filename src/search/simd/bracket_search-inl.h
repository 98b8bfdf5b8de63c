// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// As DistanceSearch, with a proven lower bound, and less work where an error is allowed: it begins
/// with the leaves that a descent ends at, and two vertices are an upper bound that prunes, as
/// their triangles are evaluated in the end if nothing nearer was found.
///
/// A pair that was not evaluated is still in the frontier or in flight, or was left out as not
/// nearer than cull_distance, which only falls. So min(cull_distance, bounds of the waiting pairs)
/// is a lower bound at any time, and the search has proved the largest such value. Bounds of
/// waiting pairs never fall, as pairs inherit their parents': the search takes the value when
/// cull_distance is about to fall.
class BracketSearch {
 public:
  explicit BracketSearch(const Search& search)
      : search_(search),
        bracket_(*search.bracket),
        expander_(search),
        leaves_a_(search.a),
        leaves_b_(search.b),
        budget_(search.bracket->max_expansions),
        last_(search) {}

  void run() {
    // Any triangles, so that even the smallest budget has an upper bound.
    bool done = budgeted() && evaluateFaces(LeafView(search_.a, search_.a.leaves[0]), 0,
                                            LeafView(search_.b, search_.b.leaves[0]), 0);
    lowerTo(search_.evaluator.cull_distance);
    done = done || descend();
    while (!done && !frontier_.empty()) {
      if (budget_ < static_cast<long long>(kBatch)) {  // whole batches: more never differs
        bracket_.out_of_budget = true;
        break;
      }
      done = advance();
    }
    prove();
    if (has_bound_) evaluateVertices();
  }

 private:
  static constexpr size_t kBatch = 4;
  static constexpr float kWave = 0.125F;
  static constexpr uint32_t kMaxWaiting = 256;

  void prove() {
    const float least = std::min({in_flight_, current_, frontier_.least()});
    bracket_.proven = std::max(bracket_.proven, std::min(cull_distance_, least));
  }

  void lowerTo(float cull_distance) {
    if (!(cull_distance < cull_distance_)) return;
    prove();
    cull_distance_ = cull_distance;
  }

  /// True to end the search.
  bool descend() {
    Descent descent(expander_, budget_);
    budget_ -= static_cast<long long>(descent.steps());
    in_flight_ = descent.leastPassed();
    current_ = descent.lost() ? kInfinityFloat : descent.end().bound;
    if (descent.atLeaves() && leaves(descent.end())) return true;
    descent.spread(frontier_);
    in_flight_ = current_ = kInfinityFloat;
    return false;
  }

  /// Looks at some of what is at hand, or takes more. True to end the search.
  bool advance() {
    if (!frontier_.bounded.empty()) {
      const NodePairList::Entry entry = frontier_.bounded.pop();
      return entry.bound < cull_distance_ &&
             current(entry, [&] { return evaluateFeatures(waiting_[entry.pair.a], entry.bound); });
    }
    if (!frontier_.leaves.empty()) {
      const NodePairList::Entry entry = frontier_.leaves.pop();
      return entry.bound < cull_distance_ && current(entry, [&] { return leaves(entry); });
    }
    if (!frontier_.inner.empty()) {
      NodePairList::Entry batch[kBatch];
      const size_t n = frontier_.inner.pop(batch);
      for (size_t i = 0; i < n; ++i) in_flight_ = std::min(in_flight_, batch[i].bound);
      budget_ -= static_cast<long long>(n);
      expander_.expand<true>(batch, n, frontier_);
      in_flight_ = kInfinityFloat;
      return false;
    }
    frontier_.nextWave(cull_distance_, kWave);
    return false;
  }

  template <class Look>
  bool current(const NodePairList::Entry& entry, const Look& look) {
    current_ = entry.bound;
    if (look()) return true;
    current_ = kInfinityFloat;
    return false;
  }

  /// True to end the search.
  bool leaves(const NodePairList::Entry& entry) {
    ++search_.counts.leaf_pairs;
    Bracketed& pair = waiting_[num_waiting_];
    pair.nodes = entry.pair;
    bracketPair(search_, leaves_a_, leaves_b_, last_, pair);
    const bool nearer = !pair.slab.apart && pair.upper < search_.evaluator.candidate_limit;
    if (nearer) {
      search_.evaluator.addUpperBound(pair.upper);
      best_ = pair.vertices;
      has_bound_ = true;
    }
    const float bound = std::max(entry.bound, pair.lower);
    if (pair.slab.apart || (!nearer && bound >= cull_distance_)) {
      if (search_.audit) search_.audit->pruned(entry.pair.a, entry.pair.b, cull_distance_);
      return false;
    }
    // With a budget all upper bounds are made true at once: answers must not get worse as it grows.
    const bool ends = nearer && search_.evaluator.candidate_limit <= bracket_.near_enough;
    if (nearer && (ends || budgeted()) && evaluateVertices()) return true;
    // A pair that may be nearer than its own upper bound is evaluated at once, so that better ones
    // come early, and what overlaps, as it may touch.
    const bool open = bound < search_.evaluator.cull_distance;
    if ((open && (nearer || bound <= 0)) || num_waiting_ + 1 == kMaxWaiting) {
      return evaluateFeatures(pair, bound);
    }
    current_ = bound;
    lowerTo(search_.evaluator.cull_distance);
    if (open) {
      frontier_.keep(bound, num_waiting_);
    }
    ++num_waiting_;
    return false;
  }

  bool budgeted() const { return bracket_.hasBudget(); }

  /// True to end the search.
  bool evaluateFeatures(const Bracketed& pair, float bound) {
    const float known = search_.evaluator.candidate_limit;
    const bool done = nearestOfLeaves(search_, leaves_a_(pair.nodes.a), leaves_b_(pair.nodes.b),
                                      pair.slab, bound);
    if (search_.evaluator.candidate_limit < known) has_bound_ = false;
    // Features of them that were not evaluated are not nearer than either.
    if (!done) current_ = std::max(bound, search_.evaluator.cull_distance);
    lowerTo(search_.evaluator.cull_distance);
    return done;
  }

  /// Evaluates triangles of the vertices that are the upper bound: the edges and faces there
  /// may belong to other leaves, and be left out. True to end the search.
  bool evaluateVertices() {
    has_bound_ = false;
    const LeafView a = leaves_a_(best_.nodes.a), b = leaves_b_(best_.nodes.b);
    return evaluateFaces(a, faceAt(a.leaf, best_.a), b, faceAt(b.leaf, best_.b));
  }

  bool evaluateFaces(const LeafView& a, uint32_t face_a, const LeafView& b, uint32_t face_b) {
    ++search_.counts.exact;
    return search_.evaluator.evaluate({PairKind::kFaces, a.face(face_a), b.face(face_b)});
  }

  static uint32_t faceAt(const Leaf& leaf, uint32_t vertex) {
    uint32_t corner = 3U * leaf.num_faces - 1;
    while (corner > 0 && leaf.corners[corner] != vertex) --corner;
    return corner / 3;
  }

  const Search& search_;
  Bracket& bracket_;
  const Expander expander_;
  Leaves leaves_a_, leaves_b_;
  Frontier frontier_;
  long long budget_;
  float cull_distance_ = kInfinityFloat;
  float in_flight_ = kInfinityFloat;  ///< least bound of what is being expanded
  float current_ = -kInfinityFloat;   ///< bound of what is at hand
  LastLeaves last_;
  VertexPair best_;
  bool has_bound_ = false;  ///< whether they are the upper bound
  uint32_t num_waiting_ = 0;
  Bracketed waiting_[kMaxWaiting];
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
