// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <fcl/common/types.h>

namespace kios::scenes {

/// Holds poses of two meshes in the world frame W: x_W = X_WA x_A.
struct Frame {
  fcl::Transform3d X_WA;
  fcl::Transform3d X_WB;
};

/// A = bentTorus() falls along -z through the hole of B = knobbyTorus(), which rests at the origin,
/// tumbling and wandering so that a sixth of the frames touch or interpenetrate. Smooth: successive
/// frames differ little when there are many.
std::vector<Frame> fallingMotion(int frames);

/// Returns the spinning benchmark of the k-IOS paper: A at (-1, 0, 0) and B at (1, 0, 0) turn in
/// place. For frame i = 1, 2, ... and the angles (a, b, c) = (0.1 i, 0.2 i, 0.3 i) in radians, R_WA
/// = Rx(a) Ry(b) Rz(c) and R_WB = Rx(c) Ry(a) Rz(b).
std::vector<Frame> spinningMotion(int frames);

/// Returns a uniformly distributed rotation (Shoemake's quaternion) and a translation uniform in
/// the cube [-half_width, half_width]^3, from the seed.
std::vector<fcl::Transform3d> randomPoses(int count, double half_width, std::uint64_t seed);

/// Computes the exact distance of the two meshes at given poses, 0 in contact.
using DistanceFunction = std::function<double(const Frame&)>;

/// Independent random orientations (no coherence between frames); A at the origin, B moved towards
/// A along a random line until the distance is `gap` within 1e-6 of it. B starts `apart` away,
/// which must clear both meshes. A line that misses is redrawn. gap = 0: B is pushed in by steps of
/// 1e-5 `apart` until the distance is 0, a shallow contact.
std::vector<Frame> gapMotion(int frames, double gap, double apart, std::uint64_t seed,
                             const DistanceFunction& distance);

/// Returns independent random orientations; A at the origin, B in a random direction at a distance
/// uniform in [nearest, farthest].
std::vector<Frame> farMotion(int frames, double nearest, double farthest, std::uint64_t seed);

}  // namespace kios::scenes
