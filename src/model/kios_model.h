// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <typeinfo>

#include "fcl_kios/model.h"
#include "volume/errors.h"

namespace kios {

namespace detail {

/// Compares types as == does, but reads nothing of them where they are at one place.
inline bool areSame(const std::type_info& a, const std::type_info& b) { return &a == &b || a == b; }

/// asModel() of what is no Model<S> itself, but may be derived from it.
template <typename S>
[[gnu::noinline]] const Model<S>* asDerivedModel(const fcl::CollisionGeometry<S>* geometry) {
  if (!geometry) refuse("a collision geometry is null.");
  if (geometry->getNodeType() != fcl::BV_UNKNOWN || geometry->getObjectType() != fcl::OT_BVH) {
    return nullptr;
  }
  return dynamic_cast<const Model<S>*>(geometry);
}

}  // namespace detail

/// Returns the model behind a geometry, or nullptr if it is no kIOS model. The C++ type decides,
/// never the node type: all foreign volumes share BV_UNKNOWN.
template <typename S>
const Model<S>* asModel(const fcl::CollisionGeometry<S>* geometry) {
  if (geometry && detail::areSame(typeid(*geometry), typeid(Model<S>))) {
    return static_cast<const Model<S>*>(geometry);
  }
  return detail::asDerivedModel(geometry);
}

/// Checks that the model is finished and holds triangles, in O(1); every query calls this first.
/// Throws std::invalid_argument if not.
template <typename S>
void requireFinished(const Model<S>& model);

/// Throws where FCL's build calls failed, which throw for some of their arrays and return a status
/// for others.
void requireBuilt(int status);

/// The C++ name of the geometry's type, for messages.
template <typename S>
std::string typeName(const fcl::CollisionGeometry<S>& geometry);

template <typename S>
[[noreturn]] void refusePair(const char* query, const fcl::CollisionGeometry<S>& o1,
                             const fcl::CollisionGeometry<S>& o2) {
  const bool models = o1.getObjectType() == fcl::OT_BVH && o2.getObjectType() == fcl::OT_BVH;
  refuse(query, " of ", typeName(o1), " and ", typeName(o2), " is not supported",
         models ? "; convert the other model by kios::toKIOS(model)."
                : "; replace the other by a mesh, built by kios::makeModel().");
}

}  // namespace kios
