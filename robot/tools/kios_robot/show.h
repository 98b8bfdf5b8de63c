// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"

namespace kios::robot_tool {

/// One self-contained HTML page: the robot among its obstacles at `from`, the nearest points; with
/// `to`, the straight path between them to be stepped along, what checkMotion() says about it, and
/// the time of its first contact. `title` heads the page.
std::string showPage(const Robot& robot, const std::string& title, const Eigen::VectorXd& from,
                     const std::optional<Eigen::VectorXd>& to, double min_separation);

}  // namespace kios::robot_tool
