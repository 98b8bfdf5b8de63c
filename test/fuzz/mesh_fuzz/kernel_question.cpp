// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangle kernels, which judge everything else, against exact integers.

#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "scenes/rational_oracle.h"

namespace kios::fuzz {
namespace {

template <typename S>
Verdict kernels(const Case& c) {
  Random random(c.draw);
  const BruteForce<S> truth(c.meshes[0], c.pose(0).cast<S>(), c.meshes[1], c.pose(1).cast<S>());
  const int a = static_cast<int>(truth.a.size()), b = static_cast<int>(truth.b.size());
  for (int i = 0; i < std::min(a * b, 6); ++i) {
    const std::pair<int, int> ids =
        i == 0 ? truth.nearest : std::pair<int, int>{below(random, a), below(random, b)};
    const auto held = [](const TriangleVerticesd& t) {
      return TriangleVertices<S>{t[0].template cast<S>(), t[1].template cast<S>(),
                                 t[2].template cast<S>()};
    };
    const auto p = held(truth.a[static_cast<std::size_t>(ids.first)]);
    const auto q = held(truth.b[static_cast<std::size_t>(ids.second)]);
    scenes::TrianglePair exact;
    for (int k = 0; k < 3; ++k) {
      exact.a[k] = p[k].template cast<double>();
      exact.b[k] = q[k].template cast<double>();
    }
    const auto expected = scenes::rationalDistance(exact);
    const auto found = triangleDistance(p, q), swapped = triangleDistance(q, p);
    const std::string call = "triangleDistance and trianglesIntersect of triangles " + text(ids);
    const double error =
        static_cast<double>(std::abs(static_cast<long double>(found.distance) - expected.distance));
    const double bound = 16 * truth.kEps * truth.extentOf(ids) + truth.kLeast;
    if (!(error <= bound) || (found.distance == 0) != expected.intersect) {
      return failure(Words() << found.distance << ", exactly "
                             << static_cast<double>(expected.distance) << ", allowed " << bound,
                     call);
    }
    if (trianglesIntersect(p, q) != expected.intersect) {
      return failure(Words() << "intersect: " << !expected.intersect, call);
    }
    if (found.distance != swapped.distance) {
      return failure(Words() << found.distance << ", swapped " << swapped.distance, call);
    }
    const double apart = (found.point_a - found.point_b).template cast<double>().stableNorm();
    double most = 0;
    for (int k = 0; k < 3; ++k) {
      most = std::max({most, exact.a[k].norm(), exact.b[k].norm()});
    }
    if (!(std::abs(apart - double{found.distance}) <= bound + 8 * truth.kEps * most)) {
      return failure(Words() << "points are " << apart << " apart, not " << found.distance, call);
    }
  }
  return std::nullopt;
}

}  // namespace

Verdict askKernel(const Case& c) { return c.in_float ? kernels<float>(c) : kernels<double>(c); }

}  // namespace kios::fuzz
