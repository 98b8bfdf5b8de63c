// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"

namespace kios::robot_tool {

/// Returns a self-contained HTML page: the robot among its obstacles at the first configuration of
/// `path`, and the nearest points. Several are a path through them, straight in between, to be
/// stepped along, with what checkMotion() says about it and the time of its first contact. `title`
/// heads the page.
std::string showPage(const Robot& robot, const std::string& title,
                     const std::vector<Eigen::VectorXd>& path, double min_separation);

}  // namespace kios::robot_tool
