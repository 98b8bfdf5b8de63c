// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "arrays.h"
#include "fcl_kios/robot/robot.h"

namespace kios::python {

/// (n, k) configurations of k coordinates, or (k,) as one.
struct Configurations {
  Configurations(py::handle value, const char* name, const Robot& robot)
      : array(doubles(value, name)), single(array.ndim() == 1), k(robot.coordinates()) {
    if (array.ndim() < 1 || array.ndim() > 2 || array.shape(single ? 0 : 1) != k) {
      throw std::invalid_argument("fcl_kios: " + std::string(name) + " has shape " +
                                  std::string(py::str(array.attr("shape"))) + "; (n, " +
                                  std::to_string(k) + ") or (" + std::to_string(k) +
                                  ",) is needed, the coordinates of " + robot.name() + ".");
    }
    size = single ? 1 : static_cast<std::size_t>(array.shape(0));
    data = array.data();
  }
  Eigen::VectorXd operator[](std::size_t i) const {
    return Eigen::Map<const Eigen::VectorXd>(data + i * static_cast<std::size_t>(k), k);
  }
  Eigen::VectorXd only(const char* name) const {
    if (single) return (*this)[0];
    throw std::invalid_argument("fcl_kios: " + std::string(name) + " must be one configuration.");
  }

  /// What a batch of them is called, of which a message names one; nothing of one alone.
  const char* batch() const { return single ? "" : "q"; }

  py::array_t<double> array;
  bool single;
  Eigen::Index k;
  std::size_t size = 1;
  const double* data;
};

}  // namespace kios::python
