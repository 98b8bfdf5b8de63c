// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangle kernels, which judge everything else, against exact integers: what their headers
// promise, and in any order of the arguments.

#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "triangle/contract.h"

namespace kios::fuzz {
namespace {

template <typename S>
Verdict kernels(const Case& c) {
  Random random(c.draw);
  const BruteForce<S> truth(c.meshes[0], c.pose(0).cast<S>(), c.meshes[1], c.pose(1).cast<S>());
  const int a = static_cast<int>(truth.a.size()), b = static_cast<int>(truth.b.size());
  const auto anyOrder = [&] { return testing::kVertexOrders[below(random, 6)]; };
  for (int i = 0; i < std::min(a * b, 6); ++i) {
    const std::pair<int, int> ids =
        i == 0 ? truth.nearest : std::pair<int, int>{below(random, a), below(random, b)};
    const TriangleVerticesd &p = truth.a[static_cast<std::size_t>(ids.first)],
                            &q = truth.b[static_cast<std::size_t>(ids.second)];
    const testing::RoundedPair<S> pair(
        scenes::TrianglePair{{p[0], p[1], p[2]}, {q[0], q[1], q[2]}});
    std::string broken = testing::contractOf(pair).broken;
    if (broken.empty() && !testing::sameForOrder(pair, anyOrder(), anyOrder())) {
      broken = "the order of arguments matters";
    }
    if (!broken.empty()) {
      return failure(Words() << broken,
                     "the kernels of " + text(ids) + ", " + testing::text(pair.exact));
    }
  }
  return std::nullopt;
}

}  // namespace

Verdict askKernel(const Case& c) { return c.in_float ? kernels<float>(c) : kernels<double>(c); }

}  // namespace kios::fuzz
