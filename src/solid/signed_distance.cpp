// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/points.h"

#include <algorithm>
#include <cmath>

#include "model/prepared.h"
#include "query/nearest_on_mesh.h"
#include "query/point_batch.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// The signed distances of points, one after the other, from a solid or by winding numbers.
class SignedSearch {
 public:
  template <typename S>
  SignedSearch(const Model<S>& model, const PointRequest& request)
      : mesh_(meshOf(model)), within_(request.within), winding_(request.winding) {
    if (!winding_) {
      requireSolid(mesh_);
    } else if (!winding_->isOf(model)) {
      refuse("request.winding is not the tree of this model as it is now.");
    }
  }

  double at(const Pointd& p) {
    const NearestOnMesh near = nearestOnMesh(mesh_, p, within_, start_);
    start_ = near.triangle;
    if (near.distance == 0) return 0;
    return isInside(p, near.lower) ? -near.distance : near.distance;
  }

 private:
  /// For a point that is farther than `clear` from the surface. Two points of a ball without any
  /// are on one side: no ray is needed where the last point lies in this one's, or this in its.
  bool isInside(const Pointd& p, double clear) {
    if (winding_) return windsRound(p);
    const double apart = (p - last_).stableNorm() * (1 + 0x1p-48);
    if (!(apart < std::max(clear, last_clear_))) {
      SearchCounts unused;
      inside_ = placeOf(p, mesh_, unused).winding > 0;
    }
    last_ = p;
    last_clear_ = clear;
    return inside_;
  }

  bool windsRound(const Pointd& p) const {
    const double rounding = 0x1p-46 * static_cast<double>(mesh_.numTriangles());
    for (const double error : {0.25, 1e-2, 1e-4}) {
      const double number = winding_->at(p, error);
      if (std::abs(number - 0.5) > error + rounding) return number > 0.5;
    }
    return winding_->at(p, 0) > 0.5;
  }

  const Mesh mesh_;
  const double within_;
  const WindingTree* const winding_;
  int start_ = -1;
  bool inside_ = false;
  Pointd last_ = Pointd::Constant(kInfinity);  ///< none
  double last_clear_ = 0;
};

}  // namespace

template <typename S>
double signedDistance(const Model<S>& model, const fcl::Vector3d& p, const PointRequest& request) {
  const Eigen::Matrix3Xd points = p;
  return SignedSearch(model, request).at(PointBatch(points, request).inModel(0));
}

template <typename S>
void signedDistances(const Model<S>& model, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                     Eigen::Ref<Eigen::VectorXd> distances, const PointRequest& request) {
  const SignedSearch checked(model, request);
  const PointBatch batch(points, request);
  batch.requireSize(distances.size(), "distances");
  batch.forAll([&]() -> PointBatch::Look {
    return [&, search = checked](Eigen::Index i) mutable {
      distances[i] = search.at(batch.inModel(i));
    };
  });
}

KIOS_INSTANTIATE_FUNCTION(signedDistance);
KIOS_INSTANTIATE_FUNCTION(signedDistances);

}  // namespace kios
