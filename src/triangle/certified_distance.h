// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "triangle/pair.h"
#include "volume/rounding.h"

namespace kios {

/// The fast kernel: candidates of plain arithmetic, taken only if a slab between the triangles
/// certifies them to 8 eps magnitude; touching, intersecting and nearly degenerate pairs get none.
/// The pair's magnitude must lie within 2^+-32.
class CertifiedDistance {
 public:
  explicit CertifiedDistance(const TrianglePair& pair);

  /// Edges `begin` to `end` of p, those nearest to q first, against all of q.
  bool nearestEdges(int begin, int end, PairDistance& found);
  /// Edges have been found too near for any certificate.
  bool touching() const { return nearest_square_ <= least_ * least_; }
  /// Computes the planes; true if each triangle has vertices in the other's or on both sides, as
  /// far as rounding tells, when it pays to ask for an intersection before going on.
  bool crossing();
  /// Vertices against faces, after crossing().
  bool nearestFace(PairDistance& found) const;

 private:
  using Vec = Eigen::Vector3d;
  /// One triangle's plane, and the heights of the other's vertices above it times |normal|.
  struct Plane {
    const Vec *face, *edges;
    const double* squares;  ///< of the edges
    Vec normal;
    double square, length, heights[3];
    int side;  ///< of all three vertices, 0 if they differ or one lies in the plane
  };
  static constexpr int kNone = -1;

  void setPlane(const Vec (&other)[3], Plane& plane) const;
  static void orderEdges(const Vec (&v)[3], const Vec& direction, int (&order)[3]);
  bool edgePair(int i, int j, PairDistance& found);
  bool isAccurate(const Plane& plane) const;
  bool isAbove(const Plane& plane, const Vec& vertex) const;
  int facePair(const Plane& plane, const Vec (&other)[3]) const;
  bool takeFoot(int vertex_of_p, int vertex_of_q, PairDistance& found) const;
  bool certified(const Vec& direction, const Vec& x, double distance) const;

  const TrianglePair& pair_;
  const double tolerance_;  ///< of the certificate
  const double least_;      ///< nearer pairs are left to the exact predicates
  double nearest_square_ = kInfinity;
  Vec e_[3], f_[3];
  double ee_[3], ff_[3], per_ee_[3], per_ff_[3];
  int order_p_[3], order_q_[3];
  Plane plane_p_, plane_q_;
};

}  // namespace kios
