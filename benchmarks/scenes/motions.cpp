// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "placement.h"
#include "random.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

Transform3d pose(const fcl::Matrix3d& rotation, const Vector3d& translation) {
  Transform3d X = Transform3d::Identity();
  X.linear() = rotation;
  X.translation() = translation;
  return X;
}

Transform3d spin(double about_x, double about_y, double about_z) {
  return turn(about_x, Vector3d::UnitX()) * turn(about_y, Vector3d::UnitY()) *
         turn(about_z, Vector3d::UnitZ());
}

// K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
fcl::Matrix3d randomRotation(Random& random) {
  const double u = random.unit();
  const double first = random.uniform(0, 2 * kPi);
  const double second = random.uniform(0, 2 * kPi);
  const double low = std::sqrt(1 - u);
  const double high = std::sqrt(u);
  return fcl::Quaterniond(high * std::cos(second), low * std::sin(first), low * std::cos(first),
                          high * std::sin(second))
      .normalized()
      .toRotationMatrix();
}

// Conservative advancement along -line: a step of (distance - gap) never passes the gap. Nothing if
// B would go past A instead of reaching the gap.
std::optional<Frame> advanceToGap(const Frame& start, const Vector3d& line, double gap,
                                  double apart, const DistanceFunction& distance) {
  constexpr double kTolerance = 1e-6;
  constexpr double kPush = 1e-5;
  constexpr int kMaxSteps = 200;
  const double resolution = gap > 0 ? kTolerance * gap : kPush * apart;
  Frame frame = start;
  double travelled = 0;
  for (int step = 0; step < kMaxSteps && travelled < 2 * apart; ++step) {
    const double d = distance(frame);
    if (gap > 0 ? d - gap <= resolution : d == 0) return frame;
    const double advance = gap > 0 ? d - gap : std::max(d, resolution);
    travelled += advance;
    frame.X_WB.translation() -= advance * line;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Frame> fallingMotion(int frames) {
  std::vector<Frame> motion;
  motion.reserve(frames);
  for (int i = 0; i < frames; ++i) {
    const double t = (i + 0.5) / frames;
    const Transform3d position = shift(0.13 * std::sin(2 * kPi * 2.1 * t),
                                       0.13 * std::cos(2 * kPi * 1.3 * t), 0.8 - 1.6 * t);
    motion.push_back({position * spin(2 * kPi * 1.7 * t, 2 * kPi * 1.1 * t, 2 * kPi * 2.3 * t),
                      Transform3d::Identity()});
  }
  return motion;
}

std::vector<Frame> spinningMotion(int frames) {
  std::vector<Frame> motion;
  motion.reserve(frames);
  for (int i = 1; i <= frames; ++i) {
    const double a = 0.1 * i, b = 0.2 * i, c = 0.3 * i;
    motion.push_back({shift(-1, 0, 0) * spin(a, b, c), shift(1, 0, 0) * spin(c, a, b)});
  }
  return motion;
}

std::vector<Transform3d> randomPoses(int count, double half_width, std::uint64_t seed) {
  Random random(seed);
  std::vector<Transform3d> poses;
  poses.reserve(count);
  for (int i = 0; i < count; ++i) {
    const fcl::Matrix3d rotation = randomRotation(random);
    poses.push_back(pose(rotation, random.inCube(-half_width, half_width)));
  }
  return poses;
}

std::vector<Frame> gapMotion(int frames, double gap, double apart, std::uint64_t seed,
                             const DistanceFunction& distance) {
  if (!(gap >= 0) || !(apart > gap)) {
    throw std::invalid_argument("gapMotion needs 0 <= gap < apart");
  }
  constexpr int kMaxMissesPerFrame = 100;
  Random random(seed);
  std::vector<Frame> motion;
  motion.reserve(frames);
  for (int misses = 0; static_cast<int>(motion.size()) < frames;) {
    const Vector3d line = randomRotation(random).col(0);
    const Frame start{pose(randomRotation(random), Vector3d::Zero()),
                      pose(randomRotation(random), apart * line)};
    if (const auto frame = advanceToGap(start, line, gap, apart, distance)) {
      motion.push_back(*frame);
    } else if (++misses > kMaxMissesPerFrame * frames) {
      throw std::runtime_error("gapMotion: the meshes never come within the gap");
    }
  }
  return motion;
}

std::vector<Frame> farMotion(int frames, double nearest, double farthest, std::uint64_t seed) {
  Random random(seed);
  std::vector<Frame> motion;
  motion.reserve(frames);
  for (int i = 0; i < frames; ++i) {
    const Vector3d direction = randomRotation(random).col(0);
    const double distance = random.uniform(nearest, farthest);
    const Transform3d X_WA = pose(randomRotation(random), Vector3d::Zero());
    motion.push_back({X_WA, pose(randomRotation(random), distance * direction)});
  }
  return motion;
}

}  // namespace kios::scenes
