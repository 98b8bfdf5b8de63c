// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "inspection.h"

#include <algorithm>
#include <stdexcept>

#include "fcl_kios/model.h"

namespace kios::inspect {
namespace {

std::size_t bytesOf(const Modeld& model) {
  const auto bytes = [](std::size_t size, int count) {
    return size * static_cast<std::size_t>(count);
  };
  return sizeof(model) + bytes(sizeof(fcl::Vector3d), model.num_vertices) +
         bytes(sizeof(fcl::Triangle) + sizeof(unsigned), model.num_tris) +
         bytes(sizeof(fcl::BVNode<kIOSd>), model.getNumBVs());
}

}  // namespace

std::size_t Inspection::count(Meeting kind) const {
  return static_cast<std::size_t>(
      std::count_if(self_intersections.begin(), self_intersections.end(),
                    [&](const SelfIntersection& pair) { return pair.kind == kind; }));
}

std::vector<std::string> Inspection::warnings() const {
  std::vector<std::string> result = inspect::warnings(mesh, defects);
  if (self_intersections.empty()) return result;
  const SelfIntersection& first = self_intersections.front();
  const std::size_t n = self_intersections.size();
  result.push_back((n == kMostSelfIntersections ? "at least " : "") + std::to_string(n) +
                   (n == 1 ? " pair" : " pairs") +
                   " of triangles that meet beyond what they share (" +
                   std::to_string(count(Meeting::kCross)) + " cross, " +
                   std::to_string(count(Meeting::kOverlap)) + " overlap, " +
                   std::to_string(count(Meeting::kTouch)) + " touch), the first is " +
                   std::to_string(first.triangle_a) + " and " + std::to_string(first.triangle_b));
  return result;
}

Inspection inspect(const std::filesystem::path& file, bool tightness, Progress& progress,
                   const RepairRequest* repair) {
  Inspection result;
  result.file = file.string();
  progress.step("reading " + result.file);
  try {
    result.mesh = files::readMesh(result.file);
  } catch (const std::exception& error) {
    throw InputError(error.what());
  }
  result.read_seconds = progress.done();
  if (repair) {
    progress.step("repairing " + result.file);
    result.repaired = kios::repair(result.mesh.vertices, result.mesh.triangles, *repair);
    result.mesh.vertices = result.repaired->vertices;
    result.mesh.triangles = result.repaired->triangles;
    if (result.mesh.triangles.empty()) {
      throw InputError(result.file + ": no triangle is left after " + summaryOf(*result.repaired) +
                       ".");
    }
  }

  const std::string triangles = std::to_string(result.mesh.triangles.size()) + " triangles";
  progress.step("looking for defects in " + triangles);
  result.defects = findDefects(result.mesh);
  for (const fcl::Triangle& t : result.mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) result.box.extend(result.mesh.vertices[t[corner]]);
  }

  progress.step("building the tree of " + triangles);
  try {
    result.model = makeModel(result.mesh.vertices, result.mesh.triangles);
  } catch (const std::invalid_argument& error) {
    throw InputError(result.file + ": " + error.what());
  }
  result.build_seconds = progress.done();

  progress.step("looking for intersections of " + triangles);
  result.self_intersections = selfIntersections(*result.model, kMostSelfIntersections);
  progress.done();

  result.tree = std::make_unique<VolumeTree>(*result.model);
  for (int node = 0; node < result.nodes(); ++node) ++result.k[result.tree->volume(node).k() / 2];
  result.model_bytes = bytesOf(*result.model);
  result.prepared_bytes = preparedBytes(*result.model);
  if (!tightness) return result;

  std::vector<int> nodes = {0};
  for (int level = 0; level <= result.tree->depth(); ++level) {
    progress.step("measuring level " + std::to_string(level) + " of " +
                  std::to_string(result.tree->depth()));
    if (level > 0) nodes = result.tree->deeper(nodes);
    result.levels.push_back(measure(*result.tree, level, nodes));
  }
  return result;
}

}  // namespace kios::inspect
