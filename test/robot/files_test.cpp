// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What URDF, meshes and scenes become, by small files that the tests write.

#include <cmath>
#include <limits>

#include "fcl/expect_refused.h"
#include "files/tetrahedron.h"
#include "not_finite.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

TEST(RobotFiles, JointsOfEveryType) {
  const Folder folder;
  const Robot robot = loadRobot(manyJoints(folder));
  const std::vector<std::string> names = {"drive/x",  "drive/y", "drive/theta", "turn",
                                          "shoulder", "elbow",   "extend",      "left_finger"};
  EXPECT_EQ(robot.joints(), names);
  EXPECT_EQ(robot.coordinates(), 8);
  EXPECT_EQ(robot.links().size(), 9u);
  EXPECT_EQ(robot.links()[3], "upper");
  EXPECT_EQ(robot.lower()[3], -kInfinity);
  EXPECT_EQ(robot.upper()[0], kInfinity);
  EXPECT_EQ(robot.lower()[4], -2);
  EXPECT_EQ(robot.upper()[5], 2.5);
  EXPECT_EQ(robot.upper()[6], 0.2);
  VectorXd q(8);
  q << 0.3, -0.2, 0.5, 0.25, 0.4, -0.7, 0.1, -0.03;
  const auto about = [](double angle, const Vector3d& axis) {
    return Transform3d(Eigen::AngleAxisd(angle, axis));
  };
  const Vector3d y = Vector3d::UnitY(), z = Vector3d::UnitZ(), x = Vector3d::UnitX();
  const Transform3d cart = shifted(0, 0, 0.2) * shifted(0.3, -0.2, 0) * about(0.5, z);
  const Transform3d turret = cart * shifted(0, 0, 0.11) * about(0.25, z);
  const Transform3d upper = turret * shifted(0, 0, 0.1) * about(0.4, y);
  const Transform3d lower = upper * shifted(0, 0, 0.34) * about(0.2, x) * about(-0.7, y);
  const Transform3d slide = lower * shifted(0, 0, 0.32 + 0.1);
  const std::pair<const char*, Transform3d> expected[] = {
      {"base", Transform3d::Identity()},
      {"cart", cart},
      {"turret", turret},
      {"upper", upper},
      {"lower", lower},
      {"slide", slide},
      {"left", slide * shifted(0, 0.06 - 0.03, 0.1)},
      {"right", slide * shifted(0, -0.06 + 0.03, 0.1)},
      {"tool", slide * shifted(0, 0, 0.2)}};
  for (const auto& [name, X] : expected) {
    EXPECT_LE((robot.pose(name, q).matrix() - X.matrix()).norm(), 1e-14) << name;
  }
  // Joined links may touch, others may not.
  EXPECT_TRUE(robot.allowed("cart", "turret"));
  EXPECT_FALSE(robot.allowed("left", "right"));
}

TEST(RobotFiles, FloatingJointsTurnAboutFixedAxesAndMimicsFollowOneAnother) {
  const Folder folder;
  const Robot robot = loadRobot(folder.write(
      "f.urdf", "<robot name='f'>" + link("a") + link("b", "<sphere radius='1'/>") + link("c") +
                    link("d") + link("e") + joint("fly", "floating", "a", "b") +
                    joint("first", "continuous", "b", "c",
                          "<axis xyz='0 0 1'/>"
                          "<mimic joint='second' multiplier='2' offset='0.5'/>") +
                    joint("second", "continuous", "c", "d",
                          "<axis xyz='0 0 1'/>"
                          "<mimic joint='third' multiplier='-3' offset='0.25'/>") +
                    joint("third", "continuous", "d", "e", "<axis xyz='0 0 1'/>") + "</robot>"));
  ASSERT_EQ(robot.coordinates(), 7);
  EXPECT_EQ(robot.joints()[5], "fly/yaw");
  VectorXd q(7);
  q << 1, 2, 3, 0.1, 0.2, 0.3, 0.4;
  Transform3d X = shifted(1, 2, 3);
  X.linear() =
      (Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.1, Vector3d::UnitX()))
          .toRotationMatrix();
  EXPECT_LE((robot.pose("b", q).matrix() - X.matrix()).norm(), 1e-15);
  const double second = -3 * 0.4 + 0.25, first = 2 * second + 0.5;
  X.rotate(Eigen::AngleAxisd(first + second + 0.4, Vector3d::UnitZ()));
  EXPECT_LE((robot.pose("e", q).matrix() - X.matrix()).norm(), 1e-14);
}

// A planar joint moves across its axis, whatever that is.
TEST(RobotFiles, PlanarJointsMoveAcrossTheirAxis) {
  const Folder folder;
  for (const Vector3d& axis :
       {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(1, 0, 0), Vector3d(1, 2, -3)}) {
    const std::string text =
        std::to_string(axis.x()) + " " + std::to_string(axis.y()) + " " + std::to_string(axis.z());
    const Robot robot = loadRobot(folder.write(
        "p.urdf", "<robot name='p'>" + link("a") + link("b") +
                      joint("j", "planar", "a", "b", "<axis xyz='" + text + "'/>") + "</robot>"));
    const Transform3d X = robot.pose("b", Vector3d(0.5, -0.7, 1.1));
    EXPECT_NEAR(X.translation().dot(axis), 0, 1e-14);
    EXPECT_NEAR(X.translation().norm(), std::hypot(0.5, 0.7), 1e-14);
    EXPECT_LE((X.linear() * axis - axis).norm(), 1e-14 * axis.norm());
  }
}

TEST(RobotFiles, MeshesAreWeldedScaledAndKeepTheirOutside) {
  const Folder folder;
  const std::string file = folder.write("box.obj", boxObj(1, 2, 3));
  for (const double scale : {1.0, 0.5, -2.0}) {
    const auto model = loadMesh(file, scale);
    EXPECT_EQ(model->num_vertices, 8);
    EXPECT_EQ(model->num_tris, 12);
    EXPECT_TRUE(inspectClosedness(*model).isSolid()) << scale;
    double most = 0;
    for (int i = 0; i < 8; ++i) most = std::max(most, model->vertices[i].x());
    EXPECT_EQ(most, std::abs(scale));
  }
  expectRefused([&] { loadMesh(file, 0); }, "scale");
  expectRefused([&] { loadMesh(folder / "none.obj"); }, "no such file");
  expectRefused([&] { loadMesh(folder.write("bad.obj", "v 0 0 0\n")); }, "bad.obj");
}

TEST(RobotFiles, MeshesSayWhatTheyLeaveOut) {
  const Folder folder;
  const std::string file = folder.write("m/l.OBJ", boxObj(1, 2, 3) + "l 1 2\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(loadMesh(file, 1, &warnings)->num_tris, 12);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], file + ": 1 point or line left out.");
  const Robot robot = loadRobot(folder.write(
      "r.urdf", "<robot name='r'>" + link("a", "<mesh filename='m/l.OBJ'/>") + "</robot>"));
  EXPECT_EQ(robot.warnings(), warnings);
  // Soups are welded.
  for (const char* const name : {"t.dae", "t.stl"}) {
    const std::string kind = std::string(name).substr(2);
    EXPECT_EQ(loadMesh(folder.write(name, tetrahedron(kind)), 2)->num_vertices, 4) << name;
  }
}

TEST(RobotFiles, PackagesAreLookedForWhereRosHasThem) {
  const Folder folder;
  folder.write("ws/share/pack/m/box.obj", boxObj(1, 1, 1));
  const std::string urdf = folder.write(
      "far/r.urdf",
      "<robot name='r'>" + link("a", "<mesh filename='package://pack/m/box.obj'/>") + "</robot>");
  expectRefused([&] { loadRobot(urdf); }, "in `packages`");
  RobotOptions options;
  options.packages["pack"] = folder / "ws/share/pack";
  EXPECT_EQ(loadRobot(urdf, "", options).links().size(), 1u);
  options.packages["pack"] = folder / "ws";
  expectRefused([&] { loadRobot(urdf, "", options); }, "r.urdf:1");
  setenv("AMENT_PREFIX_PATH", ("/none:" + (folder / "ws")).c_str(), 1);
  EXPECT_EQ(loadRobot(urdf).links().size(), 1u);
  unsetenv("AMENT_PREFIX_PATH");
  setenv("ROS_PACKAGE_PATH", (folder / "ws/share").c_str(), 1);
  EXPECT_EQ(loadRobot(urdf).links().size(), 1u);
  unsetenv("ROS_PACKAGE_PATH");
}

TEST(RobotFiles, PackagesMayHaveThreeSlashes) {
  const Folder folder;
  folder.write("pkg/part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file =
      folder.write("pkg/r.urdf",
                   "<robot name='r'><link name='a'><collision><geometry><mesh "
                   "filename='package:///pkg/part.obj'/></geometry></collision></link></robot>");
  EXPECT_EQ(loadRobot(file).elements().size(), 1u);
}

TEST(RobotFiles, ScenesHoldObjectsAttachedOnesAndAllowedPairs) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const std::string scene = folder.write("scene.yaml", kScene);
  robot.addScene(scene);
  const VectorXd q = VectorXd::Zero(8);
  EXPECT_EQ(robot.pose("shelf", q).translation(), Vector3d(1, 2, 0));
  EXPECT_EQ(robot.pose("tent", q).translation(), Vector3d(5, 0, 0));
  EXPECT_LE(
      (robot.pose("cup", q).translation() - robot.pose("tool", q) * Vector3d(0, 0, 0.1)).norm(),
      1e-14);
  EXPECT_TRUE(robot.allowed("cup", "slide"));
  EXPECT_FALSE(robot.allowed("cup", "right"));
  // What it may touch, it may as long as it is attached.
  Robot other = robot;
  other.detach("cup", q);
  EXPECT_FALSE(other.allowed("cup", "slide"));
  other = robot;
  other.addScene(folder.write("cup.yaml",
                              "world:\n  collision_objects:\n    - {id: cup, "
                              "primitives: [{type: sphere, dimensions: [0.1]}]}\n"));
  EXPECT_FALSE(other.allowed("cup", "slide"));
  EXPECT_TRUE(robot.allowed("shelf", "base"));
  EXPECT_FALSE(robot.allowed("base", "cart"));  // joined, but the matrix says no
  EXPECT_TRUE(robot.allowed("turret", "cart"));
  // The sphere of the shelf lies a metre along its x, which is the world's y.
  const auto near = robot.clearances(q, 10);
  bool seen = false;
  for (const auto& pair : near) {
    if (pair.a == "base" && pair.b == "tent") seen = true;
    EXPECT_NE(pair.a + pair.b, "baseshelf");
  }
  EXPECT_TRUE(seen);
  robot.addScene(scene);  // the same names are replaced
  robot.remove("tent");
  expectRefused([&] { robot.pose("tent", q); }, "tent");
  // What a scene removes goes with what was allowed and padded.
  robot.setPadding("shelf", 0.1);
  robot.addScene(folder.write(
      "less.yaml", "world:\n  collision_objects:\n    - {id: shelf, operation: REMOVE}\n"));
  expectRefused([&] { robot.pose("shelf", q); }, "shelf");
  robot.addObstacle("shelf", std::make_shared<fcl::Sphered>(0.1), shifted(0.2, 0, 0));
  EXPECT_FALSE(robot.allowed("shelf", "base"));
  EXPECT_TRUE(robot.contact(q).has_value());
  EXPECT_EQ(robot.clearance(q).clearance, 0);
  expectRefused([&] { robot.remove("upper"); }, "link");
}

TEST(RobotFiles, LimitsThatAreHugeAreNone) {
  const Folder folder;
  const auto load = [&](const std::string& type, const std::string& lower,
                        const std::string& upper) {
    return loadRobot(folder.write(
        "one.urdf",
        "<robot name='one'>" + link("a") + link("b") +
            joint("j", type, "a", "b", "<limit lower='" + lower + "' upper='" + upper + "'/>") +
            "</robot>"));
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* const huge : {"1e16", "inf", "3.4e38", "Infinity"}) {
    const Robot robot = load("revolute", "-" + std::string(huge), huge);
    EXPECT_EQ(robot.lower()[0], -infinity);
    EXPECT_EQ(robot.upper()[0], infinity);
    EXPECT_TRUE(robot.withinLimits(VectorXd::Constant(1, 1e9)));
  }
  const Robot robot = load("revolute", "-7", "2");
  EXPECT_TRUE(robot.withinLimits(VectorXd::Constant(1, 2)));
  EXPECT_TRUE(robot.withinLimits(VectorXd::Constant(1, -7)));
  EXPECT_FALSE(robot.withinLimits(VectorXd::Constant(1, std::nextafter(2, 3))));
  EXPECT_FALSE(robot.withinLimits(VectorXd::Constant(1, -7.5)));
  EXPECT_TRUE(robot.withinLimits(VectorXd::Constant(1, -7.5), 0.5));
  expectRefused([&] { robot.withinLimits(VectorXd::Zero(1), -1); }, "slack");
  expectRefused([&] { robot.withinLimits(VectorXd::Zero(2)); }, "2 coordinates");
  EXPECT_EQ(load("prismatic", "-1e16", "1e16").upper()[0], 1e16);
  expectRefused([&] { load("prismatic", "-inf", "inf"); }, "infinite");
  expectRefused([&] { load("revolute", "0", "inf"); }, "infinite");
  expectRefused([&] { load("revolute", "inf", "inf"); }, "exceeds");
  expectRefused([&] { load("revolute", "nan", "1"); }, "finite");
}

}  // namespace
}  // namespace kios::testing
