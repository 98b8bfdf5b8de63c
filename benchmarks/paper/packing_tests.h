// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "search/float_frame.h"
#include "tree/tree.h"

namespace kios::paper {

/// Holds the spheres of a k-IOS in floats, S0 first. Rows go on with the first again, so that four
/// from any of the k are spheres.
struct SphereSet {
  int k = 0;
  float x[8] = {}, y[8] = {}, z[8] = {}, r[8] = {};

  /// Fills the rows beyond k.
  void repeat();
};

/// Holds a node of B against eight nodes of A, several times over, as each test streams them.
struct PackingPairs {
  std::vector<engine::FloatPose> X_AB;
  std::vector<SphereSet> b;
  std::vector<std::array<SphereSet, 8>> a;
  std::vector<engine::Node> node_b;
  std::vector<engine::Block> block_a;

  std::size_t groups() const { return b.size(); }
};

/// Sphere-sphere tests, of four or eight pairs or of one.
struct PackingCounts {
  long long packed = 0;
  long long scalar = 0;
};

/// Lower bounds of the distances of all pairs, eight a group. With `overlap` a test ends at the
/// first spheres that are apart, and its bound is that of any.
using PackingTest = void (*)(const PackingPairs& pairs, bool overlap, float* bounds,
                             PackingCounts& counts);

/// The paper's Algorithms 1 and 2: one sphere pair after the other.
void testScalar(const PackingPairs& pairs, bool overlap, float* bounds, PackingCounts& counts);

/// The paper's SIMD form (IV-B): four sphere pairs of the k_A k_B at a time; of those left over,
/// more than one are packed as well, one is tested alone.
void testPackedByFour(const PackingPairs& pairs, bool overlap, float* bounds,
                      PackingCounts& counts);

/// Holds the engine's test: eight volumes at a time, nine of the 25 sphere pairs of each.
struct EightNodesTest {
  std::string target;
  PackingTest test;
};

/// For every instruction set of this machine, the best first.
std::vector<EightNodesTest> eightNodesTests();

}  // namespace kios::paper
