// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <limits>
#include <stdexcept>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include "error_competitor.h"

namespace kios::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename BV, typename Node>
class FclErrorCompetitor final : public ErrorCompetitor {
 public:
  explicit FclErrorCompetitor(const char* name) : name_(name) {}

  const char* name() const override { return name_; }

  bool serves(const ErrorSetting& setting) const override {
    return setting.query == ErrorSetting::kDistance || setting.query == ErrorSetting::kThreshold;
  }

  void load(const scenes::Mesh& a, const scenes::Mesh& b) override {
    a_ = scenes::buildModel<BV>(a);
    b_ = scenes::buildModel<BV>(b);
  }

  void answer(const ErrorSetting& setting, const std::vector<ErrorQuestion>& questions,
              std::size_t begin, std::size_t end, std::vector<ErrorAnswer>& answers) override {
    const bool relative = setting.rel_err > 0, absolute = setting.abs_err > 0;
    for (std::size_t i = begin; i < end; ++i) {
      const ErrorQuestion& question = questions[i];
      const fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      const double threshold = setting.threshold.value_or(kInfinity) * question.distance;
      if (setting.threshold) result.min_distance = threshold;
      Node node;
      const fcl::BVHModel<BV>&a = *a_, &b = *b_;
      if (!initialize(node, a, question.poses.X_WA, b, question.poses.X_WB, request, result)) {
        throw std::runtime_error("the traversal refused the models");
      }
      node.rel_err = absolute ? kInfinity : setting.rel_err;
      node.abs_err = relative ? kInfinity : setting.abs_err;
      fcl::detail::distance(&node);
      answers[i].upper = result.min_distance;
      if (setting.threshold) answers[i].upper = result.min_distance < threshold ? 0 : kInfinity;
    }
  }

 private:
  const char* name_;
  std::shared_ptr<fcl::BVHModel<BV>> a_, b_;
};

}  // namespace

std::unique_ptr<ErrorCompetitor> makeObbrssErrorCompetitor() {
  return std::make_unique<
      FclErrorCompetitor<fcl::OBBRSSd, fcl::detail::MeshDistanceTraversalNodeOBBRSSd>>(
      "fcl_obbrss");
}

std::unique_ptr<ErrorCompetitor> makeRssErrorCompetitor() {
  return std::make_unique<
      FclErrorCompetitor<fcl::RSSd, fcl::detail::MeshDistanceTraversalNodeRSSd>>("fcl_rss");
}

}  // namespace kios::bench
