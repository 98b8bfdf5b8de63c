// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "solid/components.h"
#include "solid/shadow_grid.h"

namespace kios {

/// Says which closed components of a mesh lie in others. A component winds round no point outside
/// of its box, so that a ray from a point looks only into the components whose boxes hold it:
/// cavities in line don't meet each other's rays. O(n log n) for a mesh, unless many boxes overlap:
/// it is O(log n) for each box that a component begins in, and a look at each that lies along its
/// ray.
template <typename S>
class Nesting {
 public:
  /// `parts` must live as long as this; each one must be closed.
  Nesting(const engine::MeshView<S>& mesh, const Components<S>& parts);

  /// Returns true if the others wind round the component's vertices, or all of these lie on others,
  /// so that nothing is proven wrong.
  bool liesWithinOthers(int component);

 private:
  struct Part {
    fcl::Vector3d low, high;
    std::optional<ShadowGrid> triangles;  ///< made where a point lies in the box
  };
  TriangleVertices<double> cornersOf(int triangle) const;

  const engine::MeshView<S> mesh_;
  const Components<S>& components_;
  std::vector<Part> parts_;
  double largest_ = 0;
  std::optional<ShadowGrid> boxes_;  ///< of all parts
  std::vector<std::size_t> near_parts_, near_;
};

}  // namespace kios
