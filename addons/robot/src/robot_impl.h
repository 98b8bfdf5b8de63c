// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "cell.h"
#include "fcl_kios/robot/robot.h"

namespace kios {

/// What a robot is told. The first query makes the cell that answers of it, which then changes
/// along with it; copies share it until one of them changes.
class Robot::Impl {
 public:
  explicit Impl(std::shared_ptr<const robot::Arm> the_arm);
  Impl(const Impl& other);
  Impl& operator=(const Impl&) = delete;
  ~Impl() = default;

  const robot::Cell& cell() const;
  /// The cell is made anew by the next query.
  void changed() {
    ready_ = shared_ = false;
    cell_.reset();
  }

  int entityOf(const std::string& name) const;  ///< -1 if there is none; objects follow the links
  int requireEntity(const std::string& name) const;
  int requireLink(const std::string& name) const;
  void requireConfiguration(const Eigen::VectorXd& q, const char* what) const;
  /// The object of an entity; nullptr of a link.
  robot::Object* objectOf(int entity);
  /// Requires an object that is attached, or one that isn't; `done` says what can't be done else.
  int requireObject(const std::string& name, bool attached, const char* done) const;
  /// Objects that are there, in their order, those that are attached first.
  std::vector<const robot::Object*> ordered() const;

  void add(robot::Object object, const std::vector<std::string>& touch = {}, double padding = 0);
  void move(int entity, const fcl::Transform3d& X);
  /// Puts an object onto a link, or into the world: -1.
  void carry(int entity, int link, const fcl::Transform3d& X,
             const std::vector<std::string>& touch);
  void forget(const std::string& name);  ///< an object; what is known of its name stays
  void remove(const std::string& name);  ///< with its paddings and ignored pairs
  /// May concern names that aren't there yet.
  void ignore(const std::string& a, const std::string& b, bool ignored);
  bool ignores(const std::string& a, const std::string& b) const;
  void setPadding(const std::string& name, double metres);
  fcl::Transform3d poseOf(int link, const Eigen::VectorXd& q,
                          const fcl::Transform3d& X_LB = fcl::Transform3d::Identity()) const;

  std::shared_ptr<const robot::Arm> arm;
  std::vector<std::string> warnings;

 private:
  void requireCarried(const robot::Object& object, int link) const;  ///< by a link that moves
  static void requireReach(const robot::Object& object, const fcl::Transform3d& X);
  robot::Entity entity(int entity) const;
  /// What changes an object in the cell, if there is one already.
  template <typename Change>
  void inCell(const Change& change);
  void refresh(const std::string& name);  ///< in the cell, once its padding or pairs changed
  void touch(robot::Object& object, const std::vector<std::string>& names);
  void untouch(robot::Object& object);
  void dropTouch(const std::string& of, const std::string& name);  ///< a name from a list
  /// Why a pair is ignored, by one of its names: told to, its own touch list, or the other's.
  enum Ignored : unsigned { kTold = 1, kOwnTouch = 2, kOthersTouch = 4 };
  void setIgnored(const std::string& a, const std::string& b, unsigned by, bool on);

  std::vector<robot::Object> objects_;
  std::vector<int> free_;  // their places
  long long orders_ = 0;
  std::unordered_map<std::string, int> entities_;
  std::map<std::string, std::map<std::string, unsigned>> ignored_;  // both ways; of Ignored
  std::map<std::string, double> paddings_;

  mutable std::atomic<bool> ready_{false};
  mutable std::mutex guard_;
  mutable std::shared_ptr<robot::Cell> cell_;
  mutable std::atomic<bool> shared_{false};  ///< the cell may be another's, too
};

}  // namespace kios
