// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/tree_cache.h"

#include <algorithm>
#include <utility>

namespace kios::engine {

[[gnu::hot]] TreeCache::Use::Use(Use&& o) noexcept
    : cell_(std::exchange(o.cell_, nullptr)),
      own_(std::move(o.own_)),
      tree_(std::exchange(o.tree_, nullptr)) {}

[[gnu::hot]] TreeCache::Use& TreeCache::Use::operator=(Use&& o) noexcept {
  std::swap(cell_, o.cell_);
  std::swap(own_, o.own_);
  std::swap(tree_, o.tree_);
  return *this;
}

[[gnu::hot]] void TreeCache::Use::leave() { cell_->users.fetch_sub(1, std::memory_order_release); }

[[gnu::hot]] TreeCache::Use TreeCache::find(const TreeKey& key) {
  for (Cell& cell : cells_) {
    if (cell.root_stamp.load(std::memory_order_relaxed) != key.root_stamp) continue;
    if (cell.users.fetch_add(1, std::memory_order_acquire) >= 0 && cell.key == key) {
      return Use(cell);
    }
    cell.users.fetch_sub(1, std::memory_order_release);
  }
  return Use();
}

TreeCache::Use TreeCache::findOrMake(const TreeKey& key, const Make& make) {
  if (Use found = find(key); found.isKnown()) return found;
  const std::lock_guard<std::mutex> lock(making_);
  if (Use found = find(key); found.isKnown()) return found;
  SharedTree tree = make(earlierState(key));
  budget.exhaust();
  // A slot with an outdated state of the same vertices is taken first, then an empty slot.
  for (const void* const vertices : {key.vertices, static_cast<const void*>(nullptr)}) {
    for (Cell& cell : cells_) {
      if (cell.key.vertices == vertices && tryReplace(cell, key, tree)) return find(key);
    }
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    next_ = (next_ + 1) % cells_.size();
    if (tryReplace(cells_[next_], key, tree)) return find(key);
  }
  return Use(std::move(tree));
}

/// Takes out the tree of an outdated state of the same triangles.
SharedTree TreeCache::earlierState(const TreeKey& key) {
  for (Cell& cell : cells_) {
    SharedTree taken;
    if (cell.tree.get() && cell.key.triangles == key.triangles &&
        cell.key.root_stamp != key.root_stamp && tryReplace(cell, TreeKey(), taken)) {
      return taken;
    }
  }
  return {};
}

bool TreeCache::tryReplace(Cell& cell, const TreeKey& key, SharedTree& tree) {
  int nobody = 0;
  if (!cell.users.compare_exchange_strong(nobody, kWriting, std::memory_order_acquire)) {
    return false;
  }
  cell.key = key;
  std::swap(cell.tree, tree);
  cell.found = cell.tree.get();
  cell.root_stamp.store(key.root_stamp, std::memory_order_relaxed);
  if (cell.tree.get()) root_.write(key.root_stamp, *cell.tree.get());
  cell.users.fetch_sub(kWriting, std::memory_order_release);
  return true;
}

void TreeCache::noteBuilt(std::uint64_t root_stamp) {
  const unsigned int at = num_built_.fetch_add(1, std::memory_order_relaxed);
  built_[at % built_.size()].store(root_stamp, std::memory_order_relaxed);
}

bool TreeCache::isBuilt(std::uint64_t root_stamp) const {
  for (const auto& stamp : built_) {
    if (stamp.load(std::memory_order_relaxed) == root_stamp) return root_stamp != 0;
  }
  return false;
}

std::size_t TreeCache::bytes() {
  const std::lock_guard<std::mutex> lock(making_);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Tree* const tree = cells_[i].tree.get();
    const auto is = [tree](const Cell& cell) { return cell.tree.get() == tree; };
    if (tree && std::none_of(&cells_[0], &cells_[i], is)) sum += tree->bytes();
  }
  return sum;
}

void TreeCache::drop(const void* vertices) {
  const std::lock_guard<std::mutex> lock(making_);
  for (Cell& cell : cells_) {
    SharedTree none;
    if (cell.tree && cell.key.vertices == vertices) tryReplace(cell, TreeKey(), none);
  }
}

}  // namespace kios::engine
