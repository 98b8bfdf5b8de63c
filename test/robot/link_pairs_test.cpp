// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of links: proofs against samples, gaps that shrink to nothing, joints without limits.

#include <cmath>
#include <iomanip>
#include <sstream>

#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

/// Are two links in contact at q, whatever is allowed?
bool meetAt(Robot& alone, const LinkPair& pair, const VectorXd& q) {
  for (const auto& near : alone.clearances(q, 0)) {
    if (near.a == pair.a && near.b == pair.b) return true;
    if (near.a == pair.b && near.b == pair.a) return true;
  }
  return false;
}

/// Nothing is allowed.
Robot strict(Robot robot) {
  for (const std::string& a : robot.links()) {
    for (const std::string& b : robot.links()) {
      if (a != b) robot.ignorePair(a, b, false);
    }
  }
  return robot;
}

void expectRight(const Robot& given, const std::vector<LinkPair>& pairs, int samples) {
  Robot robot = strict(given);
  Random random(1);
  for (const LinkPair& pair : pairs) {
    SCOPED_TRACE(pair.a + " " + pair.b);
    if (pair.q.size() > 0) {
      EXPECT_TRUE(meetAt(robot, pair, pair.q));
    }
    EXPECT_TRUE(pair.verdict != PairVerdict::kSometimes || pair.q.size() > 0);
  }
  for (int i = 0; i < samples; ++i) {
    const VectorXd q = randomConfiguration(robot, random);
    for (const auto& near : robot.clearances(q, 0)) {
      for (const LinkPair& pair : pairs) {
        const bool same =
            (near.a == pair.a && near.b == pair.b) || (near.a == pair.b && near.b == pair.a);
        EXPECT_FALSE(same && pair.verdict == PairVerdict::kNever) << pair.a << " " << pair.b;
      }
    }
  }
}

int count(const std::vector<LinkPair>& pairs, PairVerdict verdict) {
  int n = 0;
  for (const LinkPair& pair : pairs) n += pair.verdict == verdict ? 1 : 0;
  return n;
}

TEST(LinkPairs, MotionBenchMakersRobotsAreSettled) {
  for (const char* const name : {"panda", "ur5"}) {
    if (mbmFolder(name).empty()) GTEST_SKIP() << "no MotionBenchMaker data";
    const Robot robot = loadMbm(name);
    const auto pairs = robot.linkPairs();
    EXPECT_EQ(count(pairs, PairVerdict::kOpen), 0);
    EXPECT_GT(count(pairs, PairVerdict::kNever), 20);
    EXPECT_GT(count(pairs, PairVerdict::kSometimes), 20);
    expectRight(robot, pairs, 1000);
  }
}

TEST(LinkPairs, AllShapesAndJoints) {
  const Folder folder;
  const Robot robot = loadRobot(manyJoints(folder));
  PairRequest options;
  options.max_seconds = std::numeric_limits<double>::infinity();
  const auto pairs = robot.linkPairs(options);
  EXPECT_EQ(pairs.size(), 28u);  // of eight links with geometry
  expectRight(robot, pairs, 20000);
  EXPECT_GE(count(pairs, PairVerdict::kAlways), 7);
  EXPECT_GT(count(pairs, PairVerdict::kSometimes), 5);
  EXPECT_EQ(count(pairs, PairVerdict::kOpen), 0);
  const std::string srdf = toSrdf(pairs, robot.name());
  EXPECT_NE(srdf.find("reason=\"Adjacent\""), std::string::npos);
  // What is written is read again, and hides no contact.
  const Robot again = loadRobot(folder / "arm.urdf", folder.write("a.srdf", srdf));
  for (const LinkPair& pair : pairs) {
    EXPECT_EQ(again.allowed(pair.a, pair.b), pair.verdict != PairVerdict::kSometimes);
  }
}

/// Returns a ball on an arm of two joints swings past a ball: a gap of so much where they are
/// nearest.
Robot swinging(const Folder& folder, double gap) {
  const std::string far = std::to_string(1.0 + 0.2 + gap);
  return loadRobot(folder.write(
      "s.urdf",
      "<robot name='s'>" +
          link("post", "<sphere radius='0.1'/>", "<origin xyz='" + far + " 0 0'/>") +
          link("first") + link("ball", "<sphere radius='0.1'/>", "<origin xyz='0.5 0 0'/>") +
          joint("j", "revolute", "post", "first",
                "<axis xyz='0 0 1'/><limit lower='-3' upper='2.5'/>") +
          joint("k", "continuous", "first", "ball", "<origin xyz='0.5 0 0'/><axis xyz='0 0 1'/>") +
          "</robot>"));
}

TEST(LinkPairs, SmallGapsAreProvenAndSmallOverlapsFound) {
  const Folder folder;
  for (const double gap : {0.1, 0.01, 0.001}) {
    const auto apart = swinging(folder, gap).linkPairs();
    ASSERT_EQ(apart.size(), 1u);
    EXPECT_EQ(apart[0].verdict, PairVerdict::kNever) << gap;
    const Robot robot = swinging(folder, -gap);
    const auto meet = robot.linkPairs();
    ASSERT_EQ(meet[0].verdict, PairVerdict::kSometimes) << gap;
    Robot alone = strict(robot);
    EXPECT_TRUE(meetAt(alone, meet[0], meet[0].q));
  }
  PairRequest none;
  none.max_boxes = 3;
  EXPECT_EQ(swinging(folder, 0.001).linkPairs(none)[0].verdict, PairVerdict::kOpen);
  none.max_boxes = -1;
  expectRefused([&] { swinging(folder, 1).linkPairs(none); }, "max_boxes");
  PairRequest late;
  late.max_seconds = 0;
  EXPECT_EQ(swinging(folder, 1e-7).linkPairs(late)[0].verdict, PairVerdict::kOpen);
  late.max_seconds = -1;
  expectRefused([&] { swinging(folder, 1).linkPairs(late); }, "max_seconds");
}

// Without an SRDF links that no joint joins may overlap wherever they are.
TEST(LinkPairs, PairsThatAlwaysOverlapAreFoundAndIgnored) {
  const Folder folder;
  Robot robot = loadRobot(folder.write(
      "o.urdf",
      "<robot name='o'>" + link("a<", "<sphere radius='0.2'/>") + link("b") +
          link("c", "<sphere radius='0.2'/>") + link("d", "<sphere radius='0.05'/>") +
          joint("j", "continuous", "a<", "b", "<axis xyz='0 0 1'/>") +
          joint("k", "continuous", "b", "c", "<origin xyz='0.1 0 0'/><axis xyz='0 0 1'/>") +
          joint("l", "continuous", "c", "d", "<origin xyz='0.5 0 0'/><axis xyz='0 0 1'/>") +
          "</robot>"));
  const VectorXd q = VectorXd::Zero(3);
  EXPECT_TRUE(robot.contact(q));
  std::vector<std::size_t> settled;
  PairRequest options;
  options.threads = 1;
  options.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 3u);
    settled.push_back(done);
  };
  const auto pairs = robot.linkPairs(options);
  EXPECT_EQ(settled, (std::vector<std::size_t>{1, 2, 3}));
  ASSERT_EQ(pairs[0].a + " " + pairs[0].b, "a< c");
  EXPECT_EQ(pairs[0].verdict, PairVerdict::kAlways);
  EXPECT_TRUE(meetAt(robot, pairs[0], pairs[0].q));
  EXPECT_EQ(pairs[1].verdict, PairVerdict::kNever);
  const Robot again =
      loadRobot(folder / "o.urdf", folder.write("o.srdf", toSrdf(pairs, robot.name())));
  EXPECT_TRUE(again.warnings().empty());
  EXPECT_FALSE(again.contact(q));
  robot.ignore(pairs);
  EXPECT_FALSE(robot.contact(q));
  LinkPair other;
  other.a = "a<";
  other.b = "e";
  expectRefused([&] { robot.ignore({other}); }, "'e'");
}

// What an SRDF has beside pairs stays, and what it knows of them but for what is proven wrong.
TEST(LinkPairs, ASrdfIsWrittenWithItsGroups) {
  const Folder folder;
  const std::string ball = "<sphere radius='0.1'/>";
  const std::string urdf = folder.write(
      "o.urdf", "<robot name='o'>" + link("a", ball) + link("b &amp; c", ball) + link("d", ball) +
                    link("e", ball) +
                    joint("j", "fixed", "a", "b &amp; c", "<origin xyz='1 0 0'/>") +
                    joint("k", "prismatic", "b &amp; c", "d",
                          "<axis xyz='1 0 0'/><limit lower='-0.9' upper='0.9'/>") +
                    joint("l", "fixed", "b &amp; c", "e", "<origin xyz='0 2 0'/>") + "</robot>");
  const std::string old = folder.write(
      "old.srdf",
      "<robot name='o'><group name='arm'><chain base_link='a' tip_link='d'/></group>"
      "<group_state name='home' group='arm'><joint name='k' value='0.5'/></group_state>"
      "<end_effector name='hand' parent_link='d' group='arm' parent_group='arm'/>"
      "<disable_collisions link1='a' link2='d' reason='Never'/>"
      "<disable_collisions link1='a' link2='e' reason='User'/>"
      "<disable_collisions link1='d' link2='e' reason='Default'/></robot>");
  const Robot robot = loadRobot(urdf, old);
  const std::string text = robot.toSrdf(robot.linkPairs());
  const Robot again = loadRobot(urdf, folder.write("new.srdf", text));
  EXPECT_TRUE(again.warnings().empty());
  EXPECT_EQ(again.state("home")[0], 0.5);
  EXPECT_EQ(again.group("arm").coordinates, robot.group("arm").coordinates);
  EXPECT_EQ(again.group("arm").end_effectors, std::vector<std::string>{"arm"});
  EXPECT_NE(text.find("link1=\"a\" link2=\"b &amp; c\" reason=\"Adjacent\""), std::string::npos);
  EXPECT_NE(text.find("link1=\"a\" link2=\"e\" reason=\"Never\""), std::string::npos);
  EXPECT_FALSE(again.allowed("a", "d")) << "they meet, whatever the file says";
  EXPECT_EQ(again.toSrdf({}), text);
  EXPECT_NE(robot.toSrdf({}).find("reason=\"User\""), std::string::npos);
}

// The tip of a mesh reaches a ball at one angle only, which no sample finds.
TEST(LinkPairs, NoProofPassesOverAContact) {
  const Folder folder;
  folder.write("needle.obj", "v 1 0 0\nv 0.5 0.001 0\nv 0.5 -0.001 0\nf 1 2 3\n");
  for (const double angle : {-2.7, -1.234, -0.51, 0.3, 0.777, 1.9, 2.71}) {
    SCOPED_TRACE(angle);
    const double far = 1.01 - 1e-10;
    std::ostringstream place;
    place << std::setprecision(17) << "<origin xyz='" << far * std::cos(angle) << " "
          << far * std::sin(angle) << " 0'/>";
    const Robot robot = loadRobot(folder.write(
        "n.urdf", "<robot name='n'>" + link("post", "<sphere radius='0.01'/>", place.str()) +
                      link("first") + link("needle", "<mesh filename='needle.obj'/>") +
                      joint("f", "fixed", "post", "first") +
                      joint("j", "revolute", "first", "needle",
                            "<axis xyz='0 0 1'/><limit lower='-3' upper='3'/>") +
                      "</robot>"));
    const auto pairs = robot.linkPairs();
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].verdict, PairVerdict::kSometimes) << pairs[0].boxes << " boxes";
  }
}

// One coordinate moves two fingers towards each other; they stop before they meet, or don't.
TEST(LinkPairs, JointsThatMimicMoveTogether) {
  const Folder folder;
  const auto hand = [&](double most) {
    const std::string limit = "<limit lower='0' upper='" + std::to_string(most) + "'/>";
    return loadRobot(folder.write(
        "h.urdf",
        "<robot name='h'>" + link("palm") + link("l", "<box size='0.1 0.1 0.1'/>") +
            link("r", "<box size='0.1 0.1 0.1'/>") +
            joint("a", "prismatic", "palm", "l",
                  "<origin xyz='0.2 0 0'/><axis xyz='-1 0 0'/>" + limit) +
            joint("b", "prismatic", "palm", "r",
                  "<origin xyz='-0.2 0 0'/><axis xyz='1 0 0'/>" + limit + "<mimic joint='a'/>") +
            "</robot>"));
  };
  EXPECT_EQ(hand(0.149).linkPairs()[0].verdict, PairVerdict::kNever);
  EXPECT_EQ(hand(0.151).linkPairs()[0].verdict, PairVerdict::kSometimes);
}

}  // namespace
}  // namespace kios::testing
