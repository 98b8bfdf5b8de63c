// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/mesh_split.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace kios::paper {

MeshSplit::MeshSplit(const scenes::Mesh& mesh) : mesh_(mesh) {
  const auto model = scenes::buildModel<fcl::OBBRSSd>(mesh);
  nodes_.resize(model->getNumBVs());
  add(*model, 0);
}

void MeshSplit::add(const fcl::BVHModel<fcl::OBBRSSd>& model, int index) {
  const auto& from = model.getBV(index);
  Node& node = nodes_[index];
  node.first = triangleCount();
  if (from.isLeaf()) {
    order_.push_back(from.primitiveId());
  } else {
    node.left = from.leftChild();
    add(model, from.leftChild());
    add(model, from.rightChild());
  }
  node.count = triangleCount() - node.first;
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& p : points(node)) box.extend(p);
  node.extent = box.sizes().maxCoeff();
}

TriangleVertices<double> MeshSplit::corners(int triangle_id) const {
  const fcl::Triangle& t = mesh_.triangles[triangle_id];
  return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
}

std::vector<fcl::Vector3d> MeshSplit::points(const Node& node) const {
  std::vector<std::size_t> ids;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const fcl::Triangle& t = mesh_.triangles[order_[i]];
    ids.insert(ids.end(), {t[0], t[1], t[2]});
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<fcl::Vector3d> result;
  for (const std::size_t id : ids) result.push_back(mesh_.vertices[id]);
  return result;
}

}  // namespace kios::paper
