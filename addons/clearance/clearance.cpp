// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "clearance/nearest_pair.h"
#include "fcl_kios/volume.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
std::vector<kIOS<S>> levelOf(const Model<S>& model, int level) {
  validate(model);
  if (level < 0) refuse("the level of a cover must be 0 or more, the root's is 0.");
  std::vector<int> nodes = {0};
  for (int depth = 0; depth < level; ++depth) {
    std::vector<int> next;
    bool deeper = false;
    for (const int node : nodes) {
      const auto& bv = model.getBV(node);
      if (bv.isLeaf()) {
        next.push_back(node);
        continue;
      }
      deeper = true;
      next.push_back(bv.leftChild());
      next.push_back(bv.rightChild());
    }
    nodes = std::move(next);
    if (!deeper) break;
  }
  std::vector<kIOS<S>> volumes;
  volumes.reserve(nodes.size());
  for (const int node : nodes) volumes.push_back(model.getBV(node).bv);
  return volumes;
}

/// Volumes of a triangle's parts, which are halved across their longest sides.
template <typename S>
class TriangleParts {
 public:
  TriangleParts(double size, std::vector<kIOS<S>>& volumes)
      : radius_(size / 2), volumes_(volumes) {}

  void add(const std::array<fcl::Vector3<S>, 3>& corners, int depth = 0) {
    kIOS<S> volume;
    fitTo(corners, depth, volume);
    if (double{volume.radius0} <= radius_) {
      volumes_.push_back(volume);
      requireFew(volumes_);
      return;
    }
    // A part that doesn't get smaller has come to the rounding of its place.
    if (depth == kDeepest) refuseSmall();
    int longest = 0;
    double most = -1;
    for (int i = 0; i < 3; ++i) {
      const double length =
          (corners[(i + 1) % 3] - corners[i]).template cast<double>().stableNorm();
      if (length > most) {
        most = length;
        longest = i;
      }
    }
    const fcl::Vector3<S>&p = corners[longest], &q = corners[(longest + 1) % 3],
          &r = corners[(longest + 2) % 3];
    const fcl::Vector3<S> middle = S(0.5) * p + S(0.5) * q;
    add({p, middle, r}, depth + 1);
    add({middle, q, r}, depth + 1);
  }

  static void requireFew(const std::vector<kIOS<S>>& volumes) {
    if (volumes.size() > kMost) refuseSmall();
  }

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 20;
  static constexpr int kDeepest = 64;

  [[noreturn]] static void refuseSmall() {
    refuse("a cover of so small a size would take more than 2^20 volumes.");
  }

  /// The middles are rounded, each by half a unit in the last place, and the next ones inherit
  /// that: the true part lies within octahedra about the corners.
  static void fitTo(const std::array<fcl::Vector3<S>, 3>& corners, int depth, kIOS<S>& volume) {
    std::vector<fcl::Vector3<S>> points(corners.begin(), corners.end());
    S largest = 0;
    for (const auto& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    const S off = S(4) * static_cast<S>(depth) * std::numeric_limits<S>::epsilon() * largest;
    for (int c = 0; c < 3 && depth > 0; ++c) {
      for (const auto& p : corners) {
        for (const S by : {-off, off}) {
          points.push_back(p);
          points.back()[c] += by;
        }
      }
    }
    fit(points.data(), static_cast<int>(points.size()), volume);
  }

  const double radius_;
  std::vector<kIOS<S>>& volumes_;
};

template <typename S>
std::vector<kIOS<S>> volumesOfSize(const Model<S>& model, double size) {
  validate(model);
  if (!(size > 0)) refuse("the size of a cover must be positive.");
  std::vector<kIOS<S>> volumes;
  TriangleParts<S> parts(size, volumes);
  std::vector<int> nodes = {0};
  while (!nodes.empty()) {
    const auto& node = model.getBV(nodes.back());
    nodes.pop_back();
    if (2 * double{node.bv.radius0} <= size) {
      volumes.push_back(node.bv);
      parts.requireFew(volumes);
    } else if (node.isLeaf()) {
      const fcl::Triangle& t = model.tri_indices[node.primitiveId()];
      parts.add({model.vertices[t[0]], model.vertices[t[1]], model.vertices[t[2]]});
    } else {
      nodes.push_back(node.rightChild());
      nodes.push_back(node.leftChild());
    }
  }
  return volumes;
}

}  // namespace

template <typename S>
struct Cover<S>::Parts {
  std::vector<kIOS<S>> volumes;
  std::vector<exact::SphereIntersection> bodies;
};

template <typename S>
Cover<S>::Cover(std::vector<kIOS<S>> volumes) {
  auto parts = std::make_unique<Parts>();
  if (volumes.empty()) refuse("a cover needs a volume.");
  for (const kIOS<S>& volume : volumes) {
    if (volume.k() == 0) refuse("a volume of a cover is empty.");
    parts->bodies.emplace_back(volume);
  }
  parts->volumes = std::move(volumes);
  parts_ = std::move(parts);
}

template <typename S>
Cover<S>::Cover(const Model<S>& model, int level) : Cover(levelOf(model, level)) {}

template <typename S>
Cover<S> Cover<S>::ofSize(const Model<S>& model, double size) {
  return Cover(volumesOfSize(model, size));
}

template <typename S>
Cover<S>::~Cover() = default;
template <typename S>
Cover<S>::Cover(Cover&&) noexcept = default;
template <typename S>
Cover<S>& Cover<S>::operator=(Cover&&) noexcept = default;

template <typename S>
int Cover<S>::size() const {
  return static_cast<int>(parts_->volumes.size());
}
template <typename S>
const kIOS<S>& Cover<S>::volume(int i) const {
  return parts_->volumes.at(static_cast<std::size_t>(i));
}

/// All pairs of two covers' volumes.
template <typename S>
struct CoverPairs {
  /// Returns the exact distances of all pairs that may be nearer than the minimum plus `margin`,
  /// nearest bounds first. The result gets the minimum, and how many pairs there are.
  static std::vector<ExactDistance> within(const Cover<S>& cover_a, const Cover<S>& cover_b,
                                           const RelativePose<S>& X_AB, double margin,
                                           Clearance& result) {
    struct Pair {
      double bound;
      int i, j;
    };
    const typename Cover<S>::Parts &a = *cover_a.parts_, &b = *cover_b.parts_;
    std::vector<Pair> pairs;
    pairs.reserve(a.volumes.size() * b.volumes.size());
    for (int i = 0; i < cover_a.size(); ++i) {
      for (int j = 0; j < cover_b.size(); ++j) {
        pairs.push_back({separation(a.volumes[i], b.volumes[j], X_AB, kInfinity), i, j});
      }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
      return std::pair(p.bound, std::pair(p.i, p.j)) < std::pair(q.bound, std::pair(q.i, q.j));
    });
    std::vector<ExactDistance> near;
    result.value = kInfinity;
    for (const Pair& pair : pairs) {
      if (pair.bound > result.value + margin) break;
      near.push_back(exact::exactDistance(a.volumes[pair.i], a.bodies[pair.i], b.volumes[pair.j],
                                          b.bodies[pair.j], X_AB));
      result.value = std::min(result.value, near.back().distance);
    }
    result.pairs = static_cast<int>(pairs.size());
    result.evaluated = static_cast<int>(near.size());
    return near;
  }
};

template <typename S>
Clearance minimumClearance(const Cover<S>& a, const Cover<S>& b, const RelativePose<S>& X_AB) {
  Clearance result;
  for (const ExactDistance& pair : CoverPairs<S>::within(a, b, X_AB, 0, result)) {
    if (pair.distance != result.value) continue;
    result.by_translation = pair.normal;
    result.by_rotation = pair.moment;
    break;
  }
  return result;
}

// Terms below exp(-60) of the largest are counted as exp(-60), which is below every rounding for
// any number of pairs that fits into memory: the value stays a lower bound and, to rounding, C1.
template <typename S>
Clearance smoothClearance(const Cover<S>& a, const Cover<S>& b, const RelativePose<S>& X_AB,
                          double beta) {
  if (!(beta > 0) || !std::isfinite(beta)) refuse("beta must be positive and finite.");
  constexpr double kNegligible = 60;
  Clearance result;
  const std::vector<ExactDistance> near =
      CoverPairs<S>::within(a, b, X_AB, kNegligible / beta, result);
  const double minimum = result.value;
  double sum = (result.pairs - result.evaluated) * std::exp(-kNegligible);
  for (const ExactDistance& pair : near) {
    const double weight = std::exp(-beta * (pair.distance - minimum));
    sum += weight;
    result.by_translation += weight * pair.normal;
    result.by_rotation += weight * pair.moment;
  }
  result.value = minimum - std::log(sum) / beta;
  result.by_translation /= sum;
  result.by_rotation /= sum;
  return result;
}

template class Cover<double>;
template class Cover<float>;
KIOS_INSTANTIATE_FUNCTION(minimumClearance);
KIOS_INSTANTIATE_FUNCTION(smoothClearance);

}  // namespace kios
