// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Coal's OBBRSS beside FCL's volumes.
#include <algorithm>
#include <memory>
#include <stdexcept>

#include <coal/BV/OBBRSS.h>
#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/collision_object.h>
#include <coal/distance.h>

#include "mesh_set.h"

namespace kios::bench {
namespace {

using Model = coal::BVHModel<coal::OBBRSS>;

void require(bool done) {
  if (!done) throw std::runtime_error("Coal refused a mesh.");
}

std::shared_ptr<Model> built(const scenes::Mesh& mesh) {
  std::vector<coal::Triangle> triangles;
  for (const fcl::Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<Model>();
  require(model->beginModel(static_cast<unsigned>(triangles.size()),
                            static_cast<unsigned>(mesh.vertices.size())) == coal::BVH_OK);
  require(model->addSubModel(mesh.vertices, triangles) == coal::BVH_OK);
  require(model->endModel() == coal::BVH_OK);
  return model;
}

coal::Transform3s poseOf(const fcl::Transform3d& X) {
  return coal::Transform3s(X.linear(), X.translation());
}

/// Coal's requests as a user leaves them, without the contacts' geometry and the signed distance,
/// as FCL's rows. Whether meshes are closer than a bound is asked by a security margin, which is
/// what Coal has for it.
class CoalSet final : public MeshSet {
 public:
  bool serves(Query query) const override {
    return query == Query::kDistance || query == Query::kCollide || query == Query::kContacts ||
           query == Query::kCloserThan || query == Query::kBuild;
  }
  void build(const std::vector<scenes::Mesh>& meshes) const override {
    for (const scenes::Mesh& mesh : meshes) built(mesh);
  }
  void load(const std::vector<scenes::Mesh>& meshes) override {
    models_.clear();
    objects_.clear();
    for (const scenes::Mesh& mesh : meshes) {
      models_.push_back(built(mesh));
      objects_.push_back(
          {coal::CollisionObject(models_.back()), coal::CollisionObject(models_.back())});
    }
  }
  void add(const std::shared_ptr<fcl::CollisionGeometryd>& /*geometry*/) override {
    throw std::invalid_argument("coal_obbrss has no rows with shapes: leave it out of --bv");
  }
  void replace(const std::vector<scenes::Mesh>& /*meshes*/, Refit /*how*/) override {
    throw std::logic_error("coal_obbrss serves no refit");
  }

  void answer(Query query, const std::vector<Question>& questions, std::size_t begin,
              std::size_t end, std::vector<double>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      const Question& question = questions[i];
      coal::CollisionObject& a = objects_[question.a].first;
      coal::CollisionObject& b = objects_[question.b].second;
      a.setTransform(poseOf(question.poses.X_WA));
      b.setTransform(poseOf(question.poses.X_WB));
      if (query == Query::kDistance) {
        coal::DistanceRequest request;
        request.enable_signed_distance = false;
        coal::DistanceResult result;
        coal::distance(&a, &b, request, result);
        answers[i] = std::max(0.0, result.min_distance);
        continue;
      }
      coal::CollisionRequest request;
      request.enable_contact = false;
      if (query == Query::kContacts) request.num_max_contacts = question.max_contacts;
      if (query == Query::kCloserThan) request.security_margin = question.threshold;
      coal::CollisionResult result;
      coal::collide(&a, &b, request, result);
      answers[i] = static_cast<double>(result.numContacts());
    }
  }

  Tests count(Query /*query*/, const std::vector<Question>& /*questions*/,
              std::size_t /*frames*/) const override {
    return {};
  }
  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& model : models_) {
      sum += model->getNumBVs() * sizeof(coal::BVNode<coal::OBBRSS>) +
             model->num_vertices * sizeof(coal::Vec3s) + model->num_tris * sizeof(coal::Triangle);
    }
    return sum;
  }

 private:
  std::vector<std::shared_ptr<Model>> models_;
  std::vector<std::pair<coal::CollisionObject, coal::CollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<MeshSet> makeCoalSet() { return std::make_unique<CoalSet>(); }

}  // namespace kios::bench
