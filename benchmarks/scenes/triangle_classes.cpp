// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_classes.h"

#include <utility>

#include "triangle_families.h"

namespace kios::scenes {
namespace {

void shuffle(Random& random, Corners& corners) {
  for (int i = 2; i > 0; --i) std::swap(corners[i], corners[integer(random, 0, i)]);
}

std::vector<TriangleClass> allClasses() {
  std::vector<TriangleClass> all;
  for (const auto& family : {separatedTriangles(), touchingTriangles(), coplanarTriangles(),
                             degenerateTriangles(), scaledTriangles()}) {
    all.insert(all.end(), family.begin(), family.end());
  }
  for (TriangleClass& c : all) {
    c.make = [make = std::move(c.make)](Random& random) {
      TrianglePair pair = make(random);
      shuffle(random, pair.a);
      shuffle(random, pair.b);
      if (random.unit() < 0.5) std::swap(pair.a, pair.b);
      return pair;
    };
  }
  return all;
}

}  // namespace

const std::vector<TriangleClass>& triangleClasses() {
  static const std::vector<TriangleClass> all = allClasses();
  return all;
}

std::vector<TrianglePair> trianglePairs(std::size_t class_index, std::size_t count,
                                        std::uint64_t seed) {
  Random random(seed * 1000003 + class_index);
  const TriangleClass& c = triangleClasses().at(class_index);
  std::vector<TrianglePair> pairs;
  pairs.reserve(count);
  while (pairs.size() < count) pairs.push_back(c.make(random));
  return pairs;
}

}  // namespace kios::scenes
