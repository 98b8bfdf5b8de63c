// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Obstacles from octomap's files.

#include <fcl/config.h>
#if FCL_HAVE_OCTOMAP
#include <octomap/OcTree.h>

#include <fcl/geometry/octree/octree.h>
#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

std::shared_ptr<octomap::OcTree> someCells() {
  auto tree = std::make_shared<octomap::OcTree>(0.05);
  Random random(3);
  for (int i = 0; i < 600; ++i) {
    tree->updateNode(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1), i % 4 > 0);
  }
  return tree;
}

TEST(RobotOctomaps, AreThoseOfOctomap) {
  const Folder folder;
  const std::string urdf = folder.write(
      "o.urdf", "<robot name='o'>" + link("a") + link("b", "<mesh filename='meshes/rod.obj'/>") +
                    joint("j", "floating", "a", "b") + "</robot>");
  folder.write("meshes/rod.obj", boxObj(0.1, 0.02, 0.15));
  const auto tree = someCells();
  tree->getRoot()->setLogOdds(-2);  // as lazy updates leave inner nodes
  ASSERT_TRUE(tree->write(folder / "cells.ot"));
  tree->updateInnerOccupancy();
  ASSERT_TRUE(tree->writeBinary(folder / "cells.bt"));
  Robot wanted = loadRobot(urdf), binary = wanted, full = wanted;
  wanted.addObstacle("cells",
                     std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree)),
                     shifted(0.1, 0, 0));
  binary.addOctomap("cells", folder / "cells.bt", shifted(0.1, 0, 0));
  full.addOctomap("cells", folder / "cells.ot", shifted(0.1, 0, 0));
  Random random(1);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    VectorXd q(6);
    for (double& x : q) x = random.uniform(-1, 1);
    const double distance = wanted.clearance(q).clearance;
    EXPECT_EQ(binary.clearance(q).clearance, distance);
    EXPECT_EQ(full.clearance(q).clearance, distance);
    contacts += wanted.contact(q) ? 1 : 0;
    EXPECT_EQ(binary.contact(q).has_value(), wanted.contact(q).has_value());
  }
  EXPECT_TRUE(contacts > 5 && contacts < 195) << contacts;
}

TEST(RobotOctomaps, DamagedFilesAreRefused) {
  const Folder folder;
  Robot robot = loadRobot(folder.write("o.urdf", "<robot name='o'>" + link("a") + "</robot>"));
  const auto tree = someCells();
  tree->write(folder / "cells.ot");
  tree->writeBinary(folder / "cells.bt");
  for (const char* const name : {"cells.ot", "cells.bt"}) {
    const std::string content = contentOf(folder / name);
    for (std::size_t size = 0; size < content.size(); size += 1 + size / 20) {
      const std::string cut = folder.write("cut", content.substr(0, size));
      expectRefused([&] { robot.addOctomap("cells", cut); }, "cut: ");
    }
    expectRefused([&] { robot.addOctomap("cells", folder.write("more", content + "x")); },
                  "follow");
    Random random(2);
    for (int i = 0; i < 300; ++i) {  // refused or read
      std::string altered = content;
      altered[static_cast<std::size_t>(random.uniform(100, static_cast<double>(content.size())))] =
          static_cast<char>(random.uniform(0, 255));
      try {
        robot.addOctomap("cells", folder.write("altered", altered));
        robot.remove("cells");
      } catch (const std::invalid_argument&) {
      }
    }
  }
  const std::string head = "# Octomap OcTree file\nid ColorOcTree\nsize 1\nres 0.1\ndata\n";
  expectRefused([&] { robot.addOctomap("c", folder.write("color", head + "abcdefgh")); },
                "but is 'ColorOcTree'");
  expectRefused([&] { robot.addOctomap("c", folder.write("mesh.stl", "solid\n")); }, "no octomap");
  expectRefused([&] { robot.addOctomap("c", folder / "none.bt"); }, "none.bt");
  EXPECT_TRUE(robot.elements().empty());
}

}  // namespace
}  // namespace kios::testing
#endif
