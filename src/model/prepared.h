// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <boost/smart_ptr/intrusive_ptr.hpp>
#include "build/mesh_view.h"
#include "fcl_kios/model.h"
#include "model/kios_model.h"
#include "search/mesh.h"
#include "tree/content_hash.h"
#include "tree/tree.h"

namespace kios {

/// What a layer above keeps with a prepared mesh, and of each later state of its model: see
/// solid/solid_mark.h.
class Attachment {
 public:
  virtual ~Attachment() = default;
  /// Made anew for the present state of a model: a mesh that is about to be finished, or the point
  /// cloud that it has become, without a tree.
  virtual std::shared_ptr<const Attachment> renewed(const Mesh& mesh) const = 0;
};

/// What a model has beside its mesh once it is finished: the nodes and primitives of FCL's tree,
/// which follow it in memory, and the tree that queries search. Copies of a model and models of
/// equal content, anywhere in the process, hold one; it is never changed while several do.
struct alignas(16) Prepared {
  std::shared_ptr<engine::Tree> tree;  ///< nullptr: a point cloud
  std::shared_ptr<const Attachment> attachment;
  std::uint64_t generation = 0;  ///< unlike that of any other state; 0: not finished
  bool ordinary = false;         ///< the nodes are those that buildVolumes() gives for this mesh
  int num_nodes = 0;             ///< as many as there is room for

  // Belong to the registry in prepared.cpp.
  int holders = 1;
  bool tree_is_shared = false;  ///< with a copy, which may be another's by now
  bool listed = false;
  engine::ContentHash content;

  template <typename S>
  fcl::BVNode<kIOS<S>>* nodes() {
    return reinterpret_cast<fcl::BVNode<kIOS<S>>*>(this + 1);
  }
  template <typename S>
  unsigned int* primitives() {
    return reinterpret_cast<unsigned int*>(nodes<S>() + num_nodes);
  }
  /// That of a model's first node.
  template <typename S>
  static Prepared* before(const fcl::BVNode<kIOS<S>>* nodes) {
    return reinterpret_cast<Prepared*>(const_cast<fcl::BVNode<kIOS<S>>*>(nodes)) - 1;
  }
};

// Both lock the registry.
void intrusive_ptr_add_ref(Prepared* held);
void intrusive_ptr_release(Prepared* held);
using PreparedHandle = boost::intrusive_ptr<Prepared>;

/// What models without a tree have.
PreparedHandle preparedForNone();
/// A new one with room for a tree of so many nodes, for whoever makes them: another pass over as
/// much memory is a part of a large build. Throws std::bad_alloc.
template <typename S>
PreparedHandle makePrepared(int num_nodes);
/// What is held anywhere for this content; null if nothing is.
PreparedHandle findPrepared(const engine::ContentHash& content);
/// Lets others find it by its content; what is listed already takes its place.
void list(PreparedHandle& held, const engine::ContentHash& content);
/// Makes it the holder's own, of which nobody else knows: a copy if need be.
template <typename S>
void own(PreparedHandle& held);

/// A number that no other call in this process returned; never 0.
std::uint64_t nextGeneration();

template <typename S>
const Prepared& preparedOf(const Model<S>& model) {
  return *Prepared::before<S>(&model.getBV(0));
}

/// The tree of a finished mesh.
template <typename S>
const engine::Tree& treeOf(const Model<S>& model) {
  return *preparedOf(model).tree;
}

template <typename S>
engine::MeshView<S> viewOf(const Model<S>& model) {
  return {model.vertices, static_cast<std::size_t>(model.num_vertices), model.tri_indices,
          static_cast<std::size_t>(model.num_tris)};
}

/// A finished mesh for queries. Throws std::invalid_argument if the model isn't one.
template <typename S>
Mesh meshOf(const Model<S>& model) {
  requireFinished(model);
  return Mesh(viewOf(model), treeOf(model), model.getBV(0).bv, preparedOf(model).attachment.get());
}

template <typename S>
TriangleVerticesd cornersInDouble(const Model<S>& model, int triangle) {
  const engine::MeshView<S> mesh = viewOf(model);
  const auto corner = [&mesh, t = static_cast<std::size_t>(triangle)](std::size_t k) -> Pointd {
    return mesh.corner(t, k).template cast<double>();
  };
  return {corner(0), corner(1), corner(2)};
}

/// Tells one state of a model from every later one: builds, refits and marks change it, and arrays
/// that are others.
struct ModelState {
  std::uint64_t generation = 0;
  const void *vertices = nullptr, *triangles = nullptr;

  bool operator==(const ModelState& o) const {
    return generation == o.generation && vertices == o.vertices && triangles == o.triangles;
  }
};

template <typename S>
ModelState stateOf(const Model<S>& model) {
  return {preparedOf(model).generation, model.vertices, model.tri_indices};
}

/// What takes the place of an attachment in the model's present state.
template <typename S>
std::shared_ptr<const Attachment> renewed(const Attachment& attachment, const Model<S>& model,
                                          Prepared& prepared) {
  if (!prepared.tree) return attachment.renewed(Mesh(viewOf(model)));
  return attachment.renewed(
      Mesh(viewOf(model), *prepared.tree, prepared.nodes<S>()->bv, &attachment));
}

/// Makes the tree of a mesh whose nodes are fitted.
template <typename S>
void prepareTree(const Model<S>& model, Prepared& prepared);
/// Does so after a refit: the tree of the earlier state is moved where it can be.
template <typename S>
void refitTreeOf(const Model<S>& model, Prepared& prepared);

}  // namespace kios
