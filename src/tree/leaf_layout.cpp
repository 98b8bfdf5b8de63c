// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/leaf_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fcl_kios/detail/rigid.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

using Vec = Eigen::Vector3d;

/// A coordinate of eight faces.
using Eight = double[kLanes];

/// Planes and edge planes of up to eight faces; of those that are too thin, planes that hold
/// everywhere, and of those that are points those of a small prism. Adds up the normals. Written
/// without branches, for the compiler to vectorise.
///
/// A normal is by the longest edge and the height above it, true to 2^-52 * aspect; a face for
/// which that is more than a few 2^-30 is too thin. A face is a point to any pad where products of
/// its squares lose precision or vanish. A point has a normal like any face, and edge planes
/// through it whose inward normals sum to 0: what touches it crosses its plane within all of them,
/// and what is farther from it is so along the normal or behind one of them.
void writeFaces(const FaceCorners* faces, int count, Lanes* rows, Vec& sum_of_normals) {
  Eight v[3][3];  // by corner and coordinate
  for (int i = 0; i < kLanes; ++i) {
    const FaceCorners& face = faces[std::min(i, count - 1)];
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) v[k][c][i] = face[k][c];
    }
  }
  Eight edge[3][3], square[3];
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < kLanes; ++i) {
      for (int c = 0; c < 3; ++c) edge[k][c][i] = v[(k + 1) % 3][c][i] - v[k][c][i];
      square[k][i] = edge[k][0][i] * edge[k][0][i] + edge[k][1][i] * edge[k][1][i] +
                     edge[k][2][i] * edge[k][2][i];
    }
  }
  Eight normal[3], usable, point;
  for (int i = 0; i < kLanes; ++i) {
    const bool second = square[1][i] > square[0][i];
    const double of_two = second ? square[1][i] : square[0][i];
    const bool third = square[2][i] > of_two;
    const double longest = third ? square[2][i] : of_two;
    double e[3], h[3];  // the longest edge; from its start to the apex, then across it
    for (int c = 0; c < 3; ++c) {
      e[c] = third ? edge[2][c][i] : (second ? edge[1][c][i] : edge[0][c][i]);
      h[c] = third ? -edge[1][c][i] : (second ? -edge[0][c][i] : -edge[2][c][i]);
    }
    // If the triangle is a point, h and e are 0.
    const double along = (h[0] * e[0] + h[1] * e[1] + h[2] * e[2]) / (longest > 0 ? longest : 1.0);
    for (int c = 0; c < 3; ++c) h[c] -= along * e[c];
    const double height = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
    const bool thick = height > 0x1p-40 * longest && longest > 0x1p-400;
    point[i] = longest > 0x1p-400 ? 0.0 : 1.0;
    const double length = std::sqrt(thick ? longest * height : 1.0);
    usable[i] = thick ? 1.0 : 0.0;
    normal[0][i] = thick ? (e[1] * h[2] - e[2] * h[1]) / length : 0.0;
    normal[1][i] = thick ? (e[2] * h[0] - e[0] * h[2]) / length : 0.0;
    normal[2][i] = thick ? (e[0] * h[1] - e[1] * h[0]) / length : 0.0;
  }
  for (int i = 0; i < count; ++i) sum_of_normals += Vec(normal[0][i], normal[1][i], normal[2][i]);
  for (int c = 0; c < 3; ++c) {  // offsets belong to what is stored
    for (int i = 0; i < kLanes; ++i) {
      rows[kFacePlane + c].v[i] = roundedTo<float>(normal[c][i]);
      normal[c][i] = double{rows[kFacePlane + c].v[i]};
    }
  }
  for (int i = 0; i < kLanes; ++i) {
    double height = 0;
    for (int c = 0; c < 3; ++c) height += normal[c][i] * (v[0][c][i] + v[1][c][i] + v[2][c][i]);
    rows[kFacePlane + 3].v[i] = roundedTo<float>(-height / 3);
  }
  for (int k = 0; k < 3; ++k) {
    Lanes* const plane = rows + kEdgePlanes + 4 * k;
    for (int i = 0; i < kLanes; ++i) {
      const bool thick = usable[i] > 0;
      const double length = std::sqrt(thick ? square[k][i] : 1.0);
      double height = 0;
      for (int c = 0; c < 3; ++c) {
        const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        const double cross = normal[c1][i] * edge[k][c2][i] - normal[c2][i] * edge[k][c1][i];
        plane[c].v[i] = roundedTo<float>(cross / length);
        height += double{plane[c].v[i]} * v[k][c][i];
      }
      plane[3].v[i] = roundedTo<float>(thick ? -height : 1.0);
    }
  }
  constexpr float kPrism[4][2] = {{0, 0}, {1, 0}, {-0.5F, 0.8660254F}, {-0.5F, -0.8660254F}};
  for (int i = 0; i < kLanes; ++i) {
    if (point[i] == 0) continue;
    for (int k = 0; k < 4; ++k) {
      Lanes* const plane = rows + (k == 0 ? int{kFacePlane} : kEdgePlanes + 4 * (k - 1));
      const float x = kPrism[k][0], y = kPrism[k][1], z = k == 0 ? 1.0F : 0.0F;
      plane[0].v[i] = x;
      plane[1].v[i] = y;
      plane[2].v[i] = z;
      plane[3].v[i] = roundedTo<float>(
          -(double{x} * v[0][0][i] + double{y} * v[0][1][i] + double{z} * v[0][2][i]));
    }
  }
}

}  // namespace

void placeLeaf(const Eigen::Vector3f* vertices, const FaceCorners* faces, Leaf& leaf, Tree& tree) {
  Lanes* const lanes = &tree.lanes[leaf.offset];
  Eigen::Vector3f low = vertices[0], high = low;
  for (int i = 0; i < kLanes * leaf.vertexChunks(); ++i) {  // what lies beyond repeats the last
    const Eigen::Vector3f& p = vertices[std::min(i, leaf.num_vertices - 1)];
    for (int c = 0; c < 3; ++c) lanes[3 * (i / kLanes) + c].v[i % kLanes] = p[c];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec sum = Vec::Zero();
  writeFaces(faces, leaf.num_faces, lanes + 3 * leaf.vertexChunks(), sum);
  const Eigen::Vector3f middle = 0.5F * (low + high);
  if (sum.isZero(0)) sum = Vec::UnitX();
  const Eigen::Vector3f normal = roundedTo<float>(sum.normalized());
  std::copy_n(middle.data(), 3, leaf.centroid);
  std::copy_n(normal.data(), 3, leaf.normal);
  leaf.normal_bottom = leaf.normal_top = detail::dot<float>(normal, vertices[0]);
  for (int i = 1; i < leaf.num_vertices; ++i) {
    const float height = detail::dot<float>(normal, vertices[i]);
    leaf.normal_bottom = std::min(leaf.normal_bottom, height);
    leaf.normal_top = std::max(leaf.normal_top, height);
  }
}

}  // namespace kios::engine
