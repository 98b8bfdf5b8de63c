// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/configuration.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace kios::articulated {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotationAbout(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

void requireCoordinates(const Eigen::VectorXd& q, int size, const char* name) {
  std::ostringstream message;
  if (q.size() != size) {
    message << "fcl_kios: " << name << " has " << q.size() << " coordinates, but the linkage "
            << size << ".";
  } else if (!q.allFinite()) {
    message << "fcl_kios: a coordinate of " << name << " is NaN or infinite.";
  } else {
    return;
  }
  throw std::invalid_argument(message.str());
}

}  // namespace

Path::Path(const Linkage::Impl& linkage, const Eigen::VectorXd& q0, const Eigen::VectorXd& q1)
    : linkage_(linkage), q0_(q0), q1_(q1) {
  requireCoordinates(q0, linkage.coordinates, "q0");
  requireCoordinates(q1, linkage.coordinates, "q1");
  constexpr double kSlack = 0x1p-49;  // 16 u
  changes_.resize(static_cast<std::size_t>(linkage.coordinates));
  // By link: what prismatic joints add to lengths, and the rounding of angles and of lengths.
  std::vector<double> travel(linkage.links.size()), angles = travel, shifts = travel;
  for (std::size_t i = 0; i < linkage.links.size(); ++i) {
    const LinkData& link = linkage.links[i];
    if (link.parent >= 0) {
      travel[i] = travel[link.parent];
      angles[i] = angles[link.parent];
      shifts[i] = shifts[link.parent];
    }
    if (link.coordinate < 0) continue;
    const double a = q0[link.coordinate], b = q1[link.coordinate];
    const double most = std::max(std::abs(a), std::abs(b)) * link.unit;
    changes_[link.coordinate] = std::abs(b - a) * link.unit * (1 + 0x1p-50);
    if (link.type == JointType::kPrismatic) {
      travel[i] += most * (1 + 0x1p-50);
      shifts[i] += kSlack * most;
    } else {
      angles[i] += kSlack * most;
    }
  }
  for (const BodyData& body : linkage.bodies) {
    double length = body.t_LB.norm() + body.reach, level = 2, slack = 0;
    if (body.link >= 0) {
      const LinkData& link = linkage.links[body.link];
      length += link.offsets + travel[body.link];
      level += link.level;
      slack = angles[body.link] * length + shifts[body.link];
    }
    lengths_.push_back(length * (1 + 0x1p-50));
    levels_.push_back(level);
    slacks_.push_back(slack * (1 + 0x1p-50));
  }
}

void Configuration::set(const Path& path, double s) {
  s_ = s;
  speeds_.clear();
  const auto& links = path.linkage().links;
  const auto& bodies = path.linkage().bodies;
  R_.resize(links.size());
  t_.resize(links.size());
  axes_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkData& link = links[i];
    if (link.parent < 0) {
      R_[i] = link.R_PJ;
      t_[i] = link.t_PJ;
    } else {
      R_[i].noalias() = R_[link.parent] * link.R_PJ;
      t_[i] = t_[link.parent] + R_[link.parent] * link.t_PJ;
    }
    if (link.coordinate < 0) continue;
    axes_[i] = R_[i] * link.axis;
    const double value = path.coordinate(link.coordinate, s) * link.unit;
    if (link.type == JointType::kPrismatic) {
      t_[i] += value * axes_[i];
    } else {
      R_[i] = (R_[i] * rotationAbout(link.axis, value)).eval();
    }
  }
  poses_.resize(bodies.size());
  centers_.resize(bodies.size());
  first_speed_.assign(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyData& body = bodies[i];
    fcl::Transform3d& X = poses_[i];
    X.setIdentity();
    if (body.link < 0) {
      X.linear() = body.R_LB;
      X.translation() = body.t_LB;
      centers_[i] = body.content.center;
      continue;
    }
    const Matrix3d& R = R_[body.link];
    const Vector3d& t = t_[body.link];
    X.linear().noalias() = R * body.R_LB;
    X.translation() = t + R * body.t_LB;
    centers_[i] = t + R * body.content.center;
    setSpeeds(path, static_cast<int>(i));
  }
}

void Configuration::setSpeeds(const Path& path, int id) {
  const BodyData& body = path.linkage().bodies[id];
  const auto& links = path.linkage().links;
  const auto& moving = links[body.link].moving;
  const Matrix3d& R = R_[body.link];
  const Vector3d& t = t_[body.link];
  const Vector3d ends[2] = {t + R * body.content.ends[0], t + R * body.content.ends[1]};
  const double rounding = path.axisRounding(id);
  first_speed_[id] = static_cast<int>(speeds_.size());
  speeds_.resize(speeds_.size() + moving.size() + 1);
  double* const speeds = &speeds_[first_speed_[id]];
  double speed = 0;
  speeds[moving.size()] = 0;
  for (std::size_t i = moving.size(); i-- > 0;) {
    const int link = moving[i];
    const double change = path.change(link);
    double per_unit = 1;
    if (links[link].type == JointType::kRevolute && change > 0) {
      const auto distance = [&](const Vector3d& p) {
        return axes_[link].cross(p - t_[link]).norm();
      };
      const double ball = distance(centers_[id]) + body.content.radius;
      const double capsule =
          std::max(distance(ends[0]), distance(ends[1])) + body.content.capsule_radius;
      per_unit = std::min(ball, capsule) + rounding;
      if (link == body.link) per_unit = std::min(per_unit, body.own_radius);
    }
    speed += change * per_unit;
    // For the stretch of rotations that are ones to rounding, and for the sums.
    speeds[i] = speed * (1 + 0x1p-30);
  }
}

}  // namespace kios::articulated
