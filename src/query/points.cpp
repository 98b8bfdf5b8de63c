// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/points.h"

#include <limits>

#include "model/prepared.h"
#include "query/nearest_on_mesh.h"
#include "query/point_batch.h"
#include "volume/instantiate.h"

namespace kios {

template <typename S>
NearestPoint nearestPoint(const Model<S>& model, const fcl::Vector3d& p) {
  const Mesh mesh = meshOf(model);
  requireValidPoint(p, 0);
  const NearestOnMesh near = nearestOnMesh(mesh, p, kInfinity);
  return {near.distance, {near.point[0], near.point[1], near.point[2]}, near.triangle};
}

template <typename S>
void nearestPoints(const Model<S>& model, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                   Eigen::Ref<Eigen::VectorXd> distances, Eigen::Ref<Eigen::Matrix3Xd> nearest,
                   Eigen::Ref<Eigen::VectorXi> triangles, const PointRequest& request) {
  const Mesh mesh = meshOf(model);
  const PointBatch batch(points, request);
  batch.requireSize(distances.size(), "distances");
  batch.requireSize(nearest.cols(), "nearest points");
  batch.requireSize(triangles.size(), "triangles");
  batch.forAll([&]() -> PointBatch::Look {
    return [&, start = -1](Eigen::Index i) mutable {
      const NearestOnMesh near = nearestOnMesh(mesh, batch.inModel(i), request.within, start);
      start = near.triangle;
      distances[i] = near.distance;
      triangles[i] = near.triangle;
      if (near.triangle >= 0) {
        nearest.col(i) = batch.toPoints(near.point);
      } else {
        nearest.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      }
    };
  });
}

KIOS_INSTANTIATE_FUNCTION(nearestPoint);
KIOS_INSTANTIATE_FUNCTION(nearestPoints);

}  // namespace kios
