// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/kios_model.h"

#include <boost/core/demangle.hpp>

namespace kios {

template <typename S>
std::string typeName(const fcl::CollisionGeometry<S>& geometry) {
  return boost::core::demangle(typeid(geometry).name());
}

template std::string typeName(const fcl::CollisionGeometry<double>&);
template std::string typeName(const fcl::CollisionGeometry<float>&);

}  // namespace kios
