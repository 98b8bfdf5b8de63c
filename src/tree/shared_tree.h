// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "tree/content_hash.h"
#include "tree/tree.h"

namespace kios::engine {

/// A holder of a prepared tree. All holders for equal content, anywhere in the process, hold one
/// tree; it goes with the last of them. Holders are made, asked and destroyed in any thread, each
/// by one at a time.
class SharedTree {
 public:
  using Make = std::function<std::unique_ptr<Tree>()>;

  SharedTree() = default;
  /// Holds the tree that others hold for this content, or else make()'s. Threads that come at once
  /// wait for one of them to make it; what make() throws passes through. It may make nullptr.
  SharedTree(const ContentHash& content, const Make& make);
  SharedTree(SharedTree&& other) noexcept;
  SharedTree& operator=(SharedTree&& other) noexcept;
  ~SharedTree() {
    if (entry_) release();
  }

  /// Whether somebody holds a tree for this content, or is making one.
  static bool isHeld(const ContentHash& content);

  /// nullptr if nothing is held, or that was made.
  const Tree* get() const;
  explicit operator bool() const { return entry_ != nullptr; }

  /// The tree, for its holder to change; a copy of it where others hold it too. Nobody finds it any
  /// more by its content.
  Tree& detach();

 private:
  struct Entry;
  struct Directory;
  void release();

  Entry* entry_ = nullptr;
};

}  // namespace kios::engine
