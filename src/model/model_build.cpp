// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that build and refit trees over k-IOS.
#include <memory>
#include <new>
#include <numeric>
#include <typeinfo>
#include <utility>

#include "build/mesh_tree.h"
#include "model/members.h"
#include "model/prepared.h"
#include "volume/errors.h"

namespace kios {
namespace {

template <typename S>
using Fitter = fcl::detail::BVFitter<kIOS<S>>;
template <typename S>
using Splitter = fcl::detail::BVSplitter<kIOS<S>>;

/// True for the class that is asked for, not for another one, derived ones included.
template <typename Class, typename Base>
bool isExactly(const Base& base) {
  return typeid(base) == typeid(Class);
}

/// Sets a fitter or a splitter, which is cleared also where a build is given up.
template <typename FitterOrSplitter, typename... Args>
auto setFor(FitterOrSplitter& of, Args... args) {
  of.set(args...);
  const auto clear = [](FitterOrSplitter* set) { set->clear(); };
  return std::unique_ptr<FitterOrSplitter, decltype(clear)>(&of, clear);
}

/// FCL's recursion by the model's fitter and splitter: recurse(n) over n primitives.
template <typename S, typename Recurse>
void buildByRecursion(const Members<S>& m, const Recurse& recurse) {
  const Model<S>& model = m.model;
  const std::shared_ptr<const Attachment> attachment = m.prepared().attachment;
  PreparedHandle made = makePrepared<S>(m.numNodes());
  std::uninitialized_default_construct_n(made->template nodes<S>(), m.numNodes());
  made->attachment = attachment;  // stays if the build fails
  m.take(std::move(made));
  m.num_nodes = 0;
  const auto fitter =
      setFor(*model.bv_fitter, model.vertices, model.tri_indices, model.getModelType());
  const auto splitter =
      setFor(*model.bv_splitter, model.vertices, model.tri_indices, model.getModelType());
  std::iota(m.primitives, m.primitives + m.numPrimitives(), 0U);
  try {
    m.num_nodes = 1;  // FCL counts on
    recurse(m.numPrimitives());
    prepareTree(model, m.prepared());
    if (attachment) m.prepared().attachment = renewed(*attachment, model, m.prepared());
  } catch (...) {
    m.num_nodes = 0;
    throw;
  }
}

/// The tree of the engine's own partition, which prepareTree() reads, or that of an equal mesh.
/// What has an attachment shares with none. Nothing where there is no such tree.
template <typename S>
PreparedHandle buildByCost(const Members<S>& m) {
  const engine::MeshView<S> mesh = viewOf(m.model);
  if (mesh.num_triangles == 0) return nullptr;
  constexpr std::size_t kLeastShared = 4;  // fewer are built as soon as others would be found
  const bool shares = mesh.num_triangles >= kLeastShared && !m.prepared().attachment;
  engine::ContentHash content;
  if (shares) {
    content = engine::contentHash(mesh);
    if (PreparedHandle equal = findPrepared(content)) return equal;
  }
  PreparedHandle made = makePrepared<S>(m.numNodes());
  made->ordinary =
      engine::buildVolumes<S>(mesh, made->template nodes<S>(), made->template primitives<S>());
  if (!made->ordinary) return nullptr;
  prepareTree(m.model, *made.get());
  if (shares) list(made, content);
  return made;
}

template <typename S, typename Recurse>
int buildTree(const Members<S>& m, const Recurse& recurse) {
  const Model<S>& model = m.model;
  if (model.getModelType() == fcl::BVH_MODEL_UNKNOWN) return fcl::BVH_ERR_UNSUPPORTED_FUNCTION;
  requireIndices(model.tri_indices, static_cast<std::size_t>(model.num_tris),
                 static_cast<std::size_t>(model.num_vertices));
  m.num_nodes = 0;
  if (m.numNodes() == 0) throw std::bad_alloc();
  const bool by_cost = isExactly<Fitter<S>>(*model.bv_fitter) &&
                       isExactly<Splitter<S>>(*model.bv_splitter) &&
                       static_cast<const Splitter<S>&>(*model.bv_splitter).byCost();
  if (PreparedHandle made = by_cost ? buildByCost(m) : nullptr) {
    const auto& attachment = m.prepared().attachment;
    if (attachment) made->attachment = renewed(*attachment, model, *made.get());
    m.take(std::move(made));
  } else {
    buildByRecursion(m, recurse);
  }
  return fcl::BVH_OK;
}

template <typename S>
int refitTopDown(const Members<S>& m) {
  Model<S>& model = m.model;
  const auto fitter = setFor(*model.bv_fitter, model.vertices, model.prev_vertices,
                             model.tri_indices, model.getModelType());
  for (int i = 0; i < m.num_nodes; ++i) {
    fcl::BVNode<kIOS<S>>& node = m.nodes[i];
    node.bv = fitter->fit(m.primitives + node.first_primitive, node.num_primitives);
  }
  return fcl::BVH_OK;
}

}  // namespace
}  // namespace kios

namespace fcl {

// A scalar can't be a parameter of explicit specialisations. A tree has no nodes until it is whole.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_SPECIALISE(S)                                                    \
  template <>                                                                 \
  int BVHModel<kios::kIOS<S>>::buildTree() {                                  \
    return kios::buildTree(kios::membersOf(*this),                            \
                           [this](int n) { recursiveBuildTree(0, 0, n); });   \
  }                                                                           \
  template <>                                                                 \
  int BVHModel<kios::kIOS<S>>::refitTree(bool bottomup) {                     \
    if (num_bvs != kios::membersOf(*this).numNodes()) {                       \
      const int failed = buildTree();                                         \
      if (failed || !prev_vertices) return failed;                            \
    }                                                                         \
    kios::membersOf(*this).own();                                             \
    const int failed = bottomup ? refitTree_bottomup() : refitTree_topdown(); \
    kios::refitTreeOf(*this, kios::membersOf(*this).prepared());              \
    return failed;                                                            \
  }                                                                           \
  template <>                                                                 \
  int BVHModel<kios::kIOS<S>>::refitTree_topdown() {                          \
    return kios::refitTopDown(kios::membersOf(*this));                        \
  }
// NOLINTEND(bugprone-macro-parentheses)
KIOS_SPECIALISE(double)
KIOS_SPECIALISE(float)
#undef KIOS_SPECIALISE

}  // namespace fcl
