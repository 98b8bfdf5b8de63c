// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: short MODELS AROUND QUERIES
// Knows FCL only. Distances of a few models of 2 AROUND^2 / 2 triangles; prints after 1, 2, 4, ...
// queries how long all of them took, in microseconds of CPU time.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "preload/fcl_meshes.h"

namespace {

double cpuTime() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const int count = std::atoi(argv[1]), around = std::atoi(argv[2]), queries = std::atoi(argv[3]);
  std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> models;
  for (int i = 0; i < count; ++i) {
    models.push_back(build<fcl::OBBRSSd>(torus(around, around / 2 + i)));
  }
  std::mt19937 random(1);
  const double start = cpuTime();
  int next = 1;
  for (int i = 1; i <= queries; ++i) {
    const auto a = random() % models.size(), b = random() % models.size();
    const fcl::CollisionGeometryd *first = models[a].get(), *second = models[b].get();
    fcl::DistanceResultd result;
    fcl::distance(first, fcl::Transform3d::Identity(), second, randomPose(random, 3, 5),
                  fcl::DistanceRequestd(), result);
    if (i != next) continue;
    next *= 2;
    std::printf("%d %.0f\n", i, cpuTime() - start);
  }
  return 0;
}
