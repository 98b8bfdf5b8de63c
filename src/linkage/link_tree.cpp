// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/link_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuous/motion.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using articulated::BodyData;
using articulated::CarriedBody;
using articulated::LinkData;
using Eigen::Vector3d;

constexpr double kLargest = 0x1p300;  // of coordinates and lengths, so that no product overflows

void requireTranslation(const Vector3d& t, const char* what) {
  if (!(t.lpNorm<1>() <= kLargest)) {
    refuse("the translation of the ", what, " is NaN, infinite or too large.");
  }
}

bool turns(const std::vector<LinkData>& links, int link) {
  if (link < 0) return false;
  const auto& moving = links[link].moving;
  return std::any_of(moving.begin(), moving.end(),
                     [&](int i) { return links[i].type == JointType::kRevolute; });
}

}  // namespace

Linkage::Linkage() : impl_(std::make_unique<Impl>()) {}
Linkage::~Linkage() = default;
Linkage::Linkage(const Linkage& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Linkage::Linkage(Linkage&& other) noexcept = default;
Linkage& Linkage::operator=(Linkage other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}

int Linkage::coordinates() const { return impl_->coordinates; }
int Linkage::links() const { return static_cast<int>(impl_->links.size()); }
int Linkage::bodies() const { return static_cast<int>(impl_->bodies.size()); }

int Linkage::addLink(int parent, const Joint& joint) {
  std::vector<LinkData>& links = impl_->links;
  const int link = this->links();
  if (parent < -1 || parent >= link) {
    refuse("a link's parent must be -1, the world, or a link that was added before, but is ",
           parent, ".");
  }
  LinkData data;
  data.parent = parent;
  data.type = joint.type;
  data.R_PJ = continuous::orthonormal(joint.X_PJ.linear(), "pose of a joint");
  data.t_PJ = joint.X_PJ.translation();
  requireTranslation(data.t_PJ, "pose of a joint");
  if (parent >= 0) {
    data.moving = links[parent].moving;
    data.level = links[parent].level;
    data.offsets = links[parent].offsets;
  }
  ++data.level;
  data.offsets = (data.offsets + data.t_PJ.norm()) * (1 + 0x1p-50);
  switch (joint.type) {
    case JointType::kFixed:
      break;
    case JointType::kRevolute:
    case JointType::kPrismatic: {
      const double unit = joint.axis.stableNorm();
      if (!(unit > 0 && unit <= kLargest)) {
        refuse("the axis of a joint that moves must be finite and of a length above 0.");
      }
      data.unit = unit;
      data.axis = (joint.axis / unit).normalized();
      constexpr int kMost = 1 << 20;
      if (joint.coordinate < -1 || joint.coordinate >= kMost) {
        refuse("a joint's coordinate must be -1, the next one, or below 2^20, but is ",
               joint.coordinate, ".");
      }
      constexpr double kLargestFactor = 0x1p100;
      if (!(std::abs(joint.multiplier) <= kLargestFactor &&
            std::abs(joint.offset) <= kLargestFactor)) {
        refuse("the multiplier or the offset of a joint is NaN, infinite or too large.");
      }
      data.coordinate = joint.coordinate < 0 ? coordinates() : joint.coordinate;
      data.multiplier = joint.multiplier;
      data.offset = joint.offset;
      data.moving.push_back(link);
      break;
    }
    default:
      refuse("a joint's type must be fixed, revolute or prismatic.");
  }
  impl_->renewed.forget();
  links.push_back(std::move(data));
  impl_->coordinates = std::max(coordinates(), links.back().coordinate + 1);
  return link;
}

// The support table bounds the box: it is exact for most polyhedra along any direction.
void articulated::BodyData::place(int to, const fcl::Transform3d& X) {
  kind = own->kind;
  model = own->model;
  bounded = own->bounded;
  meets = own->meets;
  link = to;
  X_LB = X;
  box = {};
  content = articulated::placed(*own, X);
  reach = content.reach();
  if (link >= 0) return;
  const double far = X.translation().norm(), slack = 0x1p-48 * (own->size + far);
  box.length = (far + reach) * (1 + 0x1p-50);
  for (int i = 0; i < 3; ++i) {
    const Vector3d row = X.linear().row(i).transpose();
    const double at = X.translation()[i];
    box.low[i] = bounded ? at - own->supports.along(-row) - slack : -kInfinity;
    box.high[i] = bounded ? at + own->supports.along(row) + slack : kInfinity;
  }
}

int Linkage::Impl::addBody(int link, std::shared_ptr<const articulated::Content> own,
                           const fcl::Transform3d& X_LB) {
  const fcl::Transform3d X = checkedPose(*own, link, X_LB);
  if (free.empty()) {
    bodies.emplace_back();
    free.push_back(static_cast<int>(bodies.size()) - 1);
  }
  const int id = free.back();
  free.pop_back();
  renewed.forget();
  bodies[id].own = std::move(own);
  bodies[id].place(link, X);
  addPairs(id);
  return id;
}

int Linkage::addBody(int link, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                     const fcl::Transform3d& X_LB) {
  return impl_->addBody(link, std::make_shared<const articulated::Content>(std::move(geometry)),
                        X_LB);
}

int Linkage::addBody(int link, const Linkage& of, int body, const fcl::Transform3d& X_LB) {
  if (!of.impl_->has(body)) refuse("the linkage has no body ", body, ".");
  return impl_->addBody(link, of.impl_->bodies[body].own, X_LB);
}

void Linkage::moveBody(int body, const fcl::Transform3d& X_LB) {
  moveBody(body, impl_->at(body).link, X_LB);
}

void Linkage::moveBody(int id, int link, const fcl::Transform3d& X_LB) {
  BodyData& body = impl_->at(id);
  const fcl::Transform3d X = impl_->checkedPose(*body.own, link, X_LB);
  impl_->renewed.forget();
  const bool pairs_stay = body.link == link && link >= 0;
  if (!pairs_stay) impl_->dropPairs(id);
  body.place(link, X);
  if (!pairs_stay) impl_->addPairs(id);
}

fcl::Transform3d Linkage::Impl::checkedPose(const articulated::Content& body, int link,
                                            const fcl::Transform3d& X_LB) const {
  if (link < -1 || link >= static_cast<int>(links.size())) {
    refuse("a body's link must be -1, an obstacle, or one that was added before, but is ", link,
           ".");
  }
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = continuous::orthonormal(X_LB.linear(), "pose of a body");
  X.translation() = X_LB.translation();
  requireTranslation(X_LB.translation(), "pose of a body");
  if (!body.bounded && turns(links, link)) {
    refuse("a half-space or a plane can't turn: a revolute joint carries it.");
  }
  return X;
}

void Linkage::removeBody(int id) {
  BodyData& body = impl_->at(id);
  impl_->free.push_back(id);
  impl_->renewed.forget();
  impl_->dropPairs(id);
  for (const int other : body.ignored) {
    std::vector<int>& list = impl_->bodies[other].ignored;
    list.erase(std::lower_bound(list.begin(), list.end(), id));
  }
  body = BodyData();
}

BodyData& Linkage::Impl::at(int body) {
  if (!has(body)) refuse("the linkage has no body ", body, ".");
  return bodies[body];
}

int Linkage::Impl::shared(int link_a, int link_b) const {
  const auto &a = links[link_a].moving, &b = links[link_b].moving;
  const auto length = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return static_cast<int>(std::mismatch(a.begin(), a.begin() + length, b.begin()).first -
                          a.begin());
}

int Linkage::Impl::sharedOfPair(const BodyData& a, int b) const {
  const BodyData& with = bodies[b];
  const bool checked = a.meets && with.meets && a.link != with.link && !a.ignores(b);
  return checked ? shared(with.link, a.link) : CarriedBody::kNever;
}

long long Linkage::Impl::pairs() const {
  long long pairs = 0;
  for (const CarriedBody& own : carried) {
    for (const int shared : own.shared) pairs += shared != CarriedBody::kNever ? 1 : 0;
    if (!bodies[own.body].meets) continue;
    pairs += obstacles.size();
    for (const int other : bodies[own.body].ignored) {
      pairs -= bodies[other].meets && bodies[other].carried < 0 ? 1 : 0;
    }
  }
  return pairs;
}

void Linkage::Impl::addPairs(int id) {
  BodyData& body = bodies[id];
  if (body.link < 0) {
    body.box.body = id;
    if (body.meets) obstacles.insert(body.box);
    return;
  }
  CarriedBody added;
  added.body = id;
  for (const CarriedBody& other : carried) {
    added.shared.push_back(sharedOfPair(body, other.body));
  }
  body.carried = static_cast<int>(carried.size());
  body.first_motion = num_motions;
  num_motions += static_cast<int>(links[body.link].moving.size()) + 1;
  carried.push_back(std::move(added));
}

// Bodies that were carried after it move up.
void Linkage::Impl::dropPairs(int id) {
  BodyData& body = bodies[id];
  if (body.carried < 0) {
    obstacles.remove(id);
    return;
  }
  const int place = std::exchange(body.carried, -1);
  carried.erase(carried.begin() + place);
  num_motions = 1;
  for (int i = 0; i < static_cast<int>(carried.size()); ++i) {
    CarriedBody& other = carried[i];
    if (i >= place) other.shared.erase(other.shared.begin() + place);
    BodyData& data = bodies[other.body];
    data.carried = i;
    data.first_motion = num_motions;
    num_motions += static_cast<int>(links[data.link].moving.size()) + 1;
  }
}

void Linkage::ignorePair(int a, int b, bool ignored) {
  std::vector<BodyData>& bodies = impl_->bodies;
  if (!impl_->has(a) || !impl_->has(b)) {
    refuse("a pair of bodies is allowed of which one was not added: ", a, " and ", b, ".");
  }
  if (a == b) refuse("body ", a, " is allowed to touch itself, which is never checked.");
  if (bodies[a].ignores(b) == ignored) return;
  impl_->renewed.forget();
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    std::vector<int>& list = bodies[one].ignored;
    const auto at = std::lower_bound(list.begin(), list.end(), other);
    if (ignored) {
      list.insert(at, other);
    } else {
      list.erase(at);
    }
  }
  if (bodies[a].carried < bodies[b].carried) std::swap(a, b);
  const int slot = bodies[b].carried;
  if (slot < 0) return;
  impl_->carried[bodies[a].carried].shared[slot] = impl_->sharedOfPair(bodies[a], b);
}

void Linkage::Impl::measureOctrees() {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyData& body = bodies[i];
    if (!body.own || body.kind != articulated::BodyKind::kOctree) continue;
    const auto id = static_cast<int>(i);
    dropPairs(id);
    body.own = std::make_shared<const articulated::Content>(body.own->geometry);
    body.place(body.link, body.X_LB);
    addPairs(id);
  }
}

}  // namespace kios
