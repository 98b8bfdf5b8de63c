// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The constants of prepared trees that were found by trying, each with what it serves and what
// else was tried, with the prototype of 0.1.

namespace kios::engine::tuning {

/// A box thinner than this part of its length is tested where spheres aren't apart. Smooth meshes
/// ask 9 to 13 % slower where all are, 2 to 3 % so, and arms of flat links need half of the leaf
/// pairs.
constexpr float kFlat = 0.05F;
/// If a deformation raises the cost of a search by this factor, the partition is made anew. Not
/// measured.
constexpr double kPoor = 1.5;

}  // namespace kios::engine::tuning
