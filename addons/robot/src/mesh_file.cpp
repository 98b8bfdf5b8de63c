// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.h"

#include <cmath>
#include <utility>

#include "fcl_kios/robot/robot.h"
#include "files/read_mesh.h"
#include "text_file.h"

namespace kios::robot {

std::shared_ptr<Modeld> weld(std::vector<fcl::Vector3d> vertices,
                             std::vector<fcl::Triangle> triangles) {
  files::Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  files::weld(mesh);
  return makeModel(mesh.vertices, mesh.triangles);
}

std::shared_ptr<Modeld> readMesh(const std::string& file, const fcl::Vector3d& scale,
                                 std::vector<std::string>& warnings) {
  files::Mesh mesh;
  try {
    mesh = files::readMesh(file);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  for (fcl::Vector3d& v : mesh.vertices) v.array() *= scale.array();
  if ((scale.array() < 0).count() % 2 == 1) {
    for (fcl::Triangle& t : mesh.triangles) t.set(t[0], t[2], t[1]);
  }
  warnings.insert(warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
  try {
    return weld(std::move(mesh.vertices), std::move(mesh.triangles));
  } catch (const std::exception& error) {
    refuse(file + ": " + error.what());
  }
}

}  // namespace kios::robot

namespace kios {

std::shared_ptr<Modeld> loadMesh(const std::string& file, double scale,
                                 std::vector<std::string>* warnings) {
  if (!(std::abs(scale) > 0 && std::isfinite(scale))) {
    robot::refuse("the scale of " + file + " must be finite and not 0.");
  }
  std::vector<std::string> none;
  return robot::readMesh(file, fcl::Vector3d::Constant(scale), warnings ? *warnings : none);
}

}  // namespace kios
