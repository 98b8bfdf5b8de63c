// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "tree/build_budget.h"
#include "tree/root_copy.h"
#include "tree/shared_tree.h"

namespace kios::engine {

/// The state of a model that a tree was prepared from. Every fit and every merge stamps its volume
/// anew, so that no two states of a model's geometry share a key.
struct TreeKey {
  std::uint64_t root_stamp = 0;  ///< 0: none
  const void* vertices = nullptr;
  const void* triangles = nullptr;
  std::size_t num_vertices = 0, num_triangles = 0;

  bool operator==(const TreeKey& o) const {
    return root_stamp == o.root_stamp && vertices == o.vertices && triangles == o.triangles &&
           num_vertices == o.num_vertices && num_triangles == o.num_triangles;
  }
};

/// The prepared trees of a model and of its copies, which share it: a bounded set by key. Finding
/// one takes no lock; a tree that is in use is never changed or freed.
class TreeCache {
  struct Cell;

 public:
  /// Something that the layers above keep with a model and its copies; see solid/solid_mark.h.
  class Attachment {
   public:
    virtual ~Attachment() = default;
  };
  /// Written only while nobody uses a model that shares this cache.
  std::unique_ptr<Attachment> attachment;
  /// Counts the tests of queries that can do without a tree; exhausted as soon as one was made.
  BuildBudget budget;

  /// A tree in use. Empty if there is none.
  class Use {
   public:
    Use() = default;
    Use(Use&& o) noexcept;
    Use& operator=(Use&& o) noexcept;
    ~Use() {
      if (cell_) leave();
    }

    explicit operator bool() const { return tree_ != nullptr; }
    /// Also where it is known that no tree can be made.
    bool isKnown() const { return cell_ != nullptr || own_; }
    const Tree& operator*() const { return *tree_; }
    const Tree* operator->() const { return tree_; }

   private:
    friend class TreeCache;
    explicit Use(Cell& cell) : cell_(&cell), tree_(cell.found) {}
    explicit Use(SharedTree own) : own_(std::move(own)), tree_(own_.get()) {}
    void leave();

    Cell* cell_ = nullptr;
    SharedTree own_;  ///< one that found no place
    const Tree* tree_ = nullptr;
  };

  /// The tree of that key, empty if there is none. Lock-free.
  Use find(const TreeKey& key);

  /// Copies the root of the tree that was made last, if it is of this state; takes no tree in use.
  bool findRoot(std::uint64_t root_stamp, TreeRoot& root) const {
    return root_stamp != 0 && root_.read(root_stamp, root);
  }

  /// Returns true if the tree that was made last is of this state.
  bool isPrepared(std::uint64_t root_stamp) const {
    return root_stamp != 0 && root_.isOf(root_stamp);
  }

  /// Makes a tree, of `old` if that serves: another state of the same triangles, or nothing.
  using Make = std::function<SharedTree(SharedTree old)>;

  /// The tree of that key, made if there is none; threads that ask at once wait for one to make it.
  Use findOrMake(const TreeKey& key, const Make& make);

  /// Notes that the tree of volumes with this stamp at its root is buildVolumes()'s, to be read by
  /// prepare(). Only the last few are remembered.
  void noteBuilt(std::uint64_t root_stamp);
  bool isBuilt(std::uint64_t root_stamp) const;

  /// Bytes of the trees held, each once; those included that other caches hold too.
  std::size_t bytes();

  /// Drops the trees made from these vertices, except those in use.
  void drop(const void* vertices);

 private:
  /// users counts those who read what follows it; kWriting is added while they change.
  struct Cell {
    std::atomic<std::uint64_t> root_stamp{0};
    std::atomic<int> users{0};
    TreeKey key;
    const Tree* found = nullptr;  ///< that of `tree`, one step nearer
    SharedTree tree;
  };
  static constexpr int kWriting = -(1 << 30);

  bool tryReplace(Cell& cell, const TreeKey& key, SharedTree& tree);
  SharedTree earlierState(const TreeKey& key);

  RootCopy root_;
  std::array<Cell, 8> cells_;
  std::array<std::atomic<std::uint64_t>, 8> built_{};
  std::atomic<unsigned int> num_built_{0};
  std::mutex making_;
  std::size_t next_ = 0;  ///< to be replaced, where no cell is free
};

}  // namespace kios::engine
