// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Queries with shapes and octrees raise no floating-point flags, but where FCL's own functions do.
#include "fcl/partners.h"
#include "floating_point_flags.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

/// Returns both ordinary and degenerate.
std::map<std::string, Mesh> meshes() {
  using namespace scenes;
  std::map<std::string, Mesh> all = {
      {"repeated", merged({singleTriangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0}),
                           singleTriangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0})})},
      {"point", singleTriangle({0.3, 0, 0}, {0.3, 0, 0}, {0.3, 0, 0})},
      {"at the centre", singleTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})},
      {"centre", singleTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0})},
      {"segment", singleTriangle({-1, 0, 0}, {1, 0, 0}, {0, 0, 0})},
      {"box", subdividedBox({1, 1, 1}, 1)},
      {"strips", stripCylinder(40, 0.6, 0.004)},
      {"poles", uvSphere(1, 8, 40)},
      {"sheet", sheet(2, 1.5, 9, 8, 0)}};
  for (const MeshCase& pair : meshCases()) all[pair.name] = pair.a;
  return all;
}

/// All partners, and shapes without extent in some directions or in all.
std::map<std::string, Geometry> partnersAndFlatShapes() {
  std::map<std::string, Geometry> all = partners();
  all["point box"] = std::make_shared<fcl::Boxd>(0, 0, 0);
  all["flat box"] = std::make_shared<fcl::Boxd>(1, 1, 0);
  all["point sphere"] = std::make_shared<fcl::Sphered>(0);
  all["point ellipsoid"] = std::make_shared<fcl::Ellipsoidd>(0, 0, 0);
  all["flat ellipsoid"] = std::make_shared<fcl::Ellipsoidd>(0.5, 0.7, 0);
  all["segment capsule"] = std::make_shared<fcl::Capsuled>(0, 1);
  all["flat cone"] = std::make_shared<fcl::Coned>(0.5, 0);
  all["point cone"] = std::make_shared<fcl::Coned>(0, 0);
  all["segment cylinder"] = std::make_shared<fcl::Cylinderd>(0, 1);
  return all;
}

TEST(Traps, ShapesAndOctrees) {
  Flags flags;
  for (const auto& [name, other] : partnersAndFlatShapes()) {
    for (const auto& [mesh_name, mesh] : meshes()) {
      const auto model = kiosModel(mesh);
      auto poses = scenes::randomPoses(6, 1.2, 3);
      poses.push_back(Transform3d::Identity());
      poses.emplace_back(Eigen::Translation3d(5, 0, 0));
      for (const Transform3d& X : poses) {
        const Transform3d here = Transform3d::Identity();
        const std::string names = name + ", " + mesh_name;
        flags.during(names + ": fcl::distance", [&] {
          fcl::DistanceResultd result;
          fcl::distance(model.get(), here, other.get(), X, fcl::DistanceRequestd(true), result);
        });
        flags.during(names + ": fcl::collide", [&] {
          fcl::CollisionResultd result;
          fcl::collide(other.get(), X, model.get(), here, fcl::CollisionRequestd(), result);
        });
        flags.during(names + ": fcl::collide, contacts", [&] {
          fcl::CollisionResultd result;
          fcl::collide(model.get(), here, other.get(), X, fcl::CollisionRequestd(100, true),
                       result);
        });
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
