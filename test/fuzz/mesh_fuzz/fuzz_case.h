// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/triangle_families.h"

// A case of the fuzzer: meshes at poses, and one question about them. All of it derives from a seed
// and an index, and the shrinker may change every part of it.

namespace kios::fuzz {

using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Mesh;
using scenes::Random;

/// The fault of an answer: in words, and as the call that shows it, in C++ with the names of
/// listing.h (A, B: models; X[frame][model]: poses).
struct Failure {
  std::string what, call;
};

struct Case;
using Verdict = std::optional<Failure>;

struct Question {
  const char* name;
  double weight;                   ///< how often it is asked
  int meshes, frames;              ///< how many a case has of them
  int least_meshes, least_frames;  ///< to how few the shrinker may get
  bool may_be_float;
  double seconds;  ///< a case may take of a processor, --slow times
  Verdict (*ask)(const Case&);
};

/// All questions there are.
const std::vector<Question>& questions();

struct Case {
  const Question* question = nullptr;
  std::uint64_t draw = 0;  ///< the seed of the draws of the question itself
  bool in_float = false;   ///< asked of kIOSf
  bool foreign = false;    ///< a user's bv_fitter fits the models' nodes, which motions walk
  std::vector<Mesh> meshes;
  std::vector<std::vector<Transform3d>> frames;  ///< [frame][mesh]: poses in the world

  const Transform3d& pose(std::size_t mesh, std::size_t frame = 0) const {
    return frames[frame][mesh];
  }
};

inline bool chance(Random& random, double p) { return random.unit() < p; }
inline int below(Random& random, int n) { return scenes::integer(random, 0, n - 1); }
/// Returns 10^e, e uniform.
inline double power(Random& random, double low, double high) {
  return std::pow(10, random.uniform(low, high));
}
/// Returns v moved by so many units in the last place.
template <typename S>
S ulps(S v, int count) {
  const S to = std::copysign(std::numeric_limits<S>::infinity(), static_cast<S>(count));
  for (int i = 0; i < std::abs(count); ++i) v = std::nextafter(v, to);
  return v;
}

}  // namespace kios::fuzz
