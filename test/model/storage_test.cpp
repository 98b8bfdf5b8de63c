// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A loaded model is the one that was saved. Altered bytes: altered_storage_test.cpp.

#include "fcl_kios/storage.h"

#include <gtest/gtest.h>

#include <string>

#include "fcl/mesh_cases.h"
#include "model/bvh_check.h"
#include "model/deform.h"
#include "model/stored_file.h"

namespace kios::testing {
namespace {

using Bytes = std::vector<unsigned char>;

template <typename S = double>
std::shared_ptr<Model<S>> loaded(const Bytes& bytes) {
  return load<S>(bytes.data(), bytes.size());
}

/// Returns what load() says of the bytes; empty if it takes them.
template <typename S = double>
std::string refusal(const Bytes& bytes) {
  try {
    loaded<S>(bytes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

class Storage : public ::testing::Test {
 protected:
  const Mesh mesh_ = scenes::bumpyTorus(300), other_mesh_ = scenes::icosphere(0.5, 1);
  const std::shared_ptr<Modeld> other_ = kiosModel(other_mesh_);
  const std::vector<Frame> frames_ = randomFrames(20, 1.5, 17);
};

TEST_F(Storage, LoadsWhatWasSaved) {
  Bytes bytes;
  std::vector<fcl::BVNode<kIOSd>> nodes;
  std::vector<double> distances;
  const auto ask = [&](const Modeld& model) {
    std::vector<double> found;
    for (const Frame& frame : frames_) {
      const DistanceBracketResultd answer = distanceBracket(model, frame.X_WA, *other_, frame.X_WB);
      found.insert(found.end(), {answer.distance, double(answer.triangle_a), answer.point_a[0]});
    }
    return found;
  };
  {
    const auto model = kiosModel(mesh_);
    model->cost_density = 3;
    model->threshold_free = 0.25;
    bytes = save(*model);
    nodes = nodesOf(*model);
    distances = ask(*model);
    EXPECT_EQ(save(*model), bytes);
  }
  const auto model = loaded(bytes);  // no equal model lives
  EXPECT_TRUE(sameTree(*model, nodes));
  expectValidTree(*model);
  EXPECT_EQ(ask(*model), distances);
  EXPECT_EQ(model->cost_density, 3);
  EXPECT_EQ(model->threshold_free, 0.25);
  EXPECT_EQ(save(*model), bytes);
  // From any address, and the bytes may go.
  Bytes shifted(bytes.size() + 1);
  std::copy(bytes.begin(), bytes.end(), shifted.begin() + 1);
  const auto again = load(&shifted[1], bytes.size());
  shifted.assign(shifted.size(), 0);
  EXPECT_EQ(ask(*again), distances);
}

TEST_F(Storage, StoresTheOrdinaryTreeOfWhateverMesh) {
  const auto model = kiosModel(mesh_);
  const std::vector<Vector3d> moved = swayed(mesh_, 1);
  update(*model, moved, true, true);
  EXPECT_EQ(save(*model), save(*kiosModel({moved, mesh_.triangles})));
  // A mesh of no ordinary size has none.
  std::vector<Vector3d> huge = mesh_.vertices;
  for (Vector3d& p : huge) p *= 0x1p600;
  const auto far = kiosModel({huge, mesh_.triangles});
  const auto far_again = loaded(save(*far));
  EXPECT_TRUE(sameTree(*far_again, nodesOf(*far)));
}

TEST_F(Storage, OfFloats) {
  std::vector<fcl::Vector3f> vertices;
  for (const Vector3d& p : mesh_.vertices) vertices.push_back(p.cast<float>());
  const auto model = makeModel(vertices, mesh_.triangles);
  const Bytes bytes = save(*model);
  EXPECT_EQ(save(*loaded<float>(bytes)), bytes);
  EXPECT_NE(refusal(bytes).find("load<float>()"), std::string::npos);
  EXPECT_NE(refusal<float>(save(*other_)).find("load<double>()"), std::string::npos);
}

// Files of older versions are read for their mesh.
TEST_F(Storage, OfOlderVersions) {
  const auto model = kiosModel(mesh_);
  for (const std::uint32_t version : {1U, 2U}) {
    StoredFile<> file(save(*model));
    file.toVersion(version);
    EXPECT_TRUE(sameTree(*file.load(), *model)) << version;
    file.bytes[file.at.triangles] ^= 1;
    EXPECT_NE(refusal(file.bytes), "") << version;
  }
}

// As storage.h says.
TEST_F(Storage, SizePerTriangle) {
  const Mesh mesh = scenes::bumpyTorus(2000);
  const auto triangles = static_cast<double>(mesh.triangles.size());
  EXPECT_NEAR(static_cast<double>(save(*kiosModel(mesh)).size()) / triangles, 265, 5);
  std::vector<fcl::Vector3f> vertices;
  for (const Vector3d& p : mesh.vertices) vertices.push_back(p.cast<float>());
  const auto of_floats = makeModel(vertices, mesh.triangles);
  EXPECT_NEAR(static_cast<double>(save(*of_floats).size()) / triangles, 220, 10);
}

TEST_F(Storage, RefusesTheUnfinished) {
  Modeld model;
  EXPECT_THROW(save(model), std::invalid_argument);
}

TEST_F(Storage, SaysWhatIsWrong) {
  const Bytes bytes = save(*other_);
  EXPECT_EQ(refusal(bytes), "");
  EXPECT_NE(refusal({}).find("cut off"), std::string::npos);
  Bytes newer = bytes;
  newer[8] = 4;
  EXPECT_NE(refusal(newer).find("newer version"), std::string::npos);
}

}  // namespace
}  // namespace kios::testing
