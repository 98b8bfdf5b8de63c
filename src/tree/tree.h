// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "build/mesh_view.h"
#include "tree/content_hash.h"

// The prepared tree: what the SIMD kernels stream. All floats are relative to the tree's origin, in
// the model's units, or in units of a power of two for sizes that floats can't hold. It holds no
// coordinates for exact evaluation, only the ids of features.

namespace kios::engine {

constexpr int kLanes = 8;
constexpr int kSphereRows = 5;
constexpr int kMaxLeafFeatures = 3 * kLeafTriangles;  ///< of edges, and of vertices

struct alignas(32) Lanes {
  float v[kLanes];
};

/// Five spheres as rows: S0, then for each of two axes the middle of its pair of caps and the half
/// difference from the minus to the plus cap, centres and radii alike. A cap is middle +- half.
enum SphereRow { kCentral = 0, kMiddle2 = 1, kHalf2 = 2, kMiddle1 = 3, kHalf1 = 4 };

/// A node for the side of a test that is transformed. Vectors of eight lanes are loaded from each
/// row of coordinates: what lies beyond its five is moved along, and not used.
struct alignas(32) Node {
  float x[kSphereRows] = {}, y[kSphereRows] = {}, z[kSphereRows] = {}, r[kSphereRows] = {};
  float size = 0;  ///< radius of S0
  /// Leaf: ~leaf index. Inner: block index.
  std::int32_t child = 0;
  std::uint32_t first_child : 31;  ///< of the block: a node index
  std::uint32_t flat : 1;          ///< a box bounds it better than spheres

  float width = 0;  ///< of a leaf: see measureLeaves()

  constexpr Node() : first_child(0), flat(0) {}

  bool isLeaf() const { return child < 0; }
  std::size_t leaf() const { return ~static_cast<std::size_t>(child); }
};
static_assert(sizeof(Node) == 96);

/// Columns of a box: three axes, orthonormal but for the rounding of each, and the centre.
enum BoxColumn { kAxes = 0, kCenter = 3, kBoxColumns = 4 };

/// A box around a node's content, for the side of a test that is transformed: every point has
/// |axis . (p - centre)| <= half.
struct alignas(64) Box {
  float x[kBoxColumns], y[kBoxColumns], z[kBoxColumns];
  float half[4];  ///< the fourth is 0
};
static_assert(sizeof(Box) == 64);

/// The children of a node for the side that is tested untransformed, one a lane. Lanes beyond
/// `Children::count` repeat the first child and are masked.
struct alignas(64) Block {
  Lanes x[kSphereRows], y[kSphereRows], z[kSphereRows], r[kSphereRows];
};
static_assert(sizeof(Block) == 640);

/// The boxes of a block's children, one a lane as in Block.
struct alignas(32) BoxBlock {
  Lanes x[kBoxColumns], y[kBoxColumns], z[kBoxColumns];
  Lanes half[3];
};
static_assert(sizeof(BoxBlock) == 480);

/// A feature of the model: triangle index and corner. Edge k runs from corner k to the next.
struct FeatureId {
  std::uint32_t packed;
  std::uint32_t triangle() const { return packed >> 2; }
  std::uint32_t corner() const { return packed & 3U; }
};

/// Rows of a chunk of faces: unit normal and offset, then three inward unit edge planes; 16 rows.
/// A face too thin for a normal has height 0 everywhere and lies inside everywhere: it is always a
/// candidate. One that is a point has any normal, and lies in a prism of no width.
enum FaceRow { kFacePlane = 0, kEdgePlanes = 4, kFaceRows = 16 };

/// Returns the chunks that vertices of a leaf take: two or three.
constexpr int vertexChunks(int num_vertices) { return num_vertices <= 2 * kLanes ? 2 : 3; }
/// Returns the rows of `lanes` that a leaf with so many vertices takes.
constexpr int leafRows(int num_vertices) { return 3 * vertexChunks(num_vertices) + kFaceRows; }

/// Up to eight triangles, and the edges and vertices that the leaf owns: every edge and every
/// vertex of the mesh belongs to one leaf only. In `lanes` from `offset`: vertices (chunks of x, y,
/// z; owned ones first), faces (a chunk of FaceRow). Lanes that aren't used repeat the last
/// feature. In `features` from `feature_offset`: faces, edges, owned vertices.
struct Leaf {
  std::uint32_t offset = 0, feature_offset = 0;
  std::uint8_t num_faces = 0, num_edges = 0, num_owned = 0, num_vertices = 0;
  float centroid[3] = {};
  float normal[3] = {};                     ///< mean direction of the faces, or any: of length 1
  float normal_bottom = 0, normal_top = 0;  ///< where the vertices lie along it
  std::uint8_t corners[kMaxLeafFeatures] = {};  ///< vertices of each face
  std::uint16_t ends[kMaxLeafFeatures] = {};    ///< vertices of each edge: start, and end << 8

  int vertexChunks() const { return engine::vertexChunks(num_vertices); }
};

/// The number of a block's children, and as bits the children that are flat and that are leaves.
struct Children {
  std::uint8_t count = 0, flat = 0, leaves = 0;
  std::uint32_t all() const { return (1U << count) - 1; }
};

/// The vertices of a triangle; of equal ones the first.
using Corners3 = std::array<std::uint32_t, 3>;

struct Tree {
  Box root_box;           ///< of the root, flat or not
  double origin[3] = {};  ///< in the model's units
  int exponent = 0;       ///< of the unit, a power of two; 0 for ordinary sizes
  float reach = 0;        ///< >= |centre| + |radius| of all spheres
  float mean_leaf = 0;    ///< mean size of the leaves' nodes
  float widest_leaf = 0;  ///< their largest width
  int depth = 0;          ///< of blocks
  std::vector<Node> nodes;
  std::vector<Box> boxes;  ///< by node; none if no node is flat
  std::vector<Block> blocks;
  std::vector<BoxBlock> box_blocks;  ///< by block; none if no node is flat
  std::vector<Children> children;    ///< by block
  std::vector<Leaf> leaves;
  std::vector<Lanes> lanes;
  std::vector<FeatureId> features;
  /// The triangles as prepared, for refits. `corners`, by triangle, welded; none if no two vertices
  /// in use were equal, and the mesh's indices are its topology.
  std::vector<Corners3> corners;
  ContentHash indices;  ///< of the triangles
  double cost = 0;      ///< searchCost() as partitioned

  std::size_t bytes() const {
    return sizeof(*this) + nodes.capacity() * sizeof(Node) + boxes.capacity() * sizeof(Box) +
           blocks.capacity() * sizeof(Block) + box_blocks.capacity() * sizeof(BoxBlock) +
           children.capacity() * sizeof(Children) + leaves.capacity() * sizeof(Leaf) +
           lanes.capacity() * sizeof(Lanes) + features.capacity() * sizeof(FeatureId) +
           corners.capacity() * sizeof(Corners3);
  }
};

}  // namespace kios::engine
