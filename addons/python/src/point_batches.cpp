// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl_kios/points.h"
#include "mesh_batches.h"
#include "without_gil.h"

namespace kios::python {
namespace {

/// fcl_kios.WindingTree, which keeps the model.
struct Winding {
  explicit Winding(const Mesh& mesh) : model(mesh.share()), tree(*model) {}

  std::shared_ptr<const Modeld> model;
  WindingTree tree;
};

constexpr double kLargest = 0x1p1000;  ///< coordinate that queries take

struct CheckedPoints : Points {
  explicit CheckedPoints(py::handle value) : Points(value, "points") {
    for (std::size_t i = 0; i < size; ++i) {
      if (((*this)[i].array().abs() <= kLargest).all()) continue;
      throw std::invalid_argument("fcl_kios: points[" + std::to_string(i) +
                                  "] must be finite, and at most 2^1000.");
    }
  }
};

/// What a batch about points asks.
struct PointQuery {
  PointQuery(py::handle p, py::handle X_WM, double within) : points(p) {
    request.X_WM = Poses(X_WM, "X_WM").only("X_WM");
    request.within = within;
  }

  using Part = Eigen::Map<const Eigen::Matrix3Xd>;
  /// Calls work(first, points) for parts of neighbours in the array, in many threads; and for no
  /// points at first, which throws what is wrong with the rest of the request.
  template <typename Work>
  void run(const BatchOptions& options, const Work& work) const {
    // Many points are near each other, but winding numbers of as many take long.
    const auto shares = 8 * static_cast<std::size_t>(threadsOf(options.threads));
    const std::size_t part_size =
        request.winding ? 1024 : std::clamp<std::size_t>(points.size / shares, 1024, 1 << 14);
    work(0, Part(points.data, 3, 0));
    BatchOptions in_parts = options;
    if (!options.progress.is_none()) {
      in_parts.progress = py::cpp_function(
          [part_size, progress = options.progress, left = points.size](std::size_t parts) mutable {
            const std::size_t done = std::min(left, parts * part_size);
            left -= done;
            progress(done);
          });
    }
    runBatch(
        (points.size + part_size - 1) / part_size, in_parts, "parts of points", [&](std::size_t i) {
          const std::size_t first = i * part_size, count = std::min(part_size, points.size - first);
          work(first, Part(points.data + 3 * first, 3, static_cast<Eigen::Index>(count)));
        });
  }

  const CheckedPoints points;
  PointRequest request;
};

/// Distances, points and triangles.
py::object nearest(const Mesh& self, py::handle points, py::handle X_WM, double within,
                   const BatchOptions& options) {
  const Modeld& model = self.model();
  const PointQuery query(points, X_WM, within);
  std::vector<double> distances(query.points.size);
  std::vector<Eigen::Vector3d> at(query.points.size);
  std::vector<int> triangles(query.points.size);
  query.run(options, [&](std::size_t first, const PointQuery::Part& part) {
    const Eigen::Index n = part.cols();
    nearestPoints(model, part, Eigen::Map<Eigen::VectorXd>(distances.data() + first, n),
                  Eigen::Map<Eigen::Matrix3Xd>(at.data()->data() + 3 * first, 3, n),
                  Eigen::Map<Eigen::VectorXi>(triangles.data() + first, n), query.request);
  });
  const bool single = query.points.single;
  return py::make_tuple(column(distances, single), column(at, single), column(triangles, single));
}

/// `winding`: nullptr for solids.
py::object signedDistance(const Mesh& self, py::handle points, py::handle X_WM, double within,
                          const Winding* winding, const BatchOptions& options) {
  const Modeld& model = self.model();
  PointQuery query(points, X_WM, within);
  if (winding) query.request.winding = &winding->tree;
  std::vector<double> distances(query.points.size);
  query.run(options, [&](std::size_t first, const PointQuery::Part& part) {
    signedDistances(model, part, Eigen::Map<Eigen::VectorXd>(distances.data() + first, part.cols()),
                    query.request);
  });
  return column(distances, query.points.single);
}

py::object windingNumbers(const Winding& self, py::handle points, double error,
                          const BatchOptions& options) {
  const CheckedPoints asked(points);
  if (!(error >= 0)) throw std::invalid_argument("fcl_kios: error must be 0 or more.");
  return column(runEach(asked.size, options, "points",
                        [&](std::size_t i) { return self.tree.at(asked[i], error); }),
                asked.single);
}

}  // namespace

void bindPointBatches(py::module_& m, MeshClass& c) {
  c.def("_nearest", &nearest).def("_signed_distance", &signedDistance);
  py::class_<Winding>(m, "_WindingTree")
      .def(py::init([](const Mesh& mesh) {
        const WithoutGil released;
        return std::make_unique<Winding>(mesh);
      }))
      .def("_at", &windingNumbers)
      .def("_nbytes", [](const Winding& self) { return self.tree.bytes(); });
}

}  // namespace kios::python
