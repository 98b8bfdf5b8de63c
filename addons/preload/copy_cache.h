// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "fcl_kios/model.h"
#include "preload/calls.h"
#include "preload/fcl_mesh.h"

namespace kios::preload {

/// Holds k-IOS models of the contents that FCL's models had. Any thread may call anything here;
/// queries wait for nobody.
class CopyCache {
 public:
  struct Cell;

  /// Holds a model's place, kept while this lives.
  class ModelLease {
   public:
    ModelLease() = default;
    ModelLease(ModelLease&& o) noexcept;
    ~ModelLease();

    explicit operator bool() const { return cell_ != nullptr; }
    /// Whether there is a copy, of the present content or of one before.
    bool hasCopy() const;
    /// Returns bytes that isCurrent() compares; 0 where nothing was fitted since that was last
    /// true.
    std::size_t bytesToCompare() const;
    /// Whether the copy has the model's present content. If not, it will not be asked again.
    bool isCurrent() const;
    const Modeld& copy() const;
    /// Numbers the models in the order of their first queries.
    std::uint32_t serial() const;

   private:
    friend class CopyCache;
    bool trusted() const;

    const CopyCache* cache_ = nullptr;
    Cell* cell_ = nullptr;
    Mesh mesh_;
  };

  explicit CopyCache(const Start& start);
  ~CopyCache();

  /// The model's place; it gets one if there is none. Empty if all places are taken.
  ModelLease lease(const Mesh& mesh);

  /// Notes that FCL was asked about the model for so long, in nanoseconds, as there was no copy. Of
  /// a query that two models share each pays its part. Once a copy costs a small part of that, it
  /// is made: about 1.3 times the time is spent that was needed. No ModelLease may be kept
  /// meanwhile.
  void pay(const Mesh& mesh, double nanoseconds);

  /// Makes the model's copy now, in the place of any that it has.
  void make(const Mesh& mesh);

  /// Waits for copies that are being made; no other is until afterFork(). All that threads hold is
  /// free in the child, which has none of them.
  void beforeFork();
  void afterFork();
  void afterForkInChild();

  std::size_t count() const;
  std::size_t bytes() const;

 private:
  struct Table;

  const Mode mode_;
  const Fits& fits_;
  const std::size_t limit_;
  const std::unique_ptr<Table> table_;
};

}  // namespace kios::preload
