// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/linkage/linkage.h"

#include <utility>

#include "linkage/motion_search.h"
#include "volume/errors.h"

namespace kios {

Linkage::Linkage() : impl_(std::make_unique<Impl>()) {}
Linkage::~Linkage() = default;
Linkage::Linkage(const Linkage& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Linkage::Linkage(Linkage&& other) noexcept = default;
Linkage& Linkage::operator=(Linkage other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}

int Linkage::addLink(int parent, const Joint& joint) { return impl_->addLink(parent, joint); }

int Linkage::addBody(int link, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                     const fcl::Transform3d& X_LB) {
  return impl_->addBody(link, std::move(geometry), X_LB);
}

void Linkage::allow(int body_a, int body_b) { impl_->allow(body_a, body_b); }

int Linkage::coordinates() const { return impl_->coordinates; }
int Linkage::links() const { return static_cast<int>(impl_->links.size()); }
int Linkage::bodies() const { return static_cast<int>(impl_->bodies.size()); }

fcl::Transform3d Linkage::pose(int body, const Eigen::VectorXd& q) const {
  if (body < 0 || body >= bodies()) refuse("the linkage has no body ", body, ".");
  const articulated::Path path(*impl_, q, q);
  return articulated::Configuration(path, 1).pose(body);
}

fcl::Transform3d Linkage::linkPose(int link, const Eigen::VectorXd& q) const {
  if (link < 0 || link >= links()) refuse("the linkage has no link ", link, ".");
  const articulated::Path path(*impl_, q, q);
  return articulated::Configuration(path, 1).linkPose(link);
}

MotionAnswer checkMotion(const Linkage& linkage, const Eigen::VectorXd& q0,
                         const Eigen::VectorXd& q1, const MotionRequest& request) {
  require(request.min_separation >= 0 && request.min_separation <= 0x1p300,
          "MotionRequest::min_separation", request.min_separation, "finite and >= 0");
  require(request.resolution >= 0x1p-40 && request.resolution <= 1, "MotionRequest::resolution",
          request.resolution, "in [2^-40, 1]");
  require(request.max_queries >= 0, "MotionRequest::max_queries",
          static_cast<double>(request.max_queries), ">= 0");
  const auto impl = linkage.impl().current();
  const articulated::Path path(*impl, q0, q1);
  return articulated::MotionSearch(path, request).run();
}

}  // namespace kios
