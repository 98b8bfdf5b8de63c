// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_kios/volume.h"

// A VariantTree takes volumes of any policy. A volume policy P is a copyable class with
//
//   P::Shared  what a model stores once for all its volumes (directions, origin); {} if nothing
//   P::Volume  a volume as the fit returns it
//   P::Store   the volumes of a tree as memory holds them:
//     void add(const P::Volume&)          appends one
//     operator[](int i) const             volume i as separation() and contains() take it
//     std::size_t floats() const          floats that the volumes take, 4 bytes each
//   P::Placed  what the bounds of two models at one pose have in common
//
//   Shared share(const fcl::Vector3d* points, int n) const
//     from all vertices of a model, in its frame
//   Volume fit(const fcl::Vector3d* points, int n, const Shared&) const
//     a volume around some of them; empty for n = 0. Throws std::invalid_argument if a coordinate
//     is NaN, infinite or above 2^1000 in magnitude.
//   Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const
//     X_AB must outlive the result.
//   double separation(stored a, stored b, const Placed&, double enough) const
//     signed lower bound of the distance of the contents, a's in frame A, b's moved by X_AB as
//     given and also as X_AB * p rounds: > 0 proves them apart, +infinity if one is empty. Any
//     value above `enough` may be returned as soon as it is proven.
//   bool contains(stored v, const Shared&, const fcl::Vector3d& p) const
//     false only if p is not of the content

namespace kios::paper {

/// Holds a store of volumes that are all of one size.
template <typename Volume>
class VolumeArray {
 public:
  void add(const Volume& v) { volumes_.push_back(v); }
  const Volume& operator[](int i) const { return volumes_[i]; }
  std::size_t floats() const { return volumes_.size() * sizeof(Volume) / sizeof(float); }

 private:
  std::vector<Volume> volumes_;
};

}  // namespace kios::paper
