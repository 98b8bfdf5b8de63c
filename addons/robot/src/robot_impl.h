// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cell.h"
#include "fcl_kios/robot/robot.h"

namespace kios {

/// What a robot is told; the cell that answers is made of it by the first query.
class Robot::Impl {
 public:
  explicit Impl(std::shared_ptr<const robot::Arm> the_arm) : arm(std::move(the_arm)) {}
  Impl(const Impl& other);
  Impl& operator=(const Impl&) = delete;
  ~Impl() = default;

  const robot::Cell& cell() const;
  void changed() {
    ready_ = false;
    cell_.reset();
  }

  int entityOf(const std::string& name) const;  ///< -1 if there is none; objects follow the links
  int requireEntity(const std::string& name) const;
  int requireLink(const std::string& name) const;
  void requireConfiguration(const Eigen::VectorXd& q, const char* what) const;
  void add(robot::Object object);
  void forget(const std::string& name);  ///< an object; what is known of its name stays
  void remove(const std::string& name);  ///< with its paddings and allowed pairs

  std::shared_ptr<const robot::Arm> arm;
  std::vector<robot::Object> objects;
  std::set<robot::NamePair> allowed;
  std::map<std::string, double> paddings;
  std::vector<std::string> warnings;

 private:
  mutable std::atomic<bool> ready_{false};
  mutable std::mutex guard_;
  mutable std::shared_ptr<const robot::Cell> cell_;
};

}  // namespace kios
