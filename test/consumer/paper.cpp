// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Builds a model by a published fit, of the addon fcl_kios::paper.
#include <fcl_kios/fcl_kios.h>
#include <fcl_kios/paper.h>

#include <memory>
#include <vector>

int main() {
  const std::vector<fcl::Vector3d> points = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 1}};
  const std::vector<fcl::Triangle> faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  kios::kIOSd bv;
  kios::fit(points.data(), 4, bv, kios::FitMethod::kMethodI);
  kios::Modeld model;
  model.bv_fitter = std::make_shared<kios::PaperFitterd>(kios::FitMethod::kMethodII);
  model.beginModel(4, 4);
  model.addSubModel(points, faces);
  const bool built = model.endModel() == fcl::BVH_OK;
  return built && bv.contain(points[1]) && model.getBV(0).bv.contain(points[1]) ? 0 : 1;
}
