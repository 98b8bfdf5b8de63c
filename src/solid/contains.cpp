// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>

#include "fcl_kios/solid/solids.h"
#include "fcl_kios/volume/separation.h"
#include "solid/solid_mark.h"
#include "solid/winding.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {

template <typename S>
bool contains(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
              const fcl::Vector3<std::common_type_t<S>>& point) {
  checkSolid(solid);
  require(point.allFinite() && double{point.cwiseAbs().maxCoeff()} <= kMaxCoordinate<S>,
          "the point", point.transpose(), kCoordinateRange<S>);
  const RelativePose<S> rigid(X_WM.linear(), X_WM.translation());  // or it throws
  const fcl::Matrix3d inverse = X_WM.linear().template cast<double>().inverse();
  const fcl::Vector3d from =
      point.template cast<double>() - X_WM.translation().template cast<double>();
  SearchCounts unused;
  return placeOf<S>(detail::rotate<double>(inverse, from), solid, unused).inside();
}

KIOS_INSTANTIATE_FUNCTION(contains);

}  // namespace kios
