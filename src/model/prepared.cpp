// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/prepared.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fcl_kios/model.h"
#include "model/kios_model.h"
#include "search/search.h"
#include "tree/prepare.h"
#include "tree/refit.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/large_arrays.h"

namespace kios {
namespace {

/// Those that are found by their content. It is there only while it lists something, and nothing
/// here has a destructor: models may live longer than the library's static objects.
using Registry = std::unordered_map<engine::ContentHash, Prepared*, engine::HashOfContent>;
std::mutex mutex;  ///< also of Prepared's holders, listed and tree_is_shared
Registry* registry = nullptr;

/// The mutex must be locked.
void unlist(Prepared& prepared) {
  if (!std::exchange(prepared.listed, false)) return;
  registry->erase(prepared.content);
  if (registry->empty()) delete std::exchange(registry, nullptr);
}

Prepared* allocate(std::size_t bytes, int num_nodes) {
  auto* const prepared = new (::operator new(sizeof(Prepared) + bytes)) Prepared;
  prepared->num_nodes = num_nodes;
  preferHugePages(prepared + 1, bytes);
  return prepared;
}

/// True if floats hold a tree of content with this root volume in the model's units.
template <typename S>
bool hasRange(const kIOS<S>& root) {
  return double{root.radius0} >= engine::kLeastReach &&
         double{root.radius0} <= engine::kLargestReach;
}

}  // namespace

std::uint64_t nextGeneration() {
  static std::atomic<std::uint64_t> last{0};
  return 1 + last.fetch_add(1, std::memory_order_relaxed);
}

void intrusive_ptr_add_ref(Prepared* held) {
  const std::lock_guard<std::mutex> lock(mutex);
  ++held->holders;
}

void intrusive_ptr_release(Prepared* held) {
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (--held->holders > 0) return;
    unlist(*held);
  }
  held->~Prepared();
  ::operator delete(held);
}

// Never freed: models may live until the process ends.
PreparedHandle preparedForNone() {
  static Prepared* const none = allocate(0, 0);
  return none;
}

template <typename S>
PreparedHandle makePrepared(int num_nodes) {
  using Node = fcl::BVNode<kIOS<S>>;
  static_assert(std::is_trivially_destructible<Node>::value && alignof(Node) <= alignof(Prepared));
  const auto n = static_cast<std::size_t>(num_nodes);
  const std::size_t bytes = n * sizeof(Node) + (n + 1) / 2 * sizeof(unsigned int);
  return {allocate(bytes, num_nodes), /*add_ref=*/false};
}

PreparedHandle findPrepared(const engine::ContentHash& content) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!registry) return nullptr;
  const auto found = registry->find(content);
  if (found == registry->end()) return nullptr;
  ++found->second->holders;
  return {found->second, /*add_ref=*/false};
}

void list(PreparedHandle& held, const engine::ContentHash& content) {
  PreparedHandle equal;  // released when the mutex is
  const std::lock_guard<std::mutex> lock(mutex);
  auto made = registry ? nullptr : std::make_unique<Registry>();
  held->content = content;
  const auto [place, is_new] = (registry ? *registry : *made).emplace(content, held.get());
  if (made) registry = made.release();
  if (is_new) {
    held->listed = true;
    return;
  }
  ++place->second->holders;
  equal.swap(held);
  held.reset(place->second, /*add_ref=*/false);
}

template <typename S>
void own(PreparedHandle& held) {
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (held->holders == 1) return unlist(*held);
    held->tree_is_shared = true;
  }
  PreparedHandle copy = makePrepared<S>(held->num_nodes);
  const auto n = static_cast<std::size_t>(held->num_nodes);
  std::uninitialized_copy_n(held->nodes<S>(), n, copy->nodes<S>());
  std::copy_n(held->primitives<S>(), (n + 1) / 2, copy->primitives<S>());
  copy->tree = held->tree;
  copy->tree_is_shared = true;
  copy->attachment = held->attachment;
  copy->generation = held->generation;
  copy->ordinary = held->ordinary;
  held = std::move(copy);
}

template <typename S>
void prepareTree(const Model<S>& model, Prepared& prepared) {
  const auto* const nodes = prepared.nodes<S>();
  prepared.tree = nullptr;
  prepared.tree_is_shared = false;
  if (model.num_tris > 0) {
    const engine::MeshView<S> mesh = viewOf(model);
    const bool reads = prepared.ordinary && hasRange(nodes[0].bv);
    prepared.tree = reads ? engine::prepare(mesh, nodes) : engine::prepare(mesh);
    // Our fitter refuses such vertices; a user's may not.
    if (!prepared.tree) refuse("a vertex of the mesh is not finite.");
  }
  prepared.generation = nextGeneration();
}

template <typename S>
void refitTreeOf(const Model<S>& model, Prepared& prepared) {
  prepared.ordinary = false;
  std::shared_ptr<engine::Tree>& tree = prepared.tree;
  const bool moves = tree && tree->exponent == 0 && hasRange(prepared.nodes<S>()[0].bv);
  if (moves && prepared.tree_is_shared) {
    tree = std::make_shared<engine::Tree>(*tree);
    prepared.tree_is_shared = false;
  }
  if (moves && engine::refit(viewOf(model), *tree)) {
    prepared.generation = nextGeneration();
  } else {
    prepareTree(model, prepared);
  }
  if (prepared.attachment) {
    prepared.attachment = renewed(*prepared.attachment, model, prepared);
  }
}

template <typename S>
void prepare(const Model<S>& model) {
  requireFinished(model);
}

template <typename S>
std::size_t preparedBytes(const Model<S>& model) {
  const engine::Tree* const tree = preparedOf(model).tree.get();
  return tree ? tree->bytes() : 0;
}

template <typename S>
void verticesChanged(Model<S>& model) {
  validate(model);
  // Unfinished until the end, which may not come where memory runs out.
  const fcl::BVHBuildState finished =
      std::exchange(model.build_state, fcl::BVH_BUILD_STATE_REPLACE_BEGUN);
  fcl::MakeParentRelativeRecurseImpl<S, kIOS<S>>::refit(model);
  model.build_state = finished;
}

const char* simdTarget() { return engine::kernels().target; }

KIOS_INSTANTIATE_FUNCTION(makePrepared);
KIOS_INSTANTIATE_FUNCTION(own);
KIOS_INSTANTIATE_FUNCTION(prepareTree);
KIOS_INSTANTIATE_FUNCTION(refitTreeOf);
KIOS_INSTANTIATE_FUNCTION(prepare);
KIOS_INSTANTIATE_FUNCTION(preparedBytes);
KIOS_INSTANTIATE_FUNCTION(verticesChanged);

}  // namespace kios
