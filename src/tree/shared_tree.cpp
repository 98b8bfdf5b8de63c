// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/shared_tree.h"

#include <mutex>
#include <unordered_map>
#include <utility>

namespace kios::engine {

struct SharedTree::Entry {
  ContentHash content;
  int holders = 1;      ///< guarded by the directory's mutex
  bool listed = false;  ///< likewise
  std::mutex making;
  std::unique_ptr<Tree> tree;  ///< set under `making`; constant while there are several holders
};

/// The listed entries. Nothing in it has a destructor, and its map is there only while it lists
/// something: models may live longer than the library's static objects.
struct SharedTree::Directory {
  using Map = std::unordered_map<ContentHash, Entry*, HashOfContent>;

  static std::mutex mutex;
  static Map* map;

  static Entry* hold(const ContentHash& content) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (map) {
      const auto found = map->find(content);
      if (found != map->end()) {
        ++found->second->holders;
        return found->second;
      }
    }
    auto entry = std::make_unique<Entry>();
    entry->content = content;
    auto new_map = map ? nullptr : std::make_unique<Map>();
    (map ? *map : *new_map).emplace(content, entry.get());
    if (new_map) map = new_map.release();
    entry->listed = true;
    return entry.release();
  }

  static void release(Entry* entry) {
    if (!entry) return;
    std::unique_ptr<Entry> last;  // freed when the mutex is
    const std::lock_guard<std::mutex> lock(mutex);
    if (--entry->holders > 0) return;
    unlist(*entry);
    last.reset(entry);
  }

  /// The mutex must be locked.
  static void unlist(Entry& entry) {
    if (!std::exchange(entry.listed, false)) return;
    map->erase(entry.content);
    if (map->empty()) delete std::exchange(map, nullptr);
  }
};

std::mutex SharedTree::Directory::mutex;
SharedTree::Directory::Map* SharedTree::Directory::map = nullptr;

SharedTree::SharedTree(const ContentHash& content, const Make& make)
    : entry_(Directory::hold(content)) {
  try {
    const std::lock_guard<std::mutex> lock(entry_->making);
    if (!entry_->tree) entry_->tree = make();
  } catch (...) {
    Directory::release(entry_);
    throw;
  }
}

SharedTree::SharedTree(SharedTree&& other) noexcept
    : entry_(std::exchange(other.entry_, nullptr)) {}

SharedTree& SharedTree::operator=(SharedTree&& other) noexcept {
  std::swap(entry_, other.entry_);
  return *this;
}

void SharedTree::release() { Directory::release(entry_); }

bool SharedTree::isHeld(const ContentHash& content) {
  const std::lock_guard<std::mutex> lock(Directory::mutex);
  return Directory::map && Directory::map->count(content) > 0;
}

const Tree* SharedTree::get() const { return entry_ ? entry_->tree.get() : nullptr; }

Tree& SharedTree::detach() {
  {
    const std::lock_guard<std::mutex> lock(Directory::mutex);
    if (entry_->holders == 1) {
      Directory::unlist(*entry_);
      return *entry_->tree;
    }
  }
  auto own = std::make_unique<Entry>();
  own->tree = std::make_unique<Tree>(*entry_->tree);
  Directory::release(std::exchange(entry_, own.release()));
  return *entry_->tree;
}

}  // namespace kios::engine
