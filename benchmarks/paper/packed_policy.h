// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "fcl_kios/paper.h"
#include "paper/volume_policy.h"

namespace kios::paper {

/// Holds S0 and pairs of caps, centres of caps relative to S0's, all floats in a model's units
/// (origin and power of two, so that neither place nor size of the model matters): what packed
/// variants are fitted as and unpacked to. Every sphere contains the content in exact arithmetic.
struct CapSpheres {
  static constexpr int kMostCaps = 12;
  bool empty = true;
  std::uint8_t pairs = 0;  ///< bit i: caps along axis i, outwards along + and then -
  int caps = 0;
  float center[3] = {}, radius = 0;
  float x[kMostCaps] = {}, y[kMostCaps] = {}, z[kMostCaps] = {}, r[kMostCaps] = {};
  bool by_height = false;      ///< caps lie along shared directions, at these heights
  bool shared_radius = false;  ///< all caps have one radius
  float height[kMostCaps] = {};
};

/// Holds volumes as floats one after the other, 4 for S0, then 1 for a shared radius, then for each
/// cap its place (x, y, z, or a height along a direction that is stored elsewhere) and, if not
/// shared, its radius. Beside them an index of 5 bytes a volume says where it starts and which
/// pairs it has.
class PackedStore {
 public:
  struct Packed {
    const float* data;  ///< nullptr: empty
    std::uint8_t pairs;
  };

  void add(const CapSpheres& v);
  Packed operator[](int i) const {
    const bool empty = begin_[i] == begin_[i + 1];
    return {empty ? nullptr : floats_.data() + begin_[i], pairs_[i]};
  }
  std::size_t floats() const { return floats_.size(); }
  const std::vector<float>& data() const { return floats_; }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> begin_{0};
  std::vector<std::uint8_t> pairs_;
};

/// Holds k-IOS that store no more floats than their kind needs; see its three kinds below.
class PackedPolicy {
 public:
  /// Once a model: units, and the directions of a fixed-direction k-IOS.
  struct Shared {
    fcl::Vector3d origin = fcl::Vector3d::Zero();
    int exponent = 0;  ///< the model's points lie within 2^exponent of the origin, by coordinate
    std::vector<fcl::Vector3f> directions;
  };
  using Volume = CapSpheres;
  using Store = PackedStore;

  /// Holds a pose of B in A between the models' units, in units of 2^exponent, and its rounding.
  /// Refers to both models' data, which must outlive it.
  struct Placed {
    const Shared *a, *b;
    double R[3][3], T[3];
    float Rf[3][3];
    double unit_a, unit_b;
    double pad, stretch;
    double length;  ///< 2^exponent
  };

  Shared share(const fcl::Vector3d* points, int n) const;
  Volume fit(const fcl::Vector3d* points, int n, const Shared& model) const;
  Placed place(const Shared& a, const Shared& b, const RelativePose<double>& X_AB) const;
  double separation(PackedStore::Packed a, PackedStore::Packed b, const Placed& X,
                    double enough) const;
  bool contains(PackedStore::Packed v, const Shared& model, const fcl::Vector3d& p) const;
  CapSpheres unpack(PackedStore::Packed v, const Shared& model) const;

 protected:
  enum class Axes { kOfTheVolume, kCoordinates, kOfTheModel, kGiven };
  PackedPolicy(Axes axes, int most_spheres, const FitOptions& options,
               std::vector<fcl::Vector3f> directions = {});
  /// Throws std::invalid_argument unless there are 1 to 6 of them, finite and not zero.
  static std::vector<fcl::Vector3f> unitDirections(const std::vector<fcl::Vector3d>& directions);

 private:
  /// Calls visit(i, height, x, y, z, r) for each stored cap.
  template <typename Visit>
  void visitCaps(PackedStore::Packed v, const Shared& model, Visit visit) const;
  const std::vector<fcl::Vector3f>& directions(const Shared& model) const;
  void placeAlong(const std::vector<fcl::Vector3f>& directions, const std::vector<fcl::Vector3d>& q,
                  CapSpheres& v) const;

  Axes axes_;
  int most_spheres_;
  FitOptions options_;
  std::vector<fcl::Vector3f> given_;  ///< directions that no model stores, or all do
};

/// Holds oriented k-IOS (paper, III-A): caps along the principal axes of each volume's content, as
/// the fit of `options` places them; k = 1, 3, 5 or, by the tuned fit alone, 7 (by ratio, where the
/// paper gives 5), at most K. Floats: 4 + 4 (k - 1), with a shared radius 5 + 3 (k - 1).
template <int K>
class OrientedKios : public PackedPolicy {
  static_assert(K == 1 || K == 3 || K == 5 || K == 7, "S0 and up to three pairs of caps");

 public:
  explicit OrientedKios(const FitOptions& options = {})
      : PackedPolicy(Axes::kOfTheVolume, K, options) {}
};

/// Holds axis-aligned k-IOS (paper, III-A): caps along the coordinate axes of the model's frame, of
/// which nothing is stored. The method of `options` does not matter; by ratio, an axis gets caps
/// where the largest of the extents is more than 1.5 times its own, which is the paper's rule
/// (III-C). Floats: 4 + 2 (k - 1), with a shared radius 5 + (k - 1).
class AxisAlignedKios : public PackedPolicy {
 public:
  explicit AxisAlignedKios(const FitOptions& options = {})
      : PackedPolicy(Axes::kCoordinates, 7, options) {}
};

/// Holds fixed-direction k-IOS (paper, III-A, V-B): as AxisAlignedKios, along directions that a
/// model stores once. They turn with the model, so that no rotation makes anything be computed
/// again.
class FixedDirectionKios : public PackedPolicy {
 public:
  /// Returns the principal axes of each model's vertices.
  explicit FixedDirectionKios(const FitOptions& options = {})
      : PackedPolicy(Axes::kOfTheModel, 7, options) {}
  /// Sets 1 to 6 directions, the same for every model, each in the model's frame, of any finite
  /// length above 0; otherwise throws std::invalid_argument.
  explicit FixedDirectionKios(const std::vector<fcl::Vector3d>& directions,
                              const FitOptions& options = {});
};

}  // namespace kios::paper
