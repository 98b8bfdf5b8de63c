// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/hard_poses.h"

#include "fuzz/mesh_fuzz/hard_meshes.h"

namespace kios::fuzz {
namespace {

/// One of the 24 rotations of the cube.
Eigen::Matrix3d cubeRotation(Random& random) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  const int i = below(random, 3), j = (i + scenes::integer(random, 1, 2)) % 3;
  R(0, i) = scenes::randomSign(random);
  R(1, j) = scenes::randomSign(random);
  R.row(2) = R.row(0).cross(R.row(1));
  return R;
}

Eigen::Matrix3d someRotation(Random& random) {
  switch (below(random, 4)) {
    case 0:
      return Eigen::Matrix3d::Identity();
    case 1:
      return cubeRotation(random);
    case 2:  // by next to nothing
      return Eigen::AngleAxisd(power(random, -17, -2), scenes::direction(random))
          .toRotationMatrix();
    default:
      return scenes::rotation(random);
  }
}

/// Returns a vertex, a point of an edge or of the face of one of the triangles.
Vector3d someContent(const Mesh& mesh, Random& random) {
  const fcl::Triangle& t = mesh.triangles[below(random, static_cast<int>(mesh.triangles.size()))];
  const Vector3d &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
  switch (below(random, 4)) {
    case 0:
      return 0.5 * (p + q);
    case 1:
      return p + random.unit() * (q - p);
    case 2:
      return 0.25 * p + 0.25 * q + 0.5 * r;
    default:
      return p;
  }
}

}  // namespace

Transform3d hardPose(const Mesh& a, const Mesh& b, double size, Random& random) {
  Transform3d X = Transform3d::Identity();
  const Vector3d middle_a = middleOf(a), middle_b = middleOf(b);
  const auto middleTo = [&](const Vector3d& p) { X.translation() = p - X.linear() * middle_b; };
  switch (below(random, 9)) {
    case 0:
      break;
    case 1:  // next to nothing
      X.translation() = size * power(random, -30, -5) * scenes::point(random);
      break;
    case 2:
    case 3:  // turned about a common centre
      X.linear() = someRotation(random);
      middleTo(middle_a);
      break;
    case 4:
      X.linear() = someRotation(random);
      middleTo(middle_a + size * power(random, -18, 0) * scenes::point(random));
      break;
    case 5:
      X.linear() = cubeRotation(random);
      X.translation() = size * scenes::latticePoint(random, 4) / 4;
      break;
    case 6: {  // a point on a point, but for a gap
      X.linear() = someRotation(random);
      const double gap = chance(random, 0.4) ? 0 : size * power(random, -18, -1);
      X.translation() = someContent(a, random) + gap * scenes::direction(random) -
                        X.linear() * someContent(b, random);
      break;
    }
    case 7:
      X.linear() = scenes::rotation(random);
      middleTo(middle_a + size * random.uniform(0, 2) * scenes::direction(random));
      break;
    default:
      X.linear() = someRotation(random);
      middleTo(middle_a +
               size * power(random, 0, chance(random, 0.2) ? 9 : 1) * scenes::direction(random));
  }
  return X;
}

Transform3d hardWorld(double size, Random& random) {
  Transform3d X = Transform3d::Identity();
  switch (below(random, 8)) {
    case 0:
      X.linear() = scenes::rotation(random);
      X.translation() = size * scenes::point(random);
      break;
    case 1:
      X.linear() = someRotation(random);
      X.translation() = 0x1p30 * scenes::point(random);
      break;
    case 2:
      X.translation() = size * power(random, -3, 9) * scenes::point(random);
      break;
    default:
      break;
  }
  return X;
}

void blurRotations(std::vector<Transform3d>& poses, Random& random) {
  const double noise = chance(random, 0.5) ? 0 : power(random, -9, -5);
  for (Transform3d& X : poses) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double& v = X.matrix()(i, j);
        v = noise > 0 ? v + noise * random.uniform(-1, 1) : std::round(v * 1e6) / 1e6;
      }
    }
  }
}

Transform3d moved(const Transform3d& X, const Vector3d& middle, double size, Random& random) {
  Transform3d to = X;
  const Vector3d at = X * middle;
  if (chance(random, 0.7)) {
    const double angle = chance(random, 0.5) ? random.uniform(0, 3) : power(random, -12, 0);
    to.linear() = Eigen::AngleAxisd(angle, scenes::direction(random)) * X.linear();
  }
  const double way = size * (chance(random, 0.5) ? random.uniform(0, 3) : power(random, -16, 0));
  const Vector3d shift = (chance(random, 0.8) ? way : 0) * scenes::direction(random);
  to.translation() = at + shift - to.linear() * middle;
  return to;
}

}  // namespace kios::fuzz
