// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "fcl_kios/model.h"
#include "fcl_kios/solids.h"
#include "fuzz/mesh_fuzz/brute_force.h"
#include "scenes/foreign_fitter.h"

// Shared by the questions: models as a case wants them, and the report of a failure.

namespace kios::fuzz {

template <typename S>
std::shared_ptr<Model<S>> modelOf(const Mesh& mesh, bool foreign) {
  std::vector<fcl::Vector3<S>> vertices;
  for (const Vector3d& p : mesh.vertices) vertices.push_back(p.cast<S>());
  if (!foreign) return makeModel<S>(vertices, mesh.triangles);
  auto model = std::make_shared<Model<S>>();
  model->bv_fitter.reset(new scenes::ForeignFitter<kIOS<S>>());
  model->beginModel();
  model->addSubModel(vertices, mesh.triangles);
  model->endModel();
  return model;
}

/// Marks the model as a solid, unless it is none; returns whether it is.
template <typename S>
bool markIfSolid(Model<S>& model) {
  try {
    markSolid(model);
    return true;
  } catch (const std::invalid_argument&) {
    unmarkSolid(model);
    return false;
  }
}

/// Returns how far the vertices reach from their origin.
inline double reachOf(const std::vector<Mesh>& meshes) {
  double reach = 0;
  for (const Mesh& mesh : meshes) {
    for (const Vector3d& p : mesh.vertices) reach = std::max(reach, p.norm());
  }
  return reach;
}

/// |E| of a pose: R^T R - I.
template <typename S>
double skewOf(const fcl::Transform3<S>& X) {
  const fcl::Matrix3d R = X.linear().template cast<double>();
  return (R.transpose() * R - fcl::Matrix3d::Identity()).norm();
}

/// Holds the first two meshes of a case as models, at their poses of a frame.
template <typename S>
struct ModelPair {
  std::shared_ptr<Model<S>> A, B;
  fcl::Transform3<S> X, Y;

  explicit ModelPair(const Case& c, std::size_t frame = 0)
      : A(modelOf<S>(c.meshes[0], c.foreign)),
        B(modelOf<S>(c.meshes[1], c.foreign)),
        X(c.pose(0, frame).template cast<S>()),
        Y(c.pose(1, frame).template cast<S>()) {}
};

/// Holds numbers in decimal and, exactly, in hexadecimal.
class Words {
 public:
  Words() { stream_.precision(9); }
  template <typename T>
  Words& operator<<(const T& v) {
    if constexpr (std::is_floating_point_v<T>) {
      stream_ << v << " (" << std::hexfloat << v << std::defaultfloat << ")";
    } else {
      stream_ << v;
    }
    return *this;
  }
  std::string text() const { return stream_.str(); }

 private:
  std::ostringstream stream_;
};

/// Does as C++ takes it.
template <typename T>
std::string literal(T v) {
  std::ostringstream stream;
  if (std::isinf(static_cast<double>(v))) {
    stream << (v < 0 ? "-" : "") << "INFINITY";
  } else if (std::is_floating_point_v<T>) {
    stream << std::hexfloat << v;
  } else {
    stream << v;
  }
  return stream.str();
}

inline Verdict failure(const Words& what, std::string call) {
  return Failure{what.text(), std::move(call)};
}

inline std::string text(const std::pair<int, int>& ids) {
  return "(" + std::to_string(ids.first) + ", " + std::to_string(ids.second) + ")";
}

/// Returns the distance of a point and a triangle, both in the world, by the kernel.
template <typename S>
double distanceTo(const fcl::Vector3<S>& p, const TriangleVerticesd& t,
                  const fcl::Transform3<S>& X_W) {
  TriangleVertices<double> world;
  const fcl::Transform3d X = X_W.template cast<double>();
  for (int k = 0; k < 3; ++k) world[k] = X * t[k];
  const Vector3d q = p.template cast<double>();
  return triangleDistance<double>({q, q, q}, world).distance;
}

/// Returns the fault of nearest points in the world, if any. Each must lie on its triangle, and
/// they must be as far apart as the answer says, up to rounding of the coordinates in the frames
/// that they pass.
template <typename S>
std::optional<std::string> faultOfPoints(const BruteForce<S>& truth, const std::pair<int, int>& ids,
                                         const fcl::Vector3<S>& p, const fcl::Vector3<S>& q,
                                         S distance, const fcl::Transform3<S>& X_WA,
                                         const fcl::Transform3<S>& X_WB) {
  if (!p.allFinite() || !q.allFinite()) return "points that are not finite";
  const auto& a = truth.a[static_cast<std::size_t>(ids.first)];
  const auto& b = truth.trianglesInB()[static_cast<std::size_t>(ids.second)];
  double most = 0;
  for (const auto& v : a) most = std::max(most, v.template cast<double>().stableNorm());
  for (const auto& v : b) most = std::max(most, v.template cast<double>().stableNorm());
  most += X_WA.translation().template cast<double>().norm() +
          X_WB.translation().template cast<double>().norm() + p.template cast<double>().norm() +
          q.template cast<double>().norm();
  const double eps = BruteForce<S>::kEps, least = BruteForce<S>::kLeast;
  const double L = truth.extentOf(ids);
  // Points of triangles are right to 16 eps L; a matrix that is no rotation skews what its
  // transpose takes back.
  const double skew = 1.1 * (skewOf(X_WA) + skewOf(X_WB)) * most;
  const double bound = 32 * eps * (most + L) + 4 * least + skew;
  std::ostringstream words;
  const double apart = (p - q).template cast<double>().stableNorm();
  if (!(std::abs(apart - static_cast<double>(distance)) <= bound)) {
    words << "points are " << apart << " apart, not " << distance << " (bound " << bound << ")";
    return words.str();
  }
  const double from_a = distanceTo(p, a, X_WA), from_b = distanceTo(q, b, X_WB);
  if (!(from_a <= bound) || !(from_b <= bound)) {
    words << "points lie " << from_a << " and " << from_b << " from their triangles (bound "
          << bound << ")";
    return words.str();
  }
  return std::nullopt;
}

}  // namespace kios::fuzz
