// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances are bitwise the same for every instruction set, compiler and build type: their hashes
// are written down here. A change of one is a change of answers, and needs a reason in the
// changelog. The scenes are made without the mathematical library, whose last bits vary, or rounded
// far more coarsely than it errs.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "engine/shapes.h"
#include "fcl_kios/fcl_kios.h"

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

// Vertices on a grid of 2^-20, which floats hold too.
Mesh rounded(Mesh mesh) {
  for (fcl::Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) p[i] = std::nearbyint(p[i] * 0x1p20) * 0x1p-20;
  }
  return mesh;
}

// A quaternion of small whole numbers gives a rotation by sums, products and one quotient.
fcl::Transform3d wholePose(Random& random, double half_width) {
  std::array<double, 4> q;
  double squared;
  do {
    squared = 0;
    for (double& c : q) {
      c = std::floor(random.uniform(-20, 21));
      squared += c * c;
    }
  } while (squared == 0);
  const auto [w, x, y, z] = q;
  const double rows[3][3] = {
      {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  fcl::Transform3d X = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X(i, j) = rows[i][j] / squared;
    X(i, 3) = std::floor(random.uniform(-half_width, half_width) * 0x1p20) * 0x1p-20;
  }
  return X;
}

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
  const Mesh torus = rounded(scenes::bumpyTorus(900));
  const Pinned scenes[] = {
      {"torus", torus, 0x7fd13bd761b4ce11},
      {"torus as a soup", scenes::soup(torus), 0x7fd13bd761b4ce11},
      {"blob", rounded(scenes::bumpyBlob()), 0x3ab0f604185c23bc},
      {"strips", rounded(scenes::stripCylinder(60, 0.6, 0.004)), 0xe6946f87da7c4b2b},
      {"lattice, many ties", lattice(12, 0.125), 0xabc5e2ccbb16f9b0},
      {"points, segments, triangles", rounded(degenerateMesh(90, 3, 8)), 0x7c8d377a4fd31757},
      {"far from its origin", transformed(torus, 1, {1024, -2048, 512}), 0x381630ad1ab6e58a},
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
