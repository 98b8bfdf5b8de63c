// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fcl/geometry/collision_geometry.h>
#include "fcl_kios/linkage.h"
#include "fcl_kios/model.h"
#include "fcl_kios/robot/answers.h"

// A robot from its URDF: is it in contact, how far from it, and is a motion free? Docs:
// docs/robot.md. Lengths are in metres, angles in radians.

namespace kios {

/// Options of loadRobot().
struct RobotOptions {
  /// Folder of each package that a mesh is named by (package://name/...). Others are looked for in
  /// ROS_PACKAGE_PATH, then as share/name in AMENT_PREFIX_PATH, then from the URDF's own folder and
  /// from those above it, with the package's name and without it.
  std::map<std::string, std::string> packages;
  double padding = 0;  ///< of all links, metres, >= 0; see Robot::setPadding()
};

/// A robot, what is attached to it, and obstacles around it. It may be copied, copies share
/// geometry. Const calls are safe from many threads. Geometry must stay as it was when it was
/// added.
///
/// Names are those of links, obstacles and attached objects. All calls throw std::invalid_argument,
/// in one sentence that says what is wrong, for a name that is unknown (where one is added: in
/// use), a configuration of the wrong size or not finite, a pose that isn't rigid, a number out of
/// range; nothing is changed then.
///
/// Pairs of links, of a link and an obstacle or an attached object, of two attached objects, and of
/// an attached object and an obstacle are checked, unless ignorePair() or a file allows them. Two
/// obstacles never are, nor an attached object and its link.
class Robot {
 public:
  Robot(const Robot& other);
  Robot(Robot&& other) noexcept;
  Robot& operator=(Robot other) noexcept;
  ~Robot();

  const std::string& name() const;  ///< of the URDF
  /// Returns the size of q: joints that move and mimic nobody, in the order of the URDF. A planar
  /// joint has three coordinates (x, y, and the turn about its axis), a floating one six (x, y, z,
  /// roll, pitch, yaw).
  int coordinates() const;
  /// Names by coordinate: a joint's own, or e.g. base/yaw.
  const std::vector<std::string>& joints() const;
  const std::vector<std::string>& links() const;  ///< in the order of the URDF
  /// Limits by coordinate; infinite for continuous joints, planar and floating ones. Revolute
  /// joints whose limits are infinite, or beyond 1e6 to both sides, are continuous. Joints that
  /// mimic another have no coordinate, and their own limits are not used.
  const Eigen::VectorXd& lower() const;
  const Eigen::VectorXd& upper() const;
  /// Returns a group state of the SRDF, those of one name in several groups together. A coordinate
  /// that it doesn't name is 0, or the limit next to it.
  UnalignedVector state(const std::string& name) const;
  std::vector<std::string> states() const;  ///< names of the group states
  /// Returns a planning group of the SRDF: joints, links, chains, and groups of these.
  RobotGroup group(const std::string& name) const;
  std::vector<std::string> groups() const;  ///< names
  /// True if every coordinate is within its limits, or `slack` beyond. A straight path is, if both
  /// of its ends are.
  bool withinLimits(const Eigen::VectorXd& q, double slack = 0) const;
  /// Returns what the files say of links, joints and objects that aren't there, and what was left
  /// out of meshes: file, line, and a sentence each.
  const std::vector<std::string>& warnings() const;
  /// Returns all that can be in contact: those of the links, then of what is attached and of
  /// obstacles.
  std::vector<RobotElement> elements() const;
  /// Returns the frame of a link, an attached object or an obstacle in the root link's frame, the
  /// world.
  fcl::Transform3d pose(const std::string& link, const Eigen::VectorXd& q) const;

  /// Adds an obstacle: a finished mesh over k-IOS, one of FCL's nine shapes, or an octree.
  void addObstacle(const std::string& name, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                   const fcl::Transform3d& X_W = fcl::Transform3d::Identity());
  /// Adds an obstacle of points in the world, a point a column. Their radius is its padding, by
  /// which each is an exact ball; `id_b` of answers is the point's column. At least one point, all
  /// finite.
  void addPoints(const std::string& name, const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                 double radius = 0);
  /// Adds octomap's octree, a file .bt or .ot, as an obstacle. Throws as loadRobot().
  void addOctomap(const std::string& name, const std::string& file,
                  const fcl::Transform3d& X_W = fcl::Transform3d::Identity());
  /// Reads MoveIt's PlanningScene in YAML: obstacles, attached objects, allowed pairs. Objects of
  /// the same name are replaced. The matrix of allowed pairs decides for all pairs that it names,
  /// as in MoveIt. Throws std::invalid_argument if the file can't be read or used, with its name,
  /// the line, and what to do; nothing is changed then.
  void addScene(const std::string& file);
  /// Moves an obstacle. This, and adding, removing, attaching and detaching take as long as what
  /// they concern: microseconds among thousands of obstacles, and the next query takes no longer.
  /// The first change of a copy takes as long as copying all obstacles.
  void moveObstacle(const std::string& name, const fcl::Transform3d& X_W);
  void remove(const std::string& name);  ///< an obstacle, or what is attached
  /// Adds an object that a link carries, at X_LB in the link's frame. It may touch the link, and
  /// the links, obstacles and objects of `touch_links`, which may be added later.
  void attach(const std::string& name, const std::string& link,
              std::shared_ptr<const fcl::CollisionGeometryd> geometry, const fcl::Transform3d& X_LB,
              const std::vector<std::string>& touch_links = {});
  /// Attaches an obstacle to a link, where it is when the robot stands at q; as attach().
  void attachObstacle(const std::string& name, const std::string& link, const Eigen::VectorXd& q,
                      const std::vector<std::string>& touch_links = {});
  /// Attaches an obstacle at X_LB in the link's frame, wherever it was: a fixture on a carriage.
  void attachObstacle(const std::string& name, const std::string& link,
                      const fcl::Transform3d& X_LB,
                      const std::vector<std::string>& touch_links = {});
  /// Makes what is attached an obstacle, where it is when the robot stands at q. What was only
  /// ignored as one of its touch_links is checked again.
  void detach(const std::string& name, const Eigen::VectorXd& q);
  void ignorePair(const std::string& a, const std::string& b, bool ignored = true);
  [[deprecated("now ignorePair()")]] void allow(const std::string& a, const std::string& b,
                                                bool ignored = true) {
    ignorePair(a, b, ignored);
  }
  bool allowed(const std::string& a, const std::string& b) const;
  /// Allows the pairs of linkPairs() that need no check: kAlways and kNever.
  void ignore(const std::vector<LinkPair>& pairs);
  /// Sets the padding of a link, an attached object or an obstacle: what is nearer than the
  /// paddings of both is in contact. Exact: a distance less the paddings, no mesh is grown. Metres,
  /// >= 0; obstacles and attached objects begin with 0.
  void setPadding(const std::string& name, double metres);

  /// Finds a pair in contact, or none. Exact for meshes; docs/robot.md says what holds for shapes.
  std::optional<RobotContact> contact(const Eigen::VectorXd& q) const;
  /// Finds the pair of least clearance: distance less paddings, 0 less paddings at contact.
  RobotClearance clearance(const Eigen::VectorXd& q, const ClearanceRequest& options = {}) const;
  /// Lists all pairs of names whose clearance is at most `within`, the least first.
  std::vector<RobotClearance> clearances(const Eigen::VectorXd& q, double within) const;
  /// Decides whether the straight path in joint space is clear, as kios::checkMotion() does, of the
  /// distances less the paddings.
  RobotMotion checkMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                          const RobotMotionRequest& request = {}) const;

  /// Brackets the least clearance on the straight path from q0 to q1, or in a box. It is that of
  /// kios::leastClearance(). A box must lie within the joints' limits, unless that is not asked,
  /// and a path need not; where there are none, as of continuous joints, a range may be infinite,
  /// and one turn counts.
  RobotRange leastClearance(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                            const RangeRequest& request = {}) const;
  /// That of the straight parts between the configurations of a path, two or more.
  RobotRange leastClearance(const std::vector<Eigen::VectorXd>& path,
                            const RangeRequest& request = {}) const;
  RobotRange leastClearance(const JointBox& box, const RangeRequest& request = {},
                            bool within_limits = true) const;
  /// Brackets the least clearance of each pair of elements that is checked, that of the least lower
  /// bound first. max_queries bounds each.
  std::vector<RobotRange> leastClearances(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                          const RangeRequest& request = {}) const;
  std::vector<RobotRange> leastClearances(const JointBox& box, const RangeRequest& request = {},
                                          bool within_limits = true) const;

  // Batches: a configuration is a column. `threads` 0 is one a core. Answers are those of the calls
  // one by one.
  std::vector<char> contacts(const Eigen::MatrixXd& q, int threads = 0) const;
  std::vector<RobotClearance> clearances(const Eigen::MatrixXd& q,
                                         const ClearanceRequest& options = {},
                                         int threads = 0) const;
  std::vector<RobotMotion> checkMotions(const Eigen::MatrixXd& q0, const Eigen::MatrixXd& q1,
                                        const RobotMotionRequest& request = {},
                                        int threads = 0) const;

  /// Says what every pair of links can do within the joints' limits. What is allowed doesn't count,
  /// nor do paddings, obstacles and attached objects. Links without geometry have no pairs. Ends
  /// within PairRequest::max_seconds but for the samples, which take milliseconds a pair.
  std::vector<LinkPair> linkPairs(const PairRequest& options = {}) const;

  /// Writes the SRDF that was read, its groups and states included, with the pairs that linkPairs()
  /// found kAlways and kNever. Pairs that the file disables for another reason stay, but what it
  /// says `Never` of and is kSometimes is checked again. Without an SRDF, one of pairs alone.
  /// Comments, attributes of the root and enable_collisions aren't written.
  std::string toSrdf(const std::vector<LinkPair>& pairs) const;

  class Impl;  // hidden
  const Impl& impl() const { return *impl_; }

 private:
  friend Robot loadRobot(const std::string& urdf_file, const std::string& srdf_file,
                         const RobotOptions& options);
  explicit Robot(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads a robot from its URDF, and allowed pairs and group states from its SRDF. Without an SRDF
/// links that a joint joins are allowed to touch. Throws std::invalid_argument if a file can't be
/// read or used: its name, the line or the element, what is wrong and what to do.
Robot loadRobot(const std::string& urdf_file, const std::string& srdf_file = "",
                const RobotOptions& options = {});

/// Reads a mesh: STL, OBJ, OFF, PLY and DAE in doubles, others by assimp. Vertices of equal
/// coordinates are one, triangles stay in the file's order. Coordinates are those of the file times
/// `scale` (a COLLADA file's unit counts, its up axis does not); a negative one mirrors the mesh,
/// whose triangles then keep their outside. Appends to `warnings` what is left out of the file or
/// looks cut off. Throws std::invalid_argument as loadRobot().
std::shared_ptr<Modeld> loadMesh(const std::string& file, double scale = 1,
                                 std::vector<std::string>* warnings = nullptr);

}  // namespace kios
