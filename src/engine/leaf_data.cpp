// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/leaf_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kios::engine {
namespace {

using Vec = Eigen::Vector3d;

/// Writes chunks of rows of lanes; values beyond the last repeat it.
class LaneWriter {
 public:
  LaneWriter(Lanes* lanes, int count, int chunks, int rows)
      : lanes_(lanes), count_(count), places_(kLanes * chunks), rows_(rows) {}
  void set(int i, int row, double value) {
    at(i, row) = static_cast<float>(value);
    if (i + 1 != count_) return;
    for (int pad = count_; pad < places_; ++pad) at(pad, row) = static_cast<float>(value);
  }
  void set(int i, int row, const Vec& value) {
    for (int c = 0; c < 3; ++c) set(i, row + c, value[c]);
  }

 private:
  float& at(int i, int row) { return lanes_[i / kLanes * rows_ + row].v[i % kLanes]; }
  Lanes* const lanes_;
  int count_, places_, rows_;
};

/// Unit normal by the longest edge and the height above it, true to 2^-52 * aspect; false if the
/// triangle is too thin for one that is right to a few 2^-30.
bool unitNormal(const Vec (&edges)[3], const double (&squares)[3], Vec& normal) {
  int longest = squares[1] > squares[0] ? 1 : 0;
  if (squares[2] > squares[longest]) longest = 2;
  const double square = squares[longest];
  if (!(square > 0)) return false;
  const Vec& edge = edges[longest];
  Vec height = -edges[(longest + 2) % 3];
  height -= height.dot(edge) / square * edge;
  const double height2 = height.squaredNorm();
  if (!(height2 > 0x1p-40 * square)) return false;
  normal = edge.cross(height) / std::sqrt(square * height2);
  return true;
}

/// Plane and edge planes of a face; of one that is too thin those that hold everywhere.
void writeFace(const FaceCorners& v, int i, LaneWriter& faces, Vec& sum_of_normals) {
  const Vec edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const double squares[3] = {edges[0].squaredNorm(), edges[1].squaredNorm(),
                             edges[2].squaredNorm()};
  Vec normal = Vec::Zero();
  const bool usable = unitNormal(edges, squares, normal);
  sum_of_normals += normal;
  normal = normal.cast<float>().cast<double>();
  faces.set(i, kFacePlane, normal);
  faces.set(i, kFacePlane + 3, -normal.dot(v[0] + v[1] + v[2]) / 3);
  for (int k = 0; k < 3; ++k) {
    Vec inward = Vec::Zero();
    if (usable) {
      inward = (normal.cross(edges[k]) / std::sqrt(squares[k])).cast<float>().cast<double>();
    }
    const int row = kEdgePlanes + 4 * k;
    faces.set(i, row, inward);
    faces.set(i, row + 3, usable ? -inward.dot(v[k]) : 1);
  }
}

}  // namespace

void placeLeaf(const Eigen::Vector3f* vertices, const FaceCorners* faces, Leaf& leaf, Tree& tree) {
  Lanes* const lanes = &tree.lanes[leaf.offset];
  Eigen::Vector3f low = vertices[0], high = low;
  LaneWriter vertex_lanes(lanes, leaf.num_vertices, leaf.vertexChunks(), 3);
  for (int i = 0; i < leaf.num_vertices; ++i) {
    vertex_lanes.set(i, 0, vertices[i].cast<double>());
    low = low.cwiseMin(vertices[i]);
    high = high.cwiseMax(vertices[i]);
  }
  LaneWriter face_lanes(lanes + 3 * leaf.vertexChunks(), leaf.num_faces, 1, kFaceRows);
  Vec sum = Vec::Zero();
  for (int i = 0; i < leaf.num_faces; ++i) writeFace(faces[i], i, face_lanes, sum);
  const Eigen::Vector3f middle = 0.5F * (low + high);
  const Eigen::Vector3f normal = sum.normalized().cast<float>();  // 0 stays 0
  std::copy_n(middle.data(), 3, leaf.centroid);
  std::copy_n(normal.data(), 3, leaf.normal);
  leaf.normal_bottom = leaf.normal_top = normal.dot(vertices[0]);
  for (int i = 1; i < leaf.num_vertices; ++i) {
    const float height = normal.dot(vertices[i]);
    leaf.normal_bottom = std::min(leaf.normal_bottom, height);
    leaf.normal_top = std::max(leaf.normal_top, height);
  }
}

void appendLeaf(const LeafContent& content, Tree& tree) {
  Leaf leaf;
  leaf.offset = static_cast<std::uint32_t>(tree.lanes.size());
  leaf.feature_offset = static_cast<std::uint32_t>(tree.features.size());
  leaf.num_faces = static_cast<std::uint8_t>(content.triangles.size());
  leaf.num_edges = static_cast<std::uint8_t>(content.edges.size());
  leaf.num_owned = static_cast<std::uint8_t>(content.owned.size());
  leaf.num_vertices = static_cast<std::uint8_t>(content.vertices.size());
  for (int i = 0; i < leaf.num_faces; ++i) {
    std::copy_n(content.triangles[i].vertices, 3, leaf.corners + 3 * i);
  }
  for (int i = 0; i < leaf.num_edges; ++i) {
    leaf.ends[2 * i] = content.edges[i].start;
    leaf.ends[2 * i + 1] = content.edges[i].end;
  }
  tree.lanes.resize(tree.lanes.size() + 3 * leaf.vertexChunks() + kFaceRows);
  placeLeaf(content.vertices.data(), content.faces.data(), leaf, tree);

  for (const LeafTriangle& t : content.triangles) tree.features.push_back(FeatureId{t.id << 2});
  for (const LeafEdge& e : content.edges) tree.features.push_back(e.id);
  for (const FeatureId v : content.owned) tree.features.push_back(v);
  tree.leaves.push_back(leaf);
}

}  // namespace kios::engine
