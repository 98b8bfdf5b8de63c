// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: preload_client ROW TRIANGLES REPEATS
// A program that knows FCL alone, for `kios_bench preload` to run with and without the preloaded
// library. Prints the least time of a query over the repeats, in nanoseconds (the mean over all
// poses), and what the answers add up to.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "preload/fcl_meshes.h"

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> modelOf(int triangles) {
  const int around = std::max(6, static_cast<int>(std::sqrt(triangles / 0.8)));
  return build<fcl::OBBRSSd>(torus(around, std::max(3, triangles / (2 * around))));
}

/// Returns what the torus meets: another, unless the row names one of FCL's shapes or an octree.
std::shared_ptr<fcl::CollisionGeometryd> partner(const std::string& row, int triangles) {
  const auto names = [&](const char* word) { return row.find(word) != std::string::npos; };
  if (names("box")) return std::make_shared<fcl::Boxd>(0.6, 0.5, 0.8);
  if (names("sphere")) return std::make_shared<fcl::Sphered>(0.4);
  if (!names("octree")) return modelOf(triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-0.7F, 0.7F);
  const auto cells = std::make_shared<octomap::OcTree>(0.05);
  for (int i = 0; i < 400; ++i) {
    cells->updateNode(octomap::point3d(place(random), place(random), place(random)), true);
  }
  return std::make_shared<fcl::OcTreed>(cells);
}

using Pairs = std::vector<std::unique_ptr<fcl::CollisionObjectd>>;

/// Moves b along a direction until it is so far from a; for a negative gap until it overlaps by
/// about so much.
void place(const fcl::CollisionObjectd& a, fcl::CollisionObjectd& b, const fcl::Vector3d& direction,
           double gap) {
  double touching = 0, apart = 4;
  for (int i = 0; i < 30; ++i) {
    const double middle = (touching + apart) / 2;
    b.setTranslation(middle * direction);
    fcl::DistanceResultd result;
    const double distance = fcl::distance(&a, &b, fcl::DistanceRequestd(), result);
    // FCL's solvers for shapes see an overlap a little early.
    (distance > std::max(gap, 1e-5) ? apart : touching) = middle;
  }
  if (gap < 0) b.setTranslation((touching + gap) * direction);
}

/// Takes so long for all poses, and adds up the answers.
template <typename Ask>
double time(std::size_t poses, int repeats, const Ask& ask, double& sum) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    sum = 0;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < poses; ++i) sum += ask(i);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count() / static_cast<double>(poses));
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string row = argv[1];
  const int triangles = std::atoi(argv[2]), repeats = std::atoi(argv[3]);
  const bool distances = row.rfind("distance", 0) == 0;
  const double gap = row.find("far") != std::string::npos     ? 1.0
                     : row.find("near") != std::string::npos  ? 0.02
                     : row.find("touch") != std::string::npos ? -1e-4
                     : row.find("deep") != std::string::npos  ? -0.15
                                                              : 4.0;
  const auto model_a = modelOf(triangles);
  const std::shared_ptr<fcl::CollisionGeometryd> other = partner(row, triangles);
  std::mt19937 random(7);
  constexpr int kPoses = 24;
  const fcl::CollisionObjectd a(model_a, fcl::Transform3d::Identity());
  Pairs others;
  for (int i = 0; i < kPoses; ++i) {
    others.push_back(std::make_unique<fcl::CollisionObjectd>(other));
    const fcl::Transform3d pose = randomPose(random, 1, 1);
    others.back()->setRotation(pose.linear());
    const fcl::Vector3d direction = pose.translation();
    if (gap >= 4) {
      others.back()->setTranslation(6 * direction);
    } else {
      place(a, *others.back(), direction, gap);
    }
  }

  const std::size_t contacts = row.find("contacts") != std::string::npos ? 100 : 1;
  const fcl::CollisionRequestd collide_request(contacts, contacts > 1);
  const fcl::DistanceRequestd distance_request(true);
  const auto ask = [&](std::size_t i) {
    if (!distances) {
      fcl::CollisionResultd result;
      return static_cast<double>(fcl::collide(&a, others[i].get(), collide_request, result));
    }
    fcl::DistanceResultd result;
    if (row.find("bounded") != std::string::npos) result.min_distance = gap / 2;
    return fcl::distance(&a, others[i].get(), distance_request, result);
  };
  double sum = 0;
  // Before it is timed, as a planner does.
  const auto begin = std::chrono::steady_clock::now();
  int warm = 0;
  while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(200) &&
         warm < 100000) {
    warm += kPoses;
    time(kPoses, 1, ask, sum);
  }
  const double ns = time(kPoses, repeats, ask, sum);
  std::printf("%.1f %.17g\n", ns, sum);
}
