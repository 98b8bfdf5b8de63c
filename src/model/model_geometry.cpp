// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that take vertices and triangles, for models over k-IOS. FCL's own
// write past their arrays where they are given too many, or in another state than they expect.
#include <array>
#include <iostream>
#include <new>

#include "model/members.h"

namespace kios {
namespace {

/// More of an array's elements, or none.
template <typename T>
struct Span {
  const T* first = nullptr;
  std::size_t count = 0;
};
template <typename T>
Span<T> all(const std::vector<T>& v) {
  return {v.data(), v.size()};
}

int outOfSequence(const char* call, const char* must) {
  std::cerr << "BVH Warning! Call " << call << " in a wrong order. " << call << " was ignored. "
            << must << "\n";
  return fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE;
}

/// True if the model's triangles are its vertices: it was built of these alone.
template <typename S>
bool isCloud(const Model<S>& model) {
  const engine::MeshView<S> mesh = viewOf(model);
  for (std::size_t i = 0; i < mesh.num_triangles; ++i) {
    if (mesh.index(i, 0) != i || mesh.index(i, 1) != i || mesh.index(i, 2) != i) return false;
  }
  return model.num_tris > 0 && model.num_tris == model.num_vertices;
}

/// The room of an array that is to take `more` elements, at least doubled where it must grow, so
/// that elements added one by one cost O(1); -1 if FCL's nodes can't count so many.
int roomFor(int n, std::size_t more, int room) {
  constexpr int kMost = std::numeric_limits<int>::max();
  if (more > static_cast<std::size_t>(kMost - n)) return -1;
  const int needed = n + static_cast<int>(more);
  if (needed <= room) return room;
  return std::max(needed, room > kMost / 2 ? kMost : 2 * room);
}

template <typename S>
int add(Members<S> m, const char* call, Span<fcl::Vector3<S>> vertices,
        Span<fcl::Triangle> triangles) {
  Model<S>& model = m.model;
  if (model.build_state == fcl::BVH_BUILD_STATE_PROCESSED ||
      model.build_state == fcl::BVH_BUILD_STATE_EMPTY) {
    return outOfSequence(call, "Must do a beginModel() that returns 0 before geometry is added.");
  }
  const bool points = triangles.count == 0 && isCloud(model);
  const int vertex_room = roomFor(model.num_vertices, vertices.count, m.num_vertices_allocated),
            tri_room = roomFor(model.num_tris, points ? vertices.count : triangles.count,
                               m.num_tris_allocated);
  if (vertex_room < 0 || tri_room < 0) return outOfMemory(call);
  try {
    // All are made before one is replaced, so that the call may be repeated.
    std::unique_ptr<fcl::Vector3<S>[]> grown, grown_prev;
    std::unique_ptr<fcl::Triangle[]> grown_tris;
    if (vertex_room > m.num_vertices_allocated || !model.vertices) {
      grown = makeArray<fcl::Vector3<S>>(vertex_room);
      grown_prev = copyOf(model.prev_vertices, model.num_vertices, vertex_room);
    }
    if (tri_room > m.num_tris_allocated) grown_tris = makeArray<fcl::Triangle>(tri_room);
    if (grown) {
      if (model.vertices) std::copy_n(model.vertices, model.num_vertices, grown.get());
      replace(model.vertices, std::move(grown));
      if (grown_prev) replace(model.prev_vertices, std::move(grown_prev));
      m.num_vertices_allocated = vertex_room;
    }
    if (grown_tris) {
      if (model.tri_indices) std::copy_n(model.tri_indices, model.num_tris, grown_tris.get());
      replace(model.tri_indices, std::move(grown_tris));
      m.num_tris_allocated = tri_room;
    }
  } catch (const std::bad_alloc&) {
    return outOfMemory(call);
  }
  m.num_nodes = 0;  // the tree is one of fewer primitives
  const auto offset = static_cast<std::size_t>(model.num_vertices);
  std::copy_n(vertices.first, vertices.count, model.vertices + offset);
  if (model.prev_vertices) {  // what is new stood still
    std::copy_n(vertices.first, vertices.count, model.prev_vertices + offset);
  }
  model.num_vertices += static_cast<int>(vertices.count);
  // An index that no array has stays so, and the build refuses it.
  const auto shifted = [offset](std::size_t i) {
    return i > ~offset ? ~std::size_t{0} : i + offset;
  };
  for (std::size_t i = 0; i < triangles.count; ++i) {
    const fcl::Triangle& t = triangles.first[i];
    model.tri_indices[model.num_tris++].set(shifted(t[0]), shifted(t[1]), shifted(t[2]));
  }
  for (std::size_t i = offset; points && i < offset + vertices.count; ++i) {
    model.tri_indices[model.num_tris++].set(i, i, i);
  }
  return fcl::BVH_OK;
}

/// The next vertices of a model that is replaced or updated.
template <typename S>
int give(Members<S> m, fcl::BVHBuildState during, const char* call,
         Span<fcl::Vector3<S>> vertices) {
  Model<S>& model = m.model;
  if (model.build_state != during) {
    return outOfSequence(call, during == fcl::BVH_BUILD_STATE_REPLACE_BEGUN
                                   ? "Must do a beginReplaceModel() for initialization."
                                   : "Must do a beginUpdateModel() for initialization.");
  }
  if (vertices.count > static_cast<std::size_t>(model.num_vertices - m.num_vertices_given)) {
    std::cerr << "BVH Error! " << call << " was ignored: the model has " << model.num_vertices
              << " vertices, of which " << m.num_vertices_given << " were given already, and "
              << vertices.count << " more are too many.\n";
    return fcl::BVH_ERR_INCORRECT_DATA;
  }
  std::copy_n(vertices.first, vertices.count, model.vertices + m.num_vertices_given);
  m.num_vertices_given += static_cast<int>(vertices.count);
  return fcl::BVH_OK;
}

/// A triangle's corners.
template <typename S>
using Corners = std::array<fcl::Vector3<S>, 3>;

template <typename S>
int addTriangle(Members<S> m, const Corners<S>& corners) {
  const fcl::Triangle triangle(0, 1, 2);
  return add<S>(m, "addTriangle()", {corners.data(), corners.size()}, {&triangle, 1});
}

template <typename S>
int addVertex(Members<S> m, const fcl::Vector3<S>& p) {
  if (m.model.build_state != fcl::BVH_BUILD_STATE_BEGUN) {
    return outOfSequence("addVertex()", "Must do a beginModel() that returns 0 before.");
  }
  const fcl::Vector3<S> vertex = p;  // it may be one of the model's own, which move
  return add<S>(m, "addVertex()", {&vertex, 1}, {});
}

}  // namespace
}  // namespace kios

namespace fcl {

// Explicit specialisations can't have the scalar as a parameter.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_SPECIALISE_GIVE(S, verb, STATE)                                                      \
  template <>                                                                                     \
  int BVHModel<kios::kIOS<S>>::verb##Vertex(const Vector3<S>& p) {                                \
    return kios::give<S>(kios::membersOf(*this), STATE, #verb "Vertex()", {&p, 1});               \
  }                                                                                               \
  template <>                                                                                     \
  int BVHModel<kios::kIOS<S>>::verb##Triangle(const Vector3<S>& p1, const Vector3<S>& p2,         \
                                              const Vector3<S>& p3) {                             \
    const kios::Corners<S> corners = {p1, p2, p3};                                                \
    return kios::give<S>(kios::membersOf(*this), STATE, #verb "Triangle()", {corners.data(), 3}); \
  }                                                                                               \
  template <>                                                                                     \
  int BVHModel<kios::kIOS<S>>::verb##SubModel(const std::vector<Vector3<S>>& ps) {                \
    return kios::give<S>(kios::membersOf(*this), STATE, #verb "SubModel()", kios::all(ps));       \
  }
#define KIOS_SPECIALISE(S)                                                                      \
  template <>                                                                                   \
  int BVHModel<kios::kIOS<S>>::addVertex(const Vector3<S>& p) {                                 \
    return kios::addVertex<S>(kios::membersOf(*this), p);                                       \
  }                                                                                             \
  template <>                                                                                   \
  int BVHModel<kios::kIOS<S>>::addTriangle(const Vector3<S>& p1, const Vector3<S>& p2,          \
                                           const Vector3<S>& p3) {                              \
    return kios::addTriangle<S>(kios::membersOf(*this), {p1, p2, p3});                          \
  }                                                                                             \
  template <>                                                                                   \
  int BVHModel<kios::kIOS<S>>::addSubModel(const std::vector<Vector3<S>>& ps) {                 \
    return kios::add<S>(kios::membersOf(*this), "addSubModel()", kios::all(ps), {});            \
  }                                                                                             \
  template <>                                                                                   \
  int BVHModel<kios::kIOS<S>>::addSubModel(const std::vector<Vector3<S>>& ps,                   \
                                           const std::vector<Triangle>& ts) {                   \
    return kios::add<S>(kios::membersOf(*this), "addSubModel()", kios::all(ps), kios::all(ts)); \
  }                                                                                             \
  KIOS_SPECIALISE_GIVE(S, replace, BVH_BUILD_STATE_REPLACE_BEGUN)                               \
  KIOS_SPECIALISE_GIVE(S, update, BVH_BUILD_STATE_UPDATE_BEGUN)
// NOLINTEND(bugprone-macro-parentheses)
KIOS_SPECIALISE(double)
KIOS_SPECIALISE(float)
#undef KIOS_SPECIALISE
#undef KIOS_SPECIALISE_GIVE

}  // namespace fcl
