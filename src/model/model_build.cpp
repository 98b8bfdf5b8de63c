// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that build and refit trees over k-IOS.
#include <typeinfo>
#include <utility>

#include "build/mesh_tree.h"
#include "model/members.h"
#include "model/prepared.h"
#include "model/shared_volumes.h"
#include "model/stored_tree.h"
#include "model/tree_build.h"
#include "tree/tree_cache.h"
#include "volume/errors.h"
#include "volume/stamp.h"

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

/// `base` as the class that is asked for; nullptr if it is another one, derived ones included.
template <typename Class, typename Base>
const Class* exactly(const Base& base) {
  return typeid(base) == typeid(Class) ? static_cast<const Class*>(&base) : nullptr;
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

/// The steps of a TreeBuild by a fitter or a splitter of the user's. Our own need no virtual call.
template <typename S>
struct UsersSteps {
  const Set<FitterBase<S>> fitter;
  const Set<SplitterBase<S>> splitter;

  kIOS<S> fit(unsigned int* primitives, int n) { return (*fitter).fit(primitives, n); }
  void computeRule(const kIOS<S>& bv, unsigned int* primitives, int n) {
    (*splitter).computeRule(bv, primitives, n);
  }
  bool above(const fcl::Vector3<S>& q) const { return (*splitter).apply(q); }
};

/// FCL's recursion: the same tree, nodes in the same order.
template <typename S, typename Steps>
class RecursiveBuild {
 public:
  RecursiveBuild(const Members<S>& members, Steps& steps)
      : model_(members.model),
        primitives_(members.primitives),
        nodes_(members.nodes),
        steps_(steps) {}

  /// A user's fitter may return a volume that it keeps, with its stamp, so that the root is stamped
  /// anew.
  void run(int num_primitives) {
    divide(0, 0, num_primitives);
    nodes_[0].bv.stamp = nextStamp();
  }

 private:
  void divide(int node, int first, int n) {
    for (;;) {
      unsigned int* const primitives = primitives_ + first;
      fcl::BVNode<kIOS<S>>& at = nodes_[node];
      at.bv = steps_.fit(primitives, n);
      at.first_primitive = first;
      at.num_primitives = n;
      steps_.computeRule(at.bv, primitives, n);
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
      if (!steps_.above(centroid(primitives[i]))) std::swap(primitives[i], primitives[left++]);
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
  Steps& steps_;
  int num_nodes_ = 1;
};

/// Copies the volumes of an equal mesh that lives, or builds them for others to copy. False if that
/// can't be.
template <typename S>
bool buildShared(const Members<S>& m, const engine::MeshView<S>& mesh) {
  const engine::ContentHash content = engine::contentHash(mesh);
  if (copySharedVolumes<S>(content, mesh.num_triangles, {m.nodes, m.primitives})) {
    m.nodes[0].bv.stamp = nextStamp();
  } else if (!engine::buildVolumes<S>(mesh, m.nodes, m.primitives)) {
    return false;
  }
  shareVolumes(content, m.nodes, m.primitives);
  if (engine::SharedTree::isHeld(content)) treesOf(m.model)->budget.exhaust();
  return true;
}

/// The tree of the engine's own partition, which queries read. False where there is none.
template <typename S>
bool buildByCost(const Members<S>& m) {
  const engine::MeshView<S> mesh = viewOf(m.model);
  if (mesh.num_triangles == 0) return false;
  const bool built = m.model.num_tris < kLeastShared
                         ? engine::buildVolumes<S>(mesh, m.nodes, m.primitives)
                         : buildShared(m, mesh);
  if (built) treesOf(m.model)->noteBuilt(m.nodes[0].bv.stamp);
  return built;
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

/// Makes room for a tree over all primitives, where geometry was added since there was one.
template <typename S>
void makeRoom(const Members<S>& m) {
  releaseVolumes(m);
  m.num_nodes = 0;
  const int n = m.numNodes();
  if (n == 0) throw std::bad_alloc();
  if (n <= m.num_nodes_allocated) return;
  auto nodes = makeArray<fcl::BVNode<kIOS<S>>>(n);
  replace(m.primitives, makeArray<unsigned int>(m.numPrimitives()));
  replace(m.nodes, std::move(nodes));
  m.num_nodes_allocated = n;
}

/// Fills the tree, for which there is room.
template <typename S>
void build(const Members<S>& m) {
  Model<S>& model = m.model;
  if (StoredTree<S>::in(*model.bv_fitter)) {
    m.nodes[0].bv.stamp = nextStamp();
    return;
  }
  const fcl::BVHModelType type = model.getModelType();
  const int n = m.numPrimitives();
  for (int i = 0; i < n; ++i) m.primitives[i] = static_cast<unsigned int>(i);
  const auto* const own_fitter = exactly<Fitter<S>>(*model.bv_fitter);
  const auto* const own_splitter = exactly<Splitter<S>>(*model.bv_splitter);
  if (own_fitter && own_splitter) {
    if (own_splitter->byCost() && own_fitter->options().plain() && buildByCost(m)) return;
    TreeBuild<S> steps({model.vertices, nullptr, model.tri_indices, type}, own_fitter->options(),
                       own_splitter->method(), static_cast<std::size_t>(model.num_vertices));
    return RecursiveBuild<S, TreeBuild<S>>(m, steps).run(n);
  }
  UsersSteps<S> steps{
      Set<FitterBase<S>>(*model.bv_fitter, model.vertices, model.tri_indices, type),
      Set<SplitterBase<S>>(*model.bv_splitter, model.vertices, model.tri_indices, type)};
  RecursiveBuild<S, UsersSteps<S>>(m, steps).run(n);
}

template <typename S>
int buildTree(const Members<S>& m) {
  if (m.model.getModelType() == fcl::BVH_MODEL_UNKNOWN) return fcl::BVH_ERR_UNSUPPORTED_FUNCTION;
  requireIndices(m.model);
  makeRoom(m);
  build(m);
  m.num_nodes = m.numNodes();
  return fcl::BVH_OK;
}

template <typename S>
int refitTopDown(const Members<S>& m) {
  Model<S>& model = m.model;
  const fcl::BVHModelType type = model.getModelType();
  const auto refit = [&m](const auto& fit) {
    for (int i = 0; i < m.num_nodes; ++i) {
      fcl::BVNode<kIOS<S>>& node = m.nodes[i];
      node.bv = fit(m.primitives + node.first_primitive, node.num_primitives);
    }
  };
  if (const auto* const own = exactly<Fitter<S>>(*model.bv_fitter)) {
    TreeBuild<S> build({model.vertices, model.prev_vertices, model.tri_indices, type},
                       own->options(), fcl::detail::SPLIT_METHOD_MEAN,
                       static_cast<std::size_t>(model.num_vertices));
    refit([&](unsigned int* first, int n) { return build.fit(first, n); });
  } else {
    const Set<FitterBase<S>> set(*model.bv_fitter, model.vertices, model.prev_vertices,
                                 model.tri_indices, type);
    refit([&](unsigned int* first, int n) { return (*set).fit(first, n); });
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
    return kios::buildTree(KIOS_MEMBERS(S));                                  \
  }                                                                           \
  template <>                                                                 \
  int BVHModel<kios::kIOS<S>>::refitTree(bool bottomup) {                     \
    if (num_bvs != KIOS_MEMBERS(S).numNodes()) {                              \
      const int failed = buildTree();                                         \
      if (failed || !prev_vertices) return failed;                            \
    }                                                                         \
    kios::releaseVolumes(KIOS_MEMBERS(S));                                    \
    const int failed = bottomup ? refitTree_bottomup() : refitTree_topdown(); \
    bvs[0].bv.stamp = kios::nextStamp();                                      \
    return failed;                                                            \
  }                                                                           \
  template <>                                                                 \
  int BVHModel<kios::kIOS<S>>::refitTree_topdown() {                          \
    return kios::refitTopDown(KIOS_MEMBERS(S));                               \
  }
// NOLINTEND(bugprone-macro-parentheses)
KIOS_SPECIALISE(double)
KIOS_SPECIALISE(float)
#undef KIOS_SPECIALISE

}  // namespace fcl
