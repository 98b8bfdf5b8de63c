// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "fcl_kios/model/model.h"
#include "preload/calls.h"
#include "preload/mesh.h"

namespace kios::preload {

/// Holds k-IOS models of the contents that FCL's models had. Any thread may call anything here;
/// queries wait for nobody.
class Twins {
 public:
  struct Cell;

  /// Holds a model's place, kept while this lives.
  class Hold {
   public:
    Hold() = default;
    Hold(Hold&& o) noexcept;
    Hold& operator=(Hold&& o) noexcept;
    ~Hold();

    explicit operator bool() const { return cell_ != nullptr; }
    /// Whether there is a twin, of the present content or of one before.
    bool hasTwin() const;
    /// Returns bytes that isCurrent() compares; 0 where nothing was fitted since that was last
    /// true.
    std::size_t bytesToCompare() const;
    /// Whether the twin has the model's present content. If not, it will not be asked again.
    bool isCurrent() const;
    const Modeld& twin() const;
    /// Numbers the models in the order of their first queries.
    std::uint32_t serial() const;

   private:
    friend class Twins;
    bool trusted() const;

    const Twins* twins_ = nullptr;
    Cell* cell_ = nullptr;
    Mesh mesh_;
  };

  explicit Twins(const Start& start);
  ~Twins();

  /// The model's place; it gets one if there is none. Empty if all places are taken.
  Hold hold(const Mesh& mesh);

  /// Notes that FCL was asked about the model for so long, in nanoseconds, as there was no twin. Of
  /// a query that two models share each pays its part. Once a twin costs a small part of that, it
  /// is made: about 1.3 times the time is spent that was needed. No Hold may be kept meanwhile.
  void pay(const Mesh& mesh, double nanoseconds);

  /// Makes the model's twin now, unless it has a current one.
  void make(const Mesh& mesh);

  /// Waits for twins that are being made; no other is until afterFork(). All that threads hold is
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
