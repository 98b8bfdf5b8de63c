// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that build and refit trees over k-IOS.
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
using FitterBase = fcl::detail::BVFitterBase<kIOS<S>>;
template <typename S>
using SplitterBase = fcl::detail::BVSplitterBase<kIOS<S>>;
template <typename S>
using Fitter = fcl::detail::BVFitter<kIOS<S>>;
template <typename S>
using Splitter = fcl::detail::BVSplitter<kIOS<S>>;

/// True for the class that is asked for, not for another one, derived ones included.
template <typename Class, typename Base>
bool isExactly(const Base& base) {
  return typeid(base) == typeid(Class);
}

/// A fitter or a splitter between its set() and its clear(), which comes also where a build is
/// given up.
template <typename FitterOrSplitter>
class Set {
 public:
  template <typename... Args>
  explicit Set(FitterOrSplitter& of, Args... args) : of_(of) {
    of.set(args...);
  }
  Set(const Set&) = delete;
  ~Set() { of_.clear(); }

  FitterOrSplitter& operator*() const { return of_; }

 private:
  FitterOrSplitter& of_;
};

/// FCL's recursion by the model's fitter and splitter: the same tree, nodes in the same order.
template <typename S>
class RecursiveBuild {
 public:
  RecursiveBuild(const Model<S>& model, Prepared& made)
      : model_(model),
        primitives_(made.primitives<S>()),
        nodes_(made.nodes<S>()),
        fitter_(*model.bv_fitter, model.vertices, model.tri_indices, model.getModelType()),
        splitter_(*model.bv_splitter, model.vertices, model.tri_indices, model.getModelType()) {}

  void run(int num_primitives) {
    std::iota(primitives_, primitives_ + num_primitives, 0U);
    divide(0, 0, num_primitives);
  }

 private:
  void divide(int node, int first, int n) {
    for (;;) {
      unsigned int* const primitives = primitives_ + first;
      fcl::BVNode<kIOS<S>>& at = nodes_[node];
      at.bv = (*fitter_).fit(primitives, n);
      at.first_primitive = first;
      at.num_primitives = n;
      (*splitter_).computeRule(at.bv, primitives, n);
      if (n == 1) {
        at.first_child = -(static_cast<int>(primitives[0]) + 1);
        return;
      }
      const int left = num_nodes_;
      at.first_child = left;
      num_nodes_ += 2;
      const int left_count = partition(primitives, n);
      divide(left, first, left_count);
      node = left + 1;
      first += left_count;
      n -= left_count;
    }
  }

  /// Orders the primitives; returns how many go left, by halves if a side would be empty.
  int partition(unsigned int* primitives, int n) const {
    int left = 0;
    for (int i = 0; i < n; ++i) {
      if (!(*splitter_).apply(centroid(primitives[i])))
        std::swap(primitives[i], primitives[left++]);
    }
    return left == 0 || left == n ? n / 2 : left;
  }

  fcl::Vector3<S> centroid(unsigned int primitive) const {
    if (model_.num_tris == 0) return model_.vertices[primitive];
    const fcl::Triangle& t = model_.tri_indices[primitive];
    return (model_.vertices[t[0]] + model_.vertices[t[1]] + model_.vertices[t[2]]) / S(3);
  }

  const Model<S>& model_;
  unsigned int* const primitives_;
  fcl::BVNode<kIOS<S>>* const nodes_;
  const Set<FitterBase<S>> fitter_;
  const Set<SplitterBase<S>> splitter_;
  int num_nodes_ = 1;
};

/// The tree of the engine's own partition, which prepareTree() reads, or that of an equal mesh.
/// What has an attachment shares with none. Nothing where there is no such tree.
template <typename S>
PreparedHandle buildByCost(const Members<S>& m) {
  const engine::MeshView<S> mesh = viewOf(m.model);
  if (mesh.num_triangles == 0) return PreparedHandle(nullptr);
  constexpr std::size_t kLeastShared = 4;  // fewer are built as soon as others would be found
  const bool shares = mesh.num_triangles >= kLeastShared && !m.prepared().attachment;
  engine::ContentHash content;
  if (shares) {
    content = engine::contentHash(mesh);
    if (PreparedHandle equal = PreparedHandle::find(content)) return equal;
  }
  PreparedHandle made = PreparedHandle::make<S>(m.numNodes());
  made->ordinary =
      engine::buildVolumes<S>(mesh, made->template nodes<S>(), made->template primitives<S>());
  if (!made->ordinary) return PreparedHandle(nullptr);
  prepareTree(m.model, *made.get());
  if (shares) made.list(content);
  return made;
}

/// FCL's calls take any index, and its build reads what that refers to.
template <typename S>
void requireIndices(const Model<S>& model) {
  const auto end = static_cast<std::size_t>(model.num_vertices);
  const engine::MeshView<S> mesh = viewOf(model);
  for (int i = 0; i < model.num_tris; ++i) {
    const std::size_t largest = std::max({mesh.index(i, 0), mesh.index(i, 1), mesh.index(i, 2)});
    if (largest < end) continue;
    refuse("triangle ", i, " refers to vertex ", largest, ", but there are ", end,
           "; build the model anew from beginModel().");
  }
}

template <typename S>
int buildTree(const Members<S>& m) {
  const Model<S>& model = m.model;
  if (model.getModelType() == fcl::BVH_MODEL_UNKNOWN) return fcl::BVH_ERR_UNSUPPORTED_FUNCTION;
  requireIndices(model);
  m.num_nodes = 0;
  if (m.numNodes() == 0) throw std::bad_alloc();
  const bool by_cost = isExactly<Fitter<S>>(*model.bv_fitter) &&
                       isExactly<Splitter<S>>(*model.bv_splitter) &&
                       static_cast<const Splitter<S>&>(*model.bv_splitter).byCost();
  PreparedHandle made = by_cost ? buildByCost(m) : PreparedHandle(nullptr);
  if (!made) {
    made = PreparedHandle::make<S>(m.numNodes());
    RecursiveBuild<S>(model, *made.get()).run(m.numPrimitives());
    prepareTree(model, *made.get());
  }
  const auto& attachment = m.prepared().attachment;
  if (attachment) made->attachment = attachment->renewed(&model);
  m.take(std::move(made));
  return fcl::BVH_OK;
}

template <typename S>
int refitTopDown(const Members<S>& m) {
  Model<S>& model = m.model;
  const Set<FitterBase<S>> fitter(*model.bv_fitter, model.vertices, model.prev_vertices,
                                  model.tri_indices, model.getModelType());
  for (int i = 0; i < m.num_nodes; ++i) {
    fcl::BVNode<kIOS<S>>& node = m.nodes[i];
    node.bv = (*fitter).fit(m.primitives + node.first_primitive, node.num_primitives);
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
    return kios::buildTree(kios::membersOf(*this));                           \
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
