// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <typeinfo>

#include <fcl/geometry/bvh/BV_node.h>
#include <fcl/geometry/bvh/detail/BV_fitter_base.h>
#include "fcl_kios/volume/kios.h"
#include "volume/errors.h"

namespace kios {

/// A finished tree in place of a fitter: endModel() moves it into the model, whose mesh it was
/// checked to be of, and fits nothing.
template <typename S>
class StoredTree final : public fcl::detail::BVFitterBase<kIOS<S>> {
 public:
  /// That of a model; nullptr if its fitter is another one.
  static StoredTree* in(fcl::detail::BVFitterBase<kIOS<S>>& fitter) {
    return typeid(fitter) == typeid(StoredTree) ? static_cast<StoredTree*>(&fitter) : nullptr;
  }

  void set(fcl::Vector3<S>* /*vertices*/, fcl::Triangle* /*triangles*/,
           fcl::BVHModelType /*type*/) override {}
  void set(fcl::Vector3<S>* /*vertices*/, fcl::Vector3<S>* /*previous*/,
           fcl::Triangle* /*triangles*/, fcl::BVHModelType /*type*/) override {}
  kIOS<S> fit(unsigned int* /*primitives*/, int /*n*/) override {
    refuse<std::logic_error>("a stored tree has no fit to make.");
  }
  void clear() override {}

  std::unique_ptr<fcl::BVNode<kIOS<S>>[]> nodes;
  std::unique_ptr<unsigned int[]> primitives;
};

}  // namespace kios
