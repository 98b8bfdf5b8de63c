// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "fcl_kios/model.h"
#include "inside_grid.h"

namespace kios::python {

/// fcl_kios.Mesh: a model that nobody changes.
class Mesh {
 public:
  Mesh(std::shared_ptr<Modeld> model, bool solid) : model_(std::move(model)), solid_(solid) {}

  /// Marked as a solid, if it is one; a mesh that was loaded at its first use. Throws
  /// std::invalid_argument if it can't be marked.
  const Modeld& model() const;
  std::shared_ptr<const Modeld> share() const {
    model();
    return model_;
  }
  bool isSolid() const { return solid_; }

  /// Counts n poses of `other`. Returns the grid for them where it is worth making one, else
  /// nullptr. To be called without the GIL.
  const InsideGrid* gridFor(std::size_t n, const Mesh& other) const;
  /// To be called where `other` was given a grid.
  const SpreadVertices& spreadVertices() const { return *spread_; }

 private:
  const std::shared_ptr<Modeld> model_;
  const bool solid_;
  mutable std::once_flag marked_;
  mutable std::atomic<std::size_t> poses_{0};
  mutable std::once_flag grid_made_, spread_made_;
  mutable std::unique_ptr<const InsideGrid> grid_;
  mutable std::optional<const SpreadVertices> spread_;
};

}  // namespace kios::python
