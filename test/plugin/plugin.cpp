// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plug-in over k-IOS: two functions of C, for hosts that know nothing of C++.

#include <stdexcept>
#include <vector>

#include "fcl_kios/fcl_kios.h"

namespace {

std::shared_ptr<kios::Modeld> box(double half) {
  std::vector<fcl::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  }
  return kios::makeModel(corners, {{0, 2, 3},
                                   {0, 3, 1},
                                   {4, 5, 7},
                                   {4, 7, 6},
                                   {0, 1, 5},
                                   {0, 5, 4},
                                   {2, 6, 7},
                                   {2, 7, 3},
                                   {0, 4, 6},
                                   {0, 6, 2},
                                   {1, 3, 7},
                                   {1, 7, 5}});
}

}  // namespace

extern "C" {

/// Returns the distance of two cubes of edge 2 whose centres lie `shift` apart along x; below 0 if
/// anything else is wrong.
double plugin_distance(double shift) {
  const auto a = box(1), b = box(1);
  b->beginReplaceModel();
  b->replaceSubModel(std::vector<fcl::Vector3d>(a->vertices, a->vertices + a->num_vertices));
  if (b->endReplaceModel(true, false) != fcl::BVH_OK) return -1;
  fcl::CollisionObjectd first(a);
  fcl::CollisionObjectd second(b, fcl::Transform3d(fcl::Translation3d(shift, 0.25, 0)));
  fcl::CollisionRequestd contacts(100);
  fcl::CollisionResultd found;
  if ((fcl::collide(&first, &second, contacts, found) > 0) != (shift <= 2)) return -2;
  fcl::DistanceResultd result;
  return fcl::distance(&first, &second, fcl::DistanceRequestd(), result);
}

/// 1 if an exception that the library throws is caught here as what it is.
int plugin_refuses() {
  try {
    kios::makeModel<double>({}, {});
  } catch (const std::invalid_argument&) {
    return 1;
  } catch (...) {
  }
  return 0;
}
}
