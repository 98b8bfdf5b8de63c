// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "body.h"
#include "fcl_kios/robot/answers.h"

namespace kios::robot {

/// Where and how near two bodies are.
struct Nearness {
  double distance = 0;  ///< 0 in contact; infinity if proven farther than was asked
  double lower = 0;     ///< of the distance, by proof
  fcl::Vector3d point_a = fcl::Vector3d::Zero(), point_b = fcl::Vector3d::Zero();
  std::intptr_t id_a = -1, id_b = -1;
};

/// True if two bodies at poses in the world are in contact, by exact tests of triangles or FCL's of
/// two shapes; with a separation > 0, if they are at most so far apart. `contact`, if given, is
/// filled in where they are: ids and the point.
bool touching(const Body& a, const fcl::Transform3d& X_WA, const Body& b,
              const fcl::Transform3d& X_WB, double separation, RobotContact* contact = nullptr);

/// The distance of two bodies at poses in the world, with the errors that are allowed; those that
/// are farther apart than far_enough need no more than that.
Nearness distanceOf(const Body& a, const fcl::Transform3d& X_WA, const Body& b,
                    const fcl::Transform3d& X_WB, double rel_err = 0, double abs_err = 0,
                    double far_enough = std::numeric_limits<double>::infinity());

/// Returns, for two bodies in contact, the direction in the world in which b moves out of a, zero
/// if none is known; and a point of the contact.
fcl::Vector3d wayOut(const Body& a, const fcl::Transform3d& X_WA, const Body& b,
                     const fcl::Transform3d& X_WB, Nearness& near);

}  // namespace kios::robot
