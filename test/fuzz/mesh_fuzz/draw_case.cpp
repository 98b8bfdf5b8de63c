// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/draw_case.h"

#include <algorithm>

#include "fuzz/mesh_fuzz/hard_meshes.h"
#include "fuzz/mesh_fuzz/hard_poses.h"

namespace kios::fuzz {
namespace {

/// splitmix64's last steps: neighbouring indices get unrelated seeds.
std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15U;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9U;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebU;
  return v ^ (v >> 31);
}

const Question* drawQuestion(Random& random) {
  double sum = 0;
  for (const Question& q : questions()) sum += q.weight;
  double at = sum * random.unit();
  for (const Question& q : questions()) {
    at -= q.weight;
    if (at < 0) return &q;
  }
  return &questions().back();
}

/// Returns lengths of metres and millimetres mostly; else any that engine and tree promise to
/// serve.
double drawScale(Random& random) {
  if (chance(random, 0.6)) return 1;
  if (chance(random, 0.5)) return power(random, -4, 4);
  const double scale = power(random, -13, 12);
  return chance(random, 0.5) ? std::exp2(std::round(std::log2(scale))) : scale;
}

}  // namespace

Case drawCase(std::uint64_t seed, std::uint64_t index, const Question* only) {
  Random random(mixed(seed) ^ mixed(~index));
  Case c;
  c.question = drawQuestion(random);
  if (only) c.question = only;
  c.draw = static_cast<std::uint64_t>(random.unit() * 0x1p53);
  c.in_float = chance(random, 0.15) && c.question->may_be_float;
  c.foreign = chance(random, 0.04);

  const double scale = drawScale(random);
  double size = 0;
  for (int i = 0; i < c.question->meshes; ++i) {
    const bool relative = i > 0 && chance(random, 0.5);
    c.meshes.push_back(relative ? relativeOf(c.meshes[below(random, i)], random)
                                : hardMesh(random));
  }
  // Offsets from their own origins are each mesh's, or common.
  const double most = c.in_float ? 3 : 9;
  const double offset = chance(random, 0.7) ? 0 : scale * power(random, -2, most);
  Vector3d origin = offset * scenes::point(random);
  for (Mesh& mesh : c.meshes) {
    place(mesh, scale, origin);
    if (chance(random, 0.3)) origin = offset * scenes::point(random);
    Vector3d low = mesh.vertices[0], high = low;
    for (const Vector3d& p : mesh.vertices) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    size = std::max(size, (high - low).norm());
  }

  const Transform3d world = hardWorld(size, random);
  std::vector<Transform3d> poses = {Transform3d::Identity()};
  for (std::size_t i = 1; i < c.meshes.size(); ++i) {
    poses.push_back(hardPose(c.meshes[0], c.meshes[i], size, random));
  }
  for (Transform3d& X : poses) X = world * X;
  if (chance(random, 0.1)) blurRotations(poses, random);
  c.frames.push_back(poses);
  for (int f = 1; f < c.question->frames; ++f) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (chance(random, 0.6)) poses[i] = moved(poses[i], middleOf(c.meshes[i]), size, random);
    }
    c.frames.push_back(poses);
  }
  return c;
}

}  // namespace kios::fuzz
