// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Takes the place of src/search/float_frame.cpp in mesh_fuzz_unpadded: float bounds pay nothing for
// their rounding, which the fuzzer must notice.

#define makeTreePose makePaddedTreePose
#include "search/float_frame.cpp"
#undef makeTreePose

namespace kios::engine {

bool makeTreePose(const Tree& a, const Tree& b, const RelativePose<double>& X_AB, TreePose& out) {
  if (!makePaddedTreePose(a, b, X_AB, out)) return false;
  out.pad = out.box_pad = 0;
  return true;
}

}  // namespace kios::engine
