// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/farthest_vertex.h"

#include <algorithm>

#include "fcl_kios/detail/rigid.h"
#include "search/search.h"
#include "search/solid_search.h"
#include "tree/prepare.h"
#include "volume/balls.h"
#include "volume/error_bounds.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Looks at the triangles nearest to a half-space that begins where the tree's reach ends, in the
/// frame and units of the tree. With a loop over all vertices penetrations take 1.4 times as long
/// (kios_bench solids/arm_in_table) to 1.7 times (balls).
class FarthestVertex final : public engine::SolidEvaluator {
 public:
  FarthestVertex(const Mesh& mesh, const Vec& n)
      : mesh_(mesh),
        n_(n),
        length_(n.norm()),
        origin_(mesh.tree().origin[0], mesh.tree().origin[1], mesh.tree().origin[2]),
        unit_(scaled(1, mesh.tree().exponent)) {
    cull_distance = kInfinityFloat;
  }

  /// Vertices round twice in double on their way to the tree's frame; solid_search.h counts the
  /// rest.
  Vec run() {
    const engine::Tree& tree = mesh_.tree();
    const double scale = 2 * double{tree.reach};
    if (!(scale <= engine::kLargestReach)) {
      const auto count = static_cast<std::uint32_t>(mesh_.numTriangles());
      for (std::uint32_t t = 0; t < count; ++t) evaluate(t, false);
      return best_;
    }
    engine::FloatSolid solid = {};
    solid.form = engine::FloatSolid::Form::kHalfspace;
    for (int c = 0; c < 3; ++c) solid.normal[c] = roundedTo<float>(-n_[c] / length_);
    solid.offset = -tree.reach;
    const double in_double = error_bounds::solidError(4 * (origin_.lpNorm<1>() / unit_ + scale));
    solid.pad = roundUpFloat(2 * error_bounds::laneError(scale) + in_double);
    solid.box_pad = roundUpFloat(error_bounds::boxError(scale) + in_double);
    SearchCounts unused;
    engine::kernels().solid({tree, solid, *this, unused});
    return best_;
  }

  bool evaluate(std::uint32_t triangle, bool /*meets*/) override {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec p = mesh_.corner(triangle, k);
      const double height = detail::dot(n_, p);
      if (!(height > height_)) continue;
      height_ = height;
      best_ = p;
    }
    const double beyond = double{mesh_.tree().reach} - n_.dot(best_ - origin_) / (length_ * unit_);
    if (beyond < 0x1p127)
      cull_distance = std::min(cull_distance, roundUpFloat(std::max(beyond, 0.0)));
    return false;
  }

 private:
  const Mesh& mesh_;
  const Vec& n_;
  const double length_;
  const Vec origin_;
  const double unit_;
  double height_ = -kInfinity;
  Vec best_ = Vec::Zero();
};

}  // namespace

Vec farthestVertex(const Mesh& mesh, const Vec& n) { return FarthestVertex(mesh, n).run(); }

}  // namespace kios
