// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The members of fcl::BVHModel that build and refit trees over k-IOS.
#include <stdexcept>
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

/// A model's arrays.
template <typename S>
struct Arrays {
  fcl::Vector3<S>*vertices, *prev_vertices;
  fcl::Triangle* triangles;
  fcl::BVHModelType type;
  int num_vertices;
  unsigned int* primitives;
  fcl::BVNode<kIOS<S>>* nodes;

  TreeBuild<S> build() const {
    return TreeBuild<S>({vertices, prev_vertices, triangles, type},
                        static_cast<std::size_t>(num_vertices));
  }
};

/// The steps of a build by our own fitter and splitter, which need no virtual call.
template <typename S>
struct OwnSteps {
  TreeBuild<S> build;
  const FitOptions options;
  const fcl::detail::SplitMethodType method;

  kIOS<S> fit(unsigned int* primitives, int n) { return build.fit(primitives, n, options); }
  void computeRule(const kIOS<S>& /*bv*/, unsigned int* primitives, int n) {
    build.computeRule(primitives, n, method);
  }
  bool above(const fcl::Vector3<S>& q) const { return build.above(q); }
};

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

/// The steps by a fitter or a splitter of the user's.
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
  RecursiveBuild(const Arrays<S>& model, Steps& steps) : model_(model), steps_(steps) {}

  /// Returns the number of nodes. A user's fitter may return a volume that it keeps, with its
  /// stamp, so that the root is stamped anew.
  int run(int num_primitives) {
    divide(0, 0, num_primitives);
    model_.nodes[0].bv.stamp = nextStamp();
    return num_nodes_;
  }

 private:
  void divide(int node, int first, int n) {
    for (;;) {
      unsigned int* const primitives = model_.primitives + first;
      fcl::BVNode<kIOS<S>>& at = model_.nodes[node];
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
    if (model_.type == fcl::BVH_MODEL_POINTCLOUD) return model_.vertices[primitive];
    const fcl::Triangle& t = model_.triangles[primitive];
    return (model_.vertices[t[0]] + model_.vertices[t[1]] + model_.vertices[t[2]]) / S(3);
  }

  const Arrays<S> model_;
  Steps& steps_;
  int num_nodes_ = 1;
};

/// The tree of the engine's own partition, which queries read: a copy where an equal mesh lives.
/// False where there is none.
template <typename S>
bool buildByCost(const Arrays<S>& model, int num_triangles, engine::TreeCache& trees) {
  if (model.type != fcl::BVH_MODEL_TRIANGLES) return false;
  const auto n = static_cast<std::size_t>(num_triangles);
  const engine::MeshView<S> mesh = {model.vertices, static_cast<std::size_t>(model.num_vertices),
                                    model.triangles, n};
  const engine::ContentHash content = engine::contentHash(mesh);
  if (copySharedVolumes<S>(content, n, {model.nodes, model.primitives})) {
    model.nodes[0].bv.stamp = nextStamp();
  } else if (!engine::buildVolumes<S>(mesh, model.nodes, model.primitives)) {
    return false;
  }
  shareVolumes(content, model.nodes, model.primitives);
  trees.noteBuilt(model.nodes[0].bv.stamp);
  if (engine::SharedTree::isHeld(content)) trees.budget.exhaust();
  return true;
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
  releaseVolumes(m.nodes);
  m.num_nodes = 0;
  const int n = m.numNodes();
  if (n == 0) throw std::bad_alloc();
  if (n <= m.num_nodes_allocated) return;
  auto nodes = makeArray<fcl::BVNode<kIOS<S>>>(n);
  replace(m.primitives, makeArray<unsigned int>(m.numPrimitives()));
  replace(m.nodes, std::move(nodes));
  m.num_nodes_allocated = n;
}

template <typename S>
int build(const Arrays<S>& model, int num_primitives, FitterBase<S>& fitter,
          SplitterBase<S>& splitter, engine::TreeCache* trees) {
  if (StoredTree<S>::in(fitter)) {
    model.nodes[0].bv.stamp = nextStamp();
    return 2 * num_primitives - 1;
  }
  for (int i = 0; i < num_primitives; ++i) model.primitives[i] = static_cast<unsigned int>(i);
  const auto* const own_fitter = exactly<Fitter<S>>(fitter);
  const auto* const own_splitter = exactly<Splitter<S>>(splitter);
  if (own_fitter && own_splitter) {
    if (own_splitter->byCost() && own_fitter->options().plain() &&
        buildByCost(model, num_primitives, *trees)) {
      return 2 * num_primitives - 1;
    }
    OwnSteps<S> steps{model.build(), own_fitter->options(), own_splitter->method()};
    return RecursiveBuild<S, OwnSteps<S>>(model, steps).run(num_primitives);
  }
  UsersSteps<S> steps{Set<FitterBase<S>>(fitter, model.vertices, model.triangles, model.type),
                      Set<SplitterBase<S>>(splitter, model.vertices, model.triangles, model.type)};
  return RecursiveBuild<S, UsersSteps<S>>(model, steps).run(num_primitives);
}

template <typename S>
void refitTopDown(const Arrays<S>& model, int num_nodes, FitterBase<S>& fitter) {
  const auto refit = [&](const auto& fit) {
    for (int i = 0; i < num_nodes; ++i) {
      fcl::BVNode<kIOS<S>>& node = model.nodes[i];
      node.bv = fit(model.primitives + node.first_primitive, node.num_primitives);
    }
  };
  if (const auto* const own = exactly<Fitter<S>>(fitter)) {
    TreeBuild<S> build = model.build();
    refit([&](unsigned int* first, int n) { return build.fit(first, n, own->options()); });
    return;
  }
  const Set<FitterBase<S>> set(fitter, model.vertices, model.prev_vertices, model.triangles,
                               model.type);
  refit([&](unsigned int* first, int n) { return (*set).fit(first, n); });
}

}  // namespace
}  // namespace kios

namespace fcl {

// A scalar can't be a parameter of explicit specialisations. A tree has no nodes until it is whole.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_SPECIALISE(S)                                                                     \
  template <>                                                                                  \
  int BVHModel<kios::kIOS<S>>::buildTree() {                                                   \
    const BVHModelType type = getModelType();                                                  \
    if (type == BVH_MODEL_UNKNOWN) return BVH_ERR_UNSUPPORTED_FUNCTION;                        \
    kios::requireIndices<S>(*this);                                                            \
    kios::makeRoom(KIOS_MEMBERS(S));                                                           \
    num_bvs = kios::build<S>(                                                                  \
        {vertices, nullptr, tri_indices, type, num_vertices, primitive_indices, bvs},          \
        type == BVH_MODEL_TRIANGLES ? num_tris : num_vertices, *bv_fitter, *bv_splitter,       \
        kios::treesOf(*this));                                                                 \
    return BVH_OK;                                                                             \
  }                                                                                            \
  template <>                                                                                  \
  int BVHModel<kios::kIOS<S>>::refitTree(bool bottomup) {                                      \
    if (num_bvs != KIOS_MEMBERS(S).numNodes()) {                                               \
      const int failed = buildTree();                                                          \
      if (failed || !prev_vertices) return failed;                                             \
    }                                                                                          \
    kios::releaseVolumes(bvs);                                                                 \
    const int failed = bottomup ? refitTree_bottomup() : refitTree_topdown();                  \
    bvs[0].bv.stamp = kios::nextStamp();                                                       \
    return failed;                                                                             \
  }                                                                                            \
  template <>                                                                                  \
  int BVHModel<kios::kIOS<S>>::refitTree_topdown() {                                           \
    kios::refitTopDown<S>({vertices, prev_vertices, tri_indices, getModelType(), num_vertices, \
                           primitive_indices, bvs},                                            \
                          num_bvs, *bv_fitter);                                                \
    return BVH_OK;                                                                             \
  }
// NOLINTEND(bugprone-macro-parentheses)
KIOS_SPECIALISE(double)
KIOS_SPECIALISE(float)
#undef KIOS_SPECIALISE

}  // namespace fcl
