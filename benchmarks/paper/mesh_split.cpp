// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/mesh_split.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "paper/sphere_centers.h"

namespace kios::paper {
namespace {

double longestSide(const std::vector<fcl::Vector3d>& points) {
  fcl::Vector3d lower = points[0], upper = points[0];
  for (const fcl::Vector3d& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return (upper - lower).maxCoeff();
}

}  // namespace

MeshSplit::MeshSplit(std::vector<fcl::Vector3d> vertices, std::vector<fcl::Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), order_(triangles_.size()) {
  if (triangles_.empty()) {
    throw std::invalid_argument("fcl_kios: a tree needs a mesh with at least one triangle.");
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (triangles_[i][corner] < vertices_.size()) continue;
      throw std::invalid_argument("fcl_kios: triangle " + std::to_string(i) + " has the vertex " +
                                  std::to_string(triangles_[i][corner]) + ", but there are only " +
                                  std::to_string(vertices_.size()) + ".");
    }
  }
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * triangles_.size() - 1);
  nodes_.push_back({0, 0, triangleCount(), 0});
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node node = nodes_[i];
    const std::vector<fcl::Vector3d> node_points = points(node);
    const int left_count = partition(node, node_points);
    nodes_[i].extent = longestSide(node_points);
    if (node.count == 1) continue;
    nodes_[i].left = static_cast<int>(nodes_.size());
    nodes_.push_back({0, node.first, left_count, 0});
    nodes_.push_back({0, node.first + left_count, node.count - left_count, 0});
  }
}

TriangleVertices<double> MeshSplit::corners(int triangle_id) const {
  const fcl::Triangle& t = triangles_[triangle_id];
  return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
}

std::vector<fcl::Vector3d> MeshSplit::points(const Node& node) const {
  std::vector<std::size_t> ids;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const fcl::Triangle& t = triangles_[order_[i]];
    ids.insert(ids.end(), {t[0], t[1], t[2]});
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<fcl::Vector3d> result;
  result.reserve(ids.size());
  for (const std::size_t id : ids) result.push_back(vertices_[id]);
  return result;
}

/// Orders the node's triangles; returns how many go left, by halves if a side would be empty.
int MeshSplit::partition(const Node& node, const std::vector<fcl::Vector3d>& points) {
  Eigen::Matrix3Xd in_frame;
  const PrincipalFrame frame =
      principalFrame(RelativePoints(points.data(), static_cast<int>(points.size())).p, in_frame);
  const Eigen::Vector3d axis = frame.axes.col(frame.order[0]);
  // Three times the height of a centroid above the first vertex, along the longest axis.
  const auto height = [&](unsigned int id) {
    double sum = 0;
    for (const Point<double>& p : corners(static_cast<int>(id))) {
      sum += axis.dot(p - points[0]);
    }
    return sum;
  };
  const auto begin = order_.begin() + node.first, end = begin + node.count;
  double mean = 0;
  for (auto id = begin; id != end; ++id) mean += height(*id) / node.count;
  const auto middle =
      std::stable_partition(begin, end, [&](unsigned int id) { return !(height(id) > mean); });
  return middle == begin || middle == end ? node.count / 2 : static_cast<int>(middle - begin);
}

}  // namespace kios::paper
