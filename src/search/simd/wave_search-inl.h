// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Nearly best first, after a descent for an upper bound: pairs that overlap are expanded at once,
/// as they all must be, the others in waves by their bounds. A pair of leaves is bounded by a slab
/// and waits again; the features of one that waited are evaluated.
///
/// With kBracket also a lower bound is proven, and where an error is allowed less work is done: two
/// vertices are an upper bound that prunes, as their triangles are evaluated in the end if nothing
/// nearer was found. The instance for exact answers makes these 8 to 15 % faster.
///
/// A pair that was not evaluated is still in the frontier or in flight, or was left out as not
/// nearer than cull_distance, which only falls. So min(cull_distance, bounds of the waiting pairs)
/// is a lower bound at any time, and the search has proved the largest such value. Bounds of
/// waiting pairs never fall, as pairs inherit their parents': the search takes the value when
/// cull_distance is about to fall.
template <bool kBracket>
class WaveSearch {
 public:
  explicit WaveSearch(const Search& search)
      : search_(search),
        evaluator_(search.evaluator),
        bracket_(*search.bracket),
        expander_(search),
        leaves_a_(search.a),
        leaves_b_(search.b),
        budget_(search.bracket->max_expansions),
        last_(search) {}

  [[gnu::hot]] void run() {
    // Any triangles, so that even the smallest budget has an upper bound.
    bool done = budgeted() && evaluateFaces(LeafView(search_.a, search_.a.leaves[0]), 0,
                                            LeafView(search_.b, search_.b.leaves[0]), 0);
    fall();
    done = done || descend();
    while (!done && !frontier_.empty()) {
      if (budget_ < static_cast<long long>(tuning::kBatch)) {  // whole batches: more never differs
        bracket_.out_of_budget = true;
        break;
      }
      done = advance();
    }
    if (!kBracket) return;
    prove();
    if (has_bound_) evaluateVertices();
  }

 private:
  static constexpr uint32_t kMaxWaiting = 256;

  void prove() {
    const float least = std::min({in_flight_, current_, frontier_.least()});
    bracket_.proven = std::max(bracket_.proven, std::min(cull_distance_, least));
  }

  /// To be called where cull_distance may have fallen.
  HWY_INLINE void fall() {
    if (!kBracket || !(evaluator_.cull_distance < cull_distance_)) return;
    prove();
    cull_distance_ = evaluator_.cull_distance;
  }

  /// True to end the search. Not inlined: its path is large, and not needed for long.
  [[gnu::hot]] HWY_NOINLINE bool descend() {
    Descent descent(expander_, budget_);
    budget_ -= static_cast<long long>(descent.steps());
    in_flight_ = descent.leastPassed();
    current_ = descent.lost() ? kInfinityFloat : descent.end().bound;
    if (descent.atLeaves() && boundLeaves(descent.end())) return true;
    descent.spread(frontier_);
    in_flight_ = current_ = kInfinityFloat;
    return false;
  }

  /// Looks at some of what is at hand, or takes more. True to end the search.
  HWY_INLINE bool advance() {
    if (!frontier_.bounded.empty()) {
      const NodePairList::Entry entry = frontier_.bounded.pop();
      return matters(entry) && ended(evaluateFeatures(waiting_[entry.pair.a], entry.bound));
    }
    if (!frontier_.leaves.empty()) {
      const NodePairList::Entry entry = frontier_.leaves.pop();
      return matters(entry) && ended(boundLeaves(entry));
    }
    if (frontier_.inner.empty()) {
      frontier_.nextWave(evaluator_.cull_distance, tuning::kWave);
      return false;
    }
    NodePairList::Entry batch[tuning::kBatch];
    const size_t n = frontier_.inner.pop(batch);
    for (size_t i = 0; i < n; ++i) in_flight_ = std::min(in_flight_, batch[i].bound);
    budget_ -= static_cast<long long>(n);
    expander_.expand<kBracket>(batch, n, frontier_);
    in_flight_ = kInfinityFloat;
    return false;
  }

  bool matters(const NodePairList::Entry& entry) {
    current_ = entry.bound;
    return entry.bound < evaluator_.cull_distance || ended(false);
  }
  bool ended(bool done) {
    if (!done) current_ = kInfinityFloat;
    return done;
  }

  /// True to end the search.
  HWY_INLINE bool boundLeaves(const NodePairList::Entry& entry) {
    ++search_.counts.leaf_pairs;
    Bracketed& pair = waiting_[num_waiting_];
    pair.nodes = entry.pair;
    bracketLeaves(search_, leaves_a_(pair.nodes.a), leaves_b_(pair.nodes.b), last_, pair);
    const bool nearer = !pair.slab.apart && pair.upper < evaluator_.candidate_limit;
    if (nearer) evaluator_.addUpperBound(pair.upper);
    const float bound = std::max(entry.bound, pair.lower);
    if (pair.slab.apart || (bound >= evaluator_.cull_distance && !(kBracket && nearer))) {
      if (search_.audit)
        search_.audit->pruned(entry.pair.a, entry.pair.b, evaluator_.cull_distance);
      return false;
    }
    bool at_once = bound <= 0 || num_waiting_ + 1 == kMaxWaiting;
    if (kBracket && nearer) {
      best_ = pair.vertices;
      has_bound_ = true;
      // With a budget all upper bounds are made true at once: answers must not get worse as it
      // grows.
      const bool ends = evaluator_.candidate_limit <= bracket_.near_enough;
      if ((ends || budgeted()) && evaluateVertices()) return true;
      at_once = true;  // it may be nearer than its own upper bound: better ones come early
    }
    const bool open = bound < evaluator_.cull_distance;
    // Overlapping pairs are searched at once, and so is a pair that finds no room to wait.
    if (open && at_once) return evaluateFeatures(pair, bound);
    current_ = bound;
    fall();
    if (open) frontier_.keep(bound, num_waiting_++);
    return false;
  }

  bool budgeted() const { return kBracket && bracket_.hasBudget(); }

  /// True to end the search.
  [[gnu::hot]] HWY_NOINLINE bool evaluateFeatures(const Bracketed& pair, float bound) {
    const float known = evaluator_.candidate_limit;
    const bool done = nearestOfLeaves(search_, leaves_a_(pair.nodes.a), leaves_b_(pair.nodes.b),
                                      pair.slab, bound);
    if (evaluator_.candidate_limit < known) has_bound_ = false;
    // Features of them that were not evaluated are not nearer than either.
    if (!done) current_ = std::max(bound, evaluator_.cull_distance);
    fall();
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
    return evaluator_.evaluate({PairKind::kFaces, a.face(face_a), b.face(face_b)});
  }

  static uint32_t faceAt(const Leaf& leaf, uint32_t vertex) {
    uint32_t corner = 3U * leaf.num_faces - 1;
    while (corner > 0 && leaf.corners[corner] != vertex) --corner;
    return corner / 3;
  }

  const Search& search_;
  RefineCallback& evaluator_;
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
