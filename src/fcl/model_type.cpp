// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/core/demangle.hpp>

#include "fcl/dispatch.h"
#include "fcl_kios/overloads.h"

namespace kios {

template <typename S>
std::string typeName(const fcl::CollisionGeometry<S>& geometry) {
  return boost::core::demangle(typeid(geometry).name());
}

template std::string typeName(const fcl::CollisionGeometry<double>&);
template std::string typeName(const fcl::CollisionGeometry<float>&);

bool holdsModel(const fcl::CollisionGeometry<double>* geometry) { return asModel(geometry); }
bool holdsModel(const fcl::CollisionGeometry<float>* geometry) { return asModel(geometry); }

void requireObjects(const void* object1, const void* object2) {
  if (!object1 || !object2) throw std::invalid_argument("fcl_kios: a collision object is null.");
}

}  // namespace kios
