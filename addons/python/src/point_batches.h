// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "fcl_kios/points.h"
#include "mesh_batches.h"

namespace kios::python {

/// fcl_kios.WindingTree, which keeps the model.
struct Winding {
  explicit Winding(const Mesh& mesh) : model(mesh.share()), tree(*model) {}

  std::shared_ptr<const Modeld> model;
  WindingTree tree;
};

/// Distances, points and triangles. X_WM is one pose.
py::object nearest(const Mesh& self, py::handle points, py::handle X_WM, double within,
                   const BatchOptions& options);
/// `winding`: nullptr for solids.
py::object signedDistance(const Mesh& self, py::handle points, py::handle X_WM, double within,
                          const Winding* winding, const BatchOptions& options);
py::object windingNumbers(const Winding& self, py::handle points, double error,
                          const BatchOptions& options);

}  // namespace kios::python
