// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>

#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// What to ask of a mesh A and a geometry B: the distance, whether they touch, or how many
/// triangles (or triangles and cells) touch.
enum class ShapeQuery { kDistance, kFirstContact, kAllContacts };

/// A mesh over one volume against a geometry that is no mesh, asked as a user would.
class ShapeCompetitor {
 public:
  virtual ~ShapeCompetitor() = default;
  virtual const char* name() const = 0;
  virtual void load(const scenes::Mesh& mesh,
                    const std::shared_ptr<fcl::CollisionGeometryd>& geometry) = 0;
  /// Answers frames[begin, end) into answers[begin, end).
  virtual void answer(ShapeQuery query, const std::vector<scenes::Frame>& frames, std::size_t begin,
                      std::size_t end, std::vector<double>& answers) = 0;
};

/// Over Traits of a MeshSet: BV, kName, distance(), collide().
template <typename Traits>
class MeshAndShape final : public ShapeCompetitor {
 public:
  const char* name() const override { return Traits::kName; }

  void load(const scenes::Mesh& mesh,
            const std::shared_ptr<fcl::CollisionGeometryd>& geometry) override {
    mesh_ = std::make_unique<fcl::CollisionObjectd>(scenes::buildModel<typename Traits::BV>(mesh));
    shape_ = std::make_unique<fcl::CollisionObjectd>(geometry);
  }

  void answer(ShapeQuery query, const std::vector<scenes::Frame>& frames, std::size_t begin,
              std::size_t end, std::vector<double>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      mesh_->setTransform(frames[i].X_WA);
      shape_->setTransform(frames[i].X_WB);
      answers[i] =
          query == ShapeQuery::kDistance ? distance() : contacts(query == ShapeQuery::kAllContacts);
    }
  }

 private:
  double distance() const {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    Traits::distance(mesh_.get(), shape_.get(), request, result);
    return result.min_distance;
  }
  double contacts(bool all) const {
    fcl::CollisionRequestd request;
    if (all) request.num_max_contacts = 1000000;
    fcl::CollisionResultd result;
    Traits::collide(mesh_.get(), shape_.get(), request, result);
    return static_cast<double>(result.numContacts());
  }

  std::unique_ptr<fcl::CollisionObjectd> mesh_, shape_;
};

/// Ours, and FCL's OBBRSS; each in a file of its own, as makeKiosCompetitor().
std::unique_ptr<ShapeCompetitor> makeKiosShapeCompetitor();
std::unique_ptr<ShapeCompetitor> makeObbrssShapeCompetitor();

}  // namespace kios::bench
