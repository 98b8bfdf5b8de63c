// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/model.h"

// Points and meshes: the nearest point of the surface, the signed distance from a solid, and the
// generalized winding number, for one point or for many. Docs: docs/points.md.

namespace kios {

class WindingTree;

/// The point of a mesh that is nearest to another.
struct NearestPoint {
  /// Right to 16 eps of the diagonal of the box around the point and the triangle. 0 if and only if
  /// the point lies on the mesh.
  double distance;
  double point[3];  ///< on the triangle, but for rounding, in the model's frame
  int triangle;     ///< of those at the least computed distance the first
};

/// What a query asks about points.
struct PointRequest {
  UnalignedPose X_WM = UnalignedPose::Identity();  ///< the model in the points' frame
  /// Points that are farther from the surface take little time. They have the distance infinity,
  /// the nearest point NaN and the triangle -1.
  double within = std::numeric_limits<double>::infinity();
  int threads = 1;  ///< that share a batch; 0: one a core
  /// Gives signs to a mesh that isn't closed: a point is inside where the number exceeds 0.5, as it
  /// is computed. It must be the model's.
  const WindingTree* winding = nullptr;
};

// All queries take float models in double, as they are. Answers depend neither on the order of a
// batch nor on threads or the instruction set. X_WM maps a point to R^-1 (p - T) in double, which
// moves it by at most 2^-48 |p - T|_1; the identity maps exactly. Safe from many threads. They
// throw std::invalid_argument if the model is not a finished mesh, a point is not finite or beyond
// 2^1000 (the message names its column), an array has another size than the points, the pose is not
// rigid, or `within` or `threads` is negative.

/// Returns the point of the mesh that is nearest to p, in the model's frame.
template <typename S>
NearestPoint nearestPoint(const Model<S>& model, const fcl::Vector3d& p);

/// Writes what nearestPoint() gives for each column of `points`; the nearest ones in their frame.
template <typename S>
void nearestPoints(const Model<S>& model, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                   Eigen::Ref<Eigen::VectorXd> distances, Eigen::Ref<Eigen::Matrix3Xd> nearest,
                   Eigen::Ref<Eigen::VectorXi> triangles, const PointRequest& request = {});

/// Returns the distance of p from the nearest triangle of a solid (solids.h): negative inside, 0 on
/// any triangle. The sign is exact; infinities have it, too. Where components overlap, walls that
/// lie within the solid count: there the magnitude is a lower bound of the depth in the union. With
/// request.winding the model may be any mesh.
///
/// Throws as above, and unless the model is marked as a solid or request.winding is its tree.
template <typename S>
double signedDistance(const Model<S>& model, const fcl::Vector3d& p,
                      const PointRequest& request = {});

/// Writes what signedDistance() gives for each column of `points`.
template <typename S>
void signedDistances(const Model<S>& model, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                     Eigen::Ref<Eigen::VectorXd> distances, const PointRequest& request = {});

/// The generalized winding number of a mesh, closed or not (Jacobson et al. 2013): how often it
/// winds round a point, a fraction near the borders of an open mesh. Distant triangles count
/// together by the moments of their normals (Barill et al. 2018), with a bound of the error.
class WindingTree {
 public:
  /// The model must outlive the tree. O(n); about 32 bytes a triangle, and 600 more. Throws
  /// std::invalid_argument if the model is not a finished mesh.
  template <typename S>
  explicit WindingTree(const Model<S>& model);
  ~WindingTree();
  WindingTree(WindingTree&& other) noexcept;
  WindingTree& operator=(WindingTree&& other) noexcept;

  /// Returns the number at p, a point in the model's frame, off by at most `error`; 0 sums all
  /// triangles. Rounding adds up to 2^-46 a triangle summed, and more within 2^-50 of a triangle's
  /// size from an edge. Triangles that p lies on count as 0: on a face it is the number of the side
  /// that the normal points away from, less a half; on an edge of a closed mesh the part of the
  /// space about it that is inside. Throws std::invalid_argument if p is not finite or beyond
  /// 2^1000, `error` is negative, or the model was rebuilt, refitted or marked since.
  double at(const fcl::Vector3d& p, double error = 1e-3) const;

  /// Returns whether the tree was made of this very model as it is now.
  template <typename S>
  bool isOf(const Model<S>& model) const;

  std::size_t bytes() const;

 private:
  class Nodes;
  std::unique_ptr<const Nodes> nodes_;
};

}  // namespace kios
