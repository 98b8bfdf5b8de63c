// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// URDFs, SRDFs and scenes that are wrong: refused with their place, or warned of.

#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

TEST(WrongRobotFiles, BadRobotsAreRefusedWithTheirPlace) {
  const Folder folder;
  const std::string two = link("a") + link("b");
  const std::pair<std::string, const char*> cases[] = {
      {"", "empty"},
      {"<robot", "well-formed"},
      {std::string("<robot name='r'>\0</robot>", 25), "zero byte"},
      {"<model/>", "<robot>"},
      {"<robot/>", "name"},
      {"<robot name='r'/>", "<link>"},
      {"<robot name='r'><link/></robot>", "attribute name"},
      {"<robot name='r'>" + link("a") + link("a") + "</robot>", "already"},
      {"<robot name='r'>" + two + "</robot>", "2 roots"},
      {"<robot name='r'>\n\n" + link("a", "<box size='1 1'/>") + "</robot>", ":3: <box>"},
      {"<robot name='r'>" + link("a", "<box size='1 1 1 1'/>") + "</robot>", "three finite"},
      {"<robot name='r'>" + link("a", "<box size='1 -1 1'/>") + "</robot>", "negative"},
      {"<robot name='r'>" + link("a", "<box/>") + "</robot>", "size"},
      {"<robot name='r'>" + link("a", "<sphere radius='nan'/>") + "</robot>", "finite"},
      {"<robot name='r'>" + link("a", "<sphere radius='1e999'/>") + "</robot>", "finite"},
      {"<robot name='r'>" + link("a", "<sphere radius='1'/><sphere radius='1'/>") + "</robot>",
       "second shape"},
      {"<robot name='r'>" + link("a", "<torus/>") + "</robot>", "no such shape"},
      {"<robot name='r'>" + link("a", "<mesh filename='x.stl'/>") + "</robot>", "x.stl"},
      {"<robot name='r'>" + link("a", "<mesh filename='http://x/y.stl'/>") + "</robot>", "fetched"},
      {"<robot name='r'>" + link("a", "<mesh filename='package://y'/>") + "</robot>", "package://"},
      {"<robot name='r'><link name='a'><collision/></link></robot>", "<geometry>"},
      {"<robot name='r'>" + two + joint("j", "ball", "a", "b") + "</robot>", "type"},
      {"<robot name='r'>" + two + joint("j", "fixed", "a", "c") + "</robot>", "'c'"},
      {"<robot name='r'>" + two + joint("j", "revolute", "a", "b") + "</robot>", "<limit>"},
      {"<robot name='r'>" + two + joint("j", "revolute", "a", "b", "<limit lower='2' upper='1'/>") +
           "</robot>",
       "exceeds"},
      {"<robot name='r'>" + two + joint("j", "continuous", "a", "b", "<axis xyz='0 0 0'/>") +
           "</robot>",
       "length 0"},
      {"<robot name='r'>" + two + joint("j", "continuous", "a", "b", "<mimic joint='j'/>") +
           "</robot>",
       "circle"},
      {"<robot name='r'>" + two + link("c") + joint("j", "fixed", "a", "b") +
           joint("k", "continuous", "b", "c", "<mimic joint='j'/>") + "</robot>",
       "can't mimic"},
      {"<robot name='r'>" + two + joint("j", "fixed", "a", "b") + joint("j", "fixed", "a", "b") +
           "</robot>",
       "already"},
      {"<robot name='r'>" + two + joint("j", "fixed", "a", "b") + joint("k", "fixed", "a", "b") +
           "</robot>",
       "two joints"},
      {"<robot name='r'>" + two + joint("j", "fixed", "a", "b") + joint("k", "fixed", "b", "a") +
           "</robot>",
       "circle"}};
  for (const auto& [text, word] : cases) {
    const std::string file = folder.write("bad.urdf", text);
    SCOPED_TRACE(text);
    expectRefused([&] { loadRobot(file); }, word);
    expectRefused([&] { loadRobot(file); }, "bad.urdf");
  }
  expectRefused([&] { loadRobot(folder / "none.urdf"); }, "no such file");
  expectRefused([&] { loadRobot("."); }, "directory");
  RobotOptions options;
  options.padding = -1;
  expectRefused([&] { loadRobot(manyJoints(folder), "", options); }, "padding");
  expectRefused(
      [&] {
        loadRobot(manyJoints(folder), folder.write("s",
                                                   "<robot><disable_collisions"
                                                   "/></robot>"));
      },
      "link1");
}

TEST(WrongRobotFiles, WhatNamesNothingIsWarnedOf) {
  const Folder folder;
  const std::string urdf =
      "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
      "<parent link='a'/><child link='b'/><mimic joint='gone'/></joint></robot>";
  const std::string srdf =
      "<robot name='other'><disable_collisions link1='a' link2='c'/>"
      "<disable_default_collisions link='d'/></robot>";
  Robot robot = loadRobot(folder.write("r.urdf", urdf), folder.write("r.srdf", srdf));
  robot.addScene(folder.write(
      "s.yaml",
      "world: {}\nallowed_collision_matrix: {entry_names: [a, e], entry_values: [[0, 1], "
      "[1, 0]]}"));
  const std::vector<std::string>& warnings = robot.warnings();
  const char* const of[] = {"r.urdf:1: ", "'gone'",     "r.srdf:1: ", "'r'",      "r.srdf:1: ",
                            "'d'",        "r.srdf:1: ", "'c'",        "s.yaml: ", "'e'"};
  ASSERT_EQ(warnings.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NE(warnings[i].find(of[2 * i]), std::string::npos) << warnings[i];
    EXPECT_NE(warnings[i].find(of[2 * i + 1]), std::string::npos) << warnings[i];
  }
  EXPECT_EQ(robot.joints(), std::vector<std::string>{"j"});  // moves on its own
  EXPECT_TRUE(loadRobot(manyJoints(folder)).warnings().empty());
}

TEST(WrongRobotFiles, BadScenesAreRefusedAndChangeNothing) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const std::string object = "world:\n  collision_objects:\n    - id: x\n";
  const std::pair<std::string, const char*> cases[] = {
      {"{", "no YAML"},
      {"[1, 2]", "planning scene"},
      {"cell\n* shelf\n0 0 0\n0 0 0 1\n1\nbox\n1 1 1\n.\n", "MoveIt's text format"},
      {"a: b", "planning scene"},
      {"world: 3", "map"},
      {"world: {collision_objects: 3}", "list"},
      {"world: {collision_objects: [3]}", "map"},
      {"world: {collision_objects: [{}]}", "name is missing"},
      {object, "no shape"},
      {object + "      primitives: [{type: box, dimensions: [1, 2]}]", "3 dimensions"},
      {object + "      primitives: [{type: box, dimensions: [1, 2, -1]}]", "negative"},
      {object + "      primitives: [{type: box, dimensions: [1, 2, .nan]}]", "finite"},
      {object + "      primitives: [{type: torus, dimensions: [1]}]", "torus"},
      {object + "      primitives: [{type: sphere, dimensions: [1]}]\n      primitive_poses: "
                "[{position: [1, 2]}]",
       "xyz"},
      {object + "      primitives: [{type: sphere, dimensions: [1]}]\n      primitive_poses: "
                "[{orientation: [1, 2, 3, 4]}]",
       "quaternion"},
      {object + "      primitives: [{type: sphere, dimensions: [1]}]\n      primitive_poses: "
                "[{}, {}]",
       "primitive_poses"},
      {object + "      header: {frame_id: upper}\n      primitives: [{type: sphere, dimensions: "
                "[1]}]",
       "the joint 'shoulder' moves the frame 'upper'"},
      {object + "      meshes: [{vertices: [[0, 0, 0]], triangles: [[0, 0, 1]]}]", "indices"},
      {object + "      meshes: [{vertices: [[0, 0, 0]], triangles: []}]", "without triangles"},
      {object + "      meshes: [{mesh_resource: part.stl}]", "a mesh_resource isn't read"},
      {"world: {octomap: {octomap: {data: [1]}}}", "as a file, .bt or .ot"},
      {object + "      operation: MOVE", "ADD"},
      {"world: {collision_objects: [{id: upper, primitives: []}]}", "link's name"},
      {"robot_state: {attached_collision_objects: [{link_name: none}]}", "none"},
      {"world: {}\nallowed_collision_matrix: {entry_names: [a], entry_values: []}", "rows"},
      {"world: {}\nallowed_collision_matrix: {entry_names: [a], entry_values: [[1, 2]]}", "row"},
      {"world: {}\nallowed_collision_matrix: {entry_names: [a, b], entry_values: [[0, 5], [0, 0]]}",
       "true or false"},
      {"world: {}\nlink_scale: [{link_name: upper, scale: 2}]", "pad"},
      // What is misspelt, or stands where it isn't read, would be an obstacle that isn't there.
      {"world: {collision_object: [{id: x}]}", "'collision_object'"},
      {object + "      primitives: [{type: sphere, dimensions: [1]}]\n      primitive_pose: "
                "[{position: [1, 2, 3]}]",
       "'primitive_pose'"},
      {object + "      primitives: [{type: sphere, dimension: [1]}]", "'dimension'"},
      {object + "      header: {frame: upper}\n      primitives: [{type: sphere, dimensions: [1]}]",
       "'frame'"},
      {"name: x\nscene: {world: {collision_objects: []}}", "'scene'"},
      {"world: {}\n---\nworld: {collision_objects: [{id: x}]}", "second document"},
      {"world: {}\nworld: {collision_objects: [{id: x}]}", "twice"},
      {"world: {}\nallowed_collision_matrix: {default_entry_name: [a]}", "'default_entry_name'"}};
  const VectorXd q = VectorXd::Zero(8);
  const double before = robot.clearance(q).clearance;
  for (const auto& [text, word] : cases) {
    const std::string file = folder.write("bad.yaml", text);
    SCOPED_TRACE(text);
    expectRefused([&] { robot.addScene(file); }, word);
    expectRefused([&] { robot.addScene(file); }, "bad.yaml");
  }
  expectRefused([&] { robot.pose("x", q); }, "'x'");
  EXPECT_EQ(robot.clearance(q).clearance, before);
}

}  // namespace
}  // namespace kios::testing
