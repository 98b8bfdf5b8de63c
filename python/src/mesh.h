// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "fcl_kios/model/model.h"

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

 private:
  const std::shared_ptr<Modeld> model_;
  const bool solid_;
  mutable std::once_flag marked_;
};

}  // namespace kios::python
