// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "paper/variant_tree.h"

namespace kios::bench {

using namespace paper;

/// Two nodes of the splits of both meshes at a pose, and the distance of their triangles.
struct NodePair {
  int a, b;
  RelativePose<double> X_AB;
  double distance;
};

/// A volume and its fit over the splits of two meshes: all entrants share splits, traversal and
/// leaf tests, so that they differ by their volumes alone.
class FitEntrant {
 public:
  using Split = std::shared_ptr<const MeshSplit>;

  explicit FitEntrant(std::string name) : name_(std::move(name)) {}
  virtual ~FitEntrant() = default;

  const std::string& name() const { return name_; }
  /// False for a volume without distances.
  virtual bool servesDistance() const = 0;
  virtual void build(const Split& a, const Split& b) = 0;
  virtual VariantResult distance(const RelativePose<double>& X_AB) const = 0;
  virtual VariantResult collide(const RelativePose<double>& X_AB) const = 0;
  /// The bound of two nodes, for a distance query.
  virtual double bound(const NodePair& pair) const = 0;
  /// Means over the nodes of both trees: numbers that describe a volume, as the paper counts; bytes
  /// that it takes here; its spheres, 0 if it has none.
  virtual double numbers() const = 0;
  virtual double bytes() const = 0;
  virtual double spheres() const = 0;

 private:
  std::string name_;
};

/// Numbers that describe a volume, and its spheres.
struct VolumeSize {
  double numbers = 0;
  double spheres = 0;
};

template <typename Policy>
class VariantEntrant final : public FitEntrant {
 public:
  using Tree = VariantTree<Policy>;
  using Stored = std::decay_t<decltype(std::declval<typename Policy::Store>()[0])>;
  using SizeOf = std::function<VolumeSize(const Stored&)>;

  VariantEntrant(std::string name, Policy policy, SizeOf size_of, bool serves_distance = true)
      : FitEntrant(std::move(name)),
        policy_(std::move(policy)),
        size_of_(std::move(size_of)),
        serves_distance_(serves_distance) {}

  bool servesDistance() const override { return serves_distance_; }
  void build(const Split& a, const Split& b) override {
    a_ = std::make_unique<Tree>(a, policy_);
    b_ = std::make_unique<Tree>(b, policy_);
  }
  VariantResult distance(const RelativePose<double>& X_AB) const override {
    return a_->distance(*b_, X_AB);
  }
  VariantResult collide(const RelativePose<double>& X_AB) const override {
    return a_->collide(*b_, X_AB);
  }
  double bound(const NodePair& pair) const override {
    return policy_.separation(a_->store()[pair.a], b_->store()[pair.b],
                              policy_.place(a_->shared(), b_->shared(), pair.X_AB),
                              std::numeric_limits<double>::infinity());
  }
  double numbers() const override { return mean(&VolumeSize::numbers); }
  double spheres() const override { return mean(&VolumeSize::spheres); }
  double bytes() const override {
    const auto floats = static_cast<double>(a_->store().floats() + b_->store().floats());
    return static_cast<double>(sizeof(float)) * floats / static_cast<double>(nodes());
  }

 private:
  std::size_t nodes() const { return a_->split().nodes().size() + b_->split().nodes().size(); }
  double mean(double VolumeSize::*of) const {
    double sum = 0;
    for (const Tree* tree : {a_.get(), b_.get()}) {
      const auto count = static_cast<int>(tree->split().nodes().size());
      for (int i = 0; i < count; ++i) sum += size_of_(tree->store()[i]).*of;
    }
    return sum / static_cast<double>(nodes());
  }

  Policy policy_;
  SizeOf size_of_;
  bool serves_distance_;
  std::unique_ptr<const Tree> a_, b_;
};

/// All constructions of k-IOS, and the volumes that they are compared with.
std::vector<std::unique_ptr<FitEntrant>> fitEntrants();

}  // namespace kios::bench
