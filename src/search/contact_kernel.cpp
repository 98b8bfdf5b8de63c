// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// All that is included outside of simd/ is included before the first target's pass, so that no
// inline function is compiled for an instruction set that a machine may lack.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "search/double_bound.h"
#include "search/search.h"
#include "tree/compress_table.h"
#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/contact_kernel.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/cache_control.h>      // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

#include "search/simd/pair_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Depth first: all that overlaps is looked at, until an evaluator ends it. Boxes tell so well
/// which way leads deepest that a large batch mostly looks where it need not.
template <class LeafPair>
HWY_INLINE void touching(const Search& search, const LeafPair& leaf_pair) {
  constexpr size_t kBatch = 4;
  Leaves leaves_a(search.a), leaves_b(search.b);
  const Expander expander(search);
  const size_t batch_size = expander.tightener().hasBoxes() ? 2 : kBatch;
  Frontier frontier(/*keeps_apart=*/false);
  expander.pushRoots(frontier);
  for (;;) {
    while (!frontier.leaves.empty()) {
      ++search.counts.leaf_pairs;
      const NodePair at = frontier.leaves.pop().pair;
      if (leaf_pair(search, leaves_a(at.a), leaves_b(at.b))) return;
    }
    NodePairList::Entry batch[kBatch];
    const size_t n = frontier.inner.pop(batch, batch_size);
    if (n == 0) return;
    expander.expand<false>(batch, n, frontier);
  }
}

[[gnu::hot]] void contact(const Search& search) { touching(search, contactOfLeaves); }

[[gnu::hot]] void contacts(const Search& search) { touching(search, contactsOfLeaves); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
