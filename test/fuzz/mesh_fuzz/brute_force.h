// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "all_pairs.h"
#include "fuzz/mesh_fuzz/fuzz_case.h"

// The judge of the searches: the triangle kernels over all pairs of triangles, in the common frame.
// The kernels themselves are judged by the question "kernel".

namespace kios::fuzz {

/// Holds all pairs of triangles of two meshes, in the frame of the first.
template <typename S>
class BruteForce : public testing::AllPairs<S> {
 public:
  BruteForce(const Mesh& a, const fcl::Transform3<S>& X_WA, const Mesh& b,
             const fcl::Transform3<S>& X_WB)
      : testing::AllPairs<S>(trianglesOf(a), trianglesOf(b), RelativePose<S>(X_WA, X_WB)) {}

  static testing::Triangles<S> trianglesOf(const Mesh& mesh) {
    return testing::trianglesOf<S>(testing::MeshIn<S>(mesh));
  }
};

}  // namespace kios::fuzz
