// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that make and free arrays, for models over k-IOS. FCL's own, called
// again after memory ran out or a model was reset, lose arrays, and the destructor frees one twice.
#include <iostream>
#include <new>

#include "model/members.h"
#include "model/prepared.h"

namespace kios {

int outOfMemory(const char* call) {
  std::cerr << "BVH Error! Out of memory on " << call << " call!\n";
  return fcl::BVH_ERR_MODEL_OUT_OF_MEMORY;
}

namespace {

/// Makes a triangle that is a point of each vertex: queries take a point cloud as such a mesh.
template <typename S>
void makePoints(const Members<S>& m) {
  Model<S>& model = m.model;
  auto triangles = makeArray<fcl::Triangle>(model.num_vertices);
  for (int i = 0; i < model.num_vertices; ++i) {
    const auto vertex = static_cast<std::size_t>(i);
    triangles[vertex].set(vertex, vertex, vertex);
  }
  replace(model.tri_indices, std::move(triangles));
  model.num_tris = m.num_tris_allocated = model.num_vertices;
}

template <typename T>
void shrink(T*& array, int& allocated, int n) {
  if (allocated <= n) return;
  replace(array, copyOf(array, n));
  allocated = n;
}

/// `to` is a model without arrays, fitter and splitter. It gets nothing if memory runs out.
template <typename S>
void copy(const Model<S>& from, int num_vertices_given, int num_nodes, Members<S> to) {
  Model<S>& model = to.model;
  auto vertices = copyOf(from.vertices, from.num_vertices);
  auto triangles = copyOf(from.tri_indices, from.num_tris);
  auto previous = copyOf(from.prev_vertices, from.num_vertices);
  to.take(Prepared::before<S>(&from.getBV(0)));
  replace(model.vertices, std::move(vertices));
  replace(model.tri_indices, std::move(triangles));
  replace(model.prev_vertices, std::move(previous));
  model.num_tris = to.num_tris_allocated = from.num_tris;
  model.num_vertices = to.num_vertices_allocated = from.num_vertices;
  to.num_nodes = num_nodes;
  to.num_vertices_given = num_vertices_given;
  model.build_state = from.build_state;
  model.bv_splitter = from.bv_splitter;
  model.bv_fitter = from.bv_fitter;
}

/// Frees all arrays of vertices and triangles.
template <typename S>
void clear(Members<S> m) {
  Model<S>& model = m.model;
  replace(model.vertices, {});
  replace(model.tri_indices, {});
  replace(model.prev_vertices, {});
  model.num_tris = m.num_tris_allocated = 0;
  model.num_vertices = m.num_vertices_allocated = 0;
}

/// Gives up the tree, but not the attachment, which builds make anew.
template <typename S>
void dropTree(Members<S> m) {
  PreparedHandle without = preparedForNone();
  if (m.prepared().attachment) {
    without = makePrepared<S>(0);
    without->attachment = m.prepared().attachment;
  }
  m.take(std::move(without));
}

template <typename S>
int begin(Members<S> m, int num_tris, int num_vertices) {
  Model<S>& model = m.model;
  const bool was_empty = model.build_state == fcl::BVH_BUILD_STATE_EMPTY;
  clear(m);
  m.num_nodes = 0;
  model.build_state = fcl::BVH_BUILD_STATE_EMPTY;
  if (num_tris < 0) num_tris = 8;
  if (num_vertices <= 0) num_vertices = 8;
  try {
    dropTree(m);
    if (num_tris > 0) replace(model.tri_indices, makeArray<fcl::Triangle>(num_tris));
    m.num_tris_allocated = num_tris;
    replace(model.vertices, makeArray<fcl::Vector3<S>>(num_vertices));
    m.num_vertices_allocated = num_vertices;
  } catch (const std::bad_alloc&) {
    return outOfMemory("beginModel()");
  }
  if (!was_empty) {  // with its arrays: FCL's addTriangle() doesn't check that there are any
    std::cerr << "BVH Warning! Call beginModel() on a BVHModel that is not empty. This model was "
                 "cleared and previous triangles/vertices were lost.\n";
    return fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE;
  }
  model.build_state = fcl::BVH_BUILD_STATE_BEGUN;
  return fcl::BVH_OK;
}

/// The part of endModel() that comes before the tree is built.
template <typename S>
int end(Members<S> m) {
  Model<S>& model = m.model;
  if (model.build_state != fcl::BVH_BUILD_STATE_BEGUN) {
    std::cerr << "BVH Warning! Call endModel() in wrong order. endModel() was ignored.\n";
    return fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE;
  }
  if (model.num_tris == 0 && model.num_vertices == 0) {
    std::cerr << "BVH Error! endModel() called on model with no triangles and vertices.\n";
    return fcl::BVH_ERR_BUILD_EMPTY_MODEL;
  }
  if (model.num_tris == 0) makePoints(m);
  shrink(model.tri_indices, m.num_tris_allocated, model.num_tris);
  shrink(model.vertices, m.num_vertices_allocated, model.num_vertices);
  return fcl::BVH_OK;
}

template <typename S>
int beginUpdate(Members<S> m) {
  Model<S>& model = m.model;
  if (model.build_state != fcl::BVH_BUILD_STATE_PROCESSED &&
      model.build_state != fcl::BVH_BUILD_STATE_UPDATED) {
    std::cerr << "BVH Error! Call beginUpdatemodel() on a BVHModel that has no previous frame.\n";
    return fcl::BVH_ERR_BUILD_EMPTY_PREVIOUS_FRAME;
  }
  if (!model.prev_vertices) {
    try {
      // With vertices that stand still: what isn't given yet is asked for its box.
      replace(model.prev_vertices,
              copyOf(model.vertices, model.num_vertices, m.num_vertices_allocated));
    } catch (const std::bad_alloc&) {
      return outOfMemory("beginUpdateModel()");
    }
  }
  std::swap(model.vertices, model.prev_vertices);
  m.num_vertices_given = 0;
  model.build_state = fcl::BVH_BUILD_STATE_UPDATE_BEGUN;
  return fcl::BVH_OK;
}

}  // namespace
}  // namespace kios

namespace fcl {

// Explicit specialisations can't have the scalar as a parameter.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_SPECIALISE(S)                                                              \
  template <>                                                                           \
  BVHModel<kios::kIOS<S>>::BVHModel()                                                   \
      : vertices(nullptr),                                                              \
        tri_indices(nullptr),                                                           \
        prev_vertices(nullptr),                                                         \
        num_tris(0),                                                                    \
        num_vertices(0),                                                                \
        build_state(BVH_BUILD_STATE_EMPTY),                                             \
        bv_splitter(new detail::BVSplitter<kios::kIOS<S>>()),                           \
        bv_fitter(new detail::BVFitter<kios::kIOS<S>>()),                               \
        num_tris_allocated(0),                                                          \
        num_vertices_allocated(0),                                                      \
        num_bvs_allocated(0),                                                           \
        num_vertex_updated(0),                                                          \
        primitive_indices(nullptr),                                                     \
        bvs(kios::preparedForNone().detach()->nodes<S>()),                              \
        num_bvs(0) {}                                                                   \
  template <>                                                                           \
  BVHModel<kios::kIOS<S>>::BVHModel(const BVHModel& other)                              \
      : CollisionGeometry<S>(other),                                                    \
        vertices(nullptr),                                                              \
        tri_indices(nullptr),                                                           \
        prev_vertices(nullptr),                                                         \
        primitive_indices(nullptr),                                                     \
        bvs(kios::preparedForNone().detach()->nodes<S>()) {                             \
    kios::copy(other, other.num_vertex_updated, other.num_bvs, kios::membersOf(*this)); \
  }                                                                                     \
  template <>                                                                           \
  BVHModel<kios::kIOS<S>>::~BVHModel() {                                                \
    kios::clear(kios::membersOf(*this));                                                \
    const kios::PreparedHandle last(kios::Prepared::before<S>(bvs), false);             \
  }                                                                                     \
  template <>                                                                           \
  int BVHModel<kios::kIOS<S>>::beginModel(int num_tris_, int num_vertices_) {           \
    return kios::begin(kios::membersOf(*this), num_tris_, num_vertices_);               \
  }                                                                                     \
  template <>                                                                           \
  int BVHModel<kios::kIOS<S>>::endModel() {                                             \
    try {                                                                               \
      if (const int failed = kios::end(kios::membersOf(*this))) return failed;          \
      buildTree();                                                                      \
    } catch (const std::bad_alloc&) {                                                   \
      return kios::outOfMemory("endModel()");                                           \
    }                                                                                   \
    build_state = BVH_BUILD_STATE_PROCESSED;                                            \
    return BVH_OK;                                                                      \
  }                                                                                     \
  template <>                                                                           \
  int BVHModel<kios::kIOS<S>>::beginUpdateModel() {                                     \
    return kios::beginUpdate(kios::membersOf(*this));                                   \
  }
// NOLINTEND(bugprone-macro-parentheses)
KIOS_SPECIALISE(double)
KIOS_SPECIALISE(float)
#undef KIOS_SPECIALISE

}  // namespace fcl
