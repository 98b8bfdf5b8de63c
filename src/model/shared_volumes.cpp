// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/shared_volumes.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>
#include <shared_mutex>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace kios {
namespace {

using engine::ContentHash;

struct Entry {
  Entry(const ContentHash& c, const void* n, const void* p) : content(c), nodes(n), primitives(p) {}

  const ContentHash content;
  const void *const nodes, *const primitives;
  std::shared_mutex reading;  ///< held while nodes and primitives are copied
  bool released = false;      ///< guarded by `reading`
};

struct Registry {
  std::unordered_map<const void*, std::shared_ptr<Entry>> by_nodes;
  /// The nodes of equal content.
  std::unordered_map<ContentHash, std::unordered_set<const void*>, engine::HashOfContent>
      by_content;
};

// Neither has a destructor, and the registry is there only while something is shared: models may
// live longer than the library's static objects.
std::mutex mutex;
Registry* registry = nullptr;

std::shared_ptr<Entry> find(const ContentHash& content) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!registry) return nullptr;
  const auto found = registry->by_content.find(content);
  return found == registry->by_content.end() ? nullptr
                                             : registry->by_nodes.at(*found->second.begin());
}

/// The mutex must be locked.
void closeIfEmpty() {
  if (registry->by_nodes.empty()) delete std::exchange(registry, nullptr);
}

/// The mutex must be locked. Enters nothing where there is no memory.
void list(const ContentHash& content, const void* nodes, const void* primitives) {
  try {
    if (!registry) registry = new Registry;
    const auto entry = std::make_shared<Entry>(content, nodes, primitives);
    if (!registry->by_nodes.emplace(nodes, entry).second) return;  // these are shared already
    registry->by_content[content].insert(nodes);
  } catch (const std::bad_alloc&) {
    if (!registry) return;
    registry->by_nodes.erase(nodes);
    const auto equal = registry->by_content.find(content);
    if (equal != registry->by_content.end() && equal->second.empty()) {
      registry->by_content.erase(equal);
    }
    closeIfEmpty();
  }
}

/// The mutex must be locked.
std::shared_ptr<Entry> unlist(const void* nodes) {
  const auto found = registry->by_nodes.find(nodes);
  if (found == registry->by_nodes.end()) return nullptr;
  std::shared_ptr<Entry> entry = std::move(found->second);
  registry->by_nodes.erase(found);
  const auto equal = registry->by_content.find(entry->content);
  equal->second.erase(nodes);
  if (equal->second.empty()) registry->by_content.erase(equal);
  closeIfEmpty();
  return entry;
}

}  // namespace

template <typename S>
bool copySharedVolumes(const ContentHash& content, std::size_t n, const TreeArrays<S>& to) {
  const std::shared_ptr<Entry> entry = find(content);
  if (!entry) return false;
  const std::shared_lock<std::shared_mutex> lock(entry->reading);
  if (entry->released) return false;
  std::copy_n(static_cast<const fcl::BVNode<kIOS<S>>*>(entry->nodes), 2 * n - 1, to.nodes);
  std::copy_n(static_cast<const unsigned int*>(entry->primitives), n, to.primitives);
  return true;
}

void shareVolumes(const ContentHash& content, const void* nodes, const void* primitives) {
  const std::lock_guard<std::mutex> lock(mutex);
  list(content, nodes, primitives);
}

void shareCopy(const void* nodes, const void* copied_nodes, const void* copied_primitives) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!registry) return;
  const auto found = registry->by_nodes.find(nodes);
  if (found == registry->by_nodes.end()) return;
  list(ContentHash(found->second->content), copied_nodes, copied_primitives);
}

void releaseVolumes(const void* nodes) {
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!nodes || !registry) return;
    entry = unlist(nodes);
  }
  if (!entry) return;
  const std::unique_lock<std::shared_mutex> lock(entry->reading);
  entry->released = true;
}

template bool copySharedVolumes(const ContentHash&, std::size_t, const TreeArrays<double>&);
template bool copySharedVolumes(const ContentHash&, std::size_t, const TreeArrays<float>&);

}  // namespace kios
