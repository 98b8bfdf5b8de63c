// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances are bitwise the same for every instruction set, compiler and build type: their hashes
// are written down here. A change of one is a change of answers, and needs a reason in the
// changelog. The mathematical library has no part in the scenes: see rounded() and wholePose().

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "fcl_kios/fcl_kios.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

class Hash {  // FNV-1a, by words
 public:
  void add(double v) {
    std::uint64_t bits;
    std::memcpy(&bits, &v, sizeof(bits));
    value_ = (value_ ^ bits) * 0x100000001b3U;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

// Distances with their triangles, and whether there is contact, both orders, over `frames` poses.
// Returns how many
// were in contact.
template <typename S>
int addAnswers(const Mesh& mesh1, const Mesh& mesh2, int frames, Hash& hash) {
  const auto model1 = scenes::buildModel<kIOS<S>>(mesh1);
  const auto model2 = scenes::buildModel<kIOS<S>>(mesh2);
  Random random(11);
  int contacts = 0;
  for (int i = 0; i < frames; ++i) {
    const fcl::Transform3<S> X1 = wholePose(random, 1.5).template cast<S>();
    const fcl::Transform3<S> X2 = wholePose(random, 1.5).template cast<S>();
    for (const bool swap : {false, true}) {
      fcl::DistanceResult<S> nearest;
      const fcl::DistanceRequest<S> request(true);
      fcl::CollisionResult<S> contact;
      if (swap) {
        fcl::distance(model2.get(), X2, model1.get(), X1, request, nearest);
        fcl::collide(model2.get(), X2, model1.get(), X1, fcl::CollisionRequest<S>(), contact);
      } else {
        fcl::distance(model1.get(), X1, model2.get(), X2, request, nearest);
        fcl::collide(model1.get(), X1, model2.get(), X2, fcl::CollisionRequest<S>(), contact);
      }
      hash.add(nearest.min_distance);
      if (nearest.min_distance > 0) {
        hash.add(static_cast<double>(nearest.b1));
        hash.add(static_cast<double>(nearest.b2));
      }
      EXPECT_EQ(contact.isCollision(), nearest.min_distance == 0);
      contacts += contact.isCollision();
    }
  }
  return contacts;
}

struct Pinned {
  const char* name;
  Mesh mesh;
  std::uint64_t hash;
};

TEST(Pinned, DistancesHashAsWrittenDown) {
  constexpr double kGrid = 0x1p-20;
  const Mesh torus = rounded(scenes::bumpyTorus(900), kGrid);
  const Pinned scenes[] = {
      {"torus", torus, 0x971f46a1f12bdc5a},
      {"torus as a soup", scenes::soup(torus), 0x971f46a1f12bdc5a},
      {"blob", rounded(scenes::bumpyBlob(), kGrid), 0x9b2c5821cd5d3b83},
      {"strips", rounded(scenes::stripCylinder(60, 0.6, 0.004), kGrid), 0x6237b5df828df183},
      {"lattice, many ties", lattice(12, 0.125), 0xff2459fb620ef030},
      {"points, segments, triangles", rounded(degenerateMesh(90, 3, 8), kGrid), 0xdcc0ca3fce45b678},
      {"far from its origin", transformed(torus, 1, {1024, -2048, 512}), 0x56c244d5ba7a0188},
  };
  for (const Pinned& scene : scenes) {
    SCOPED_TRACE(scene.name);
    Hash hash;
    const int contacts = addAnswers<double>(scene.mesh, torus, 60, hash) +
                         addAnswers<float>(scene.mesh, torus, 60, hash);
    std::printf("%-28s 0x%016llx, %d of 240 in contact\n", scene.name,
                static_cast<unsigned long long>(hash.value()), contacts);
    EXPECT_EQ(hash.value(), scene.hash);
  }
}

}  // namespace
}  // namespace kios::testing
