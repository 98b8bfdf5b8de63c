// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// OFF as programs write it, and what is refused of it.
#include "files/sample.h"

namespace kios::testing {
namespace {

const std::string kVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kTriangles = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST(Off, HeadsAndColoursOfEveryForm) {
  const std::string colored = "3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3 7\n3 0 3 2\n";
  const std::string files[] = {
      "OFF\n4 4 6\n" + kVertices + kTriangles,
      "OFF 4 4 0\n" + kVertices + kTriangles,
      "OFF4 4 0\n" + kVertices + kTriangles,
      "OFF\n4 4\n" + kVertices + kTriangles,  // without edges
      "\n# a\nOFF # b\n\n4 4 0 # c\n" + kVertices + "\n# d\n" + colored + "\n\n",
      "COFF\n4 4 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n0 0 1 1 0 0 1\n" + colored,
      "OFF\n4 4 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n0 0 1 9 9 9\n" + kTriangles,
      "NOFF\n4 4 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n" + kTriangles,
      "STCNOFF 4 4 0\n0 0 0 0 0 1 9 9 9 9 1 1\n1 0 0 0 0 1 9 9 9 9 1 1\n"
      "0 1 0 0 0 1 9 9 9 9 1 1\n0 0 1 0 0 1 9 9 9 9 1 1\n" +
          kTriangles};
  for (const std::string& text : files) {
    SCOPED_TRACE(text);
    const files::Mesh mesh = readContent("a.Off", text);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(areaOf(mesh), kTetraArea, 1e-15);
    EXPECT_TRUE(mesh.warnings.empty());
  }
}

TEST(Off, LinesMayEndAnywhere) {
  std::string text = "OFF 4 4 0 " + kVertices + kTriangles;
  for (char& c : text) c = c == '\n' ? ' ' : c;
  EXPECT_NEAR(areaOf(readContent("a.off", text + "\n")), kTetraArea, 1e-15);
  for (char& c : text) c = c == ' ' ? '\n' : c;
  text.replace(0, 10, "OFF\n4 4 0\n");
  EXPECT_NEAR(areaOf(readContent("a.off", text + "\n")), kTetraArea, 1e-15);
  // Two vertices a line, which might be a vertex and its colour.
  EXPECT_NEAR(areaOf(readContent("a.off", "OFF\n4 4 0\n0 0 0 1 0 0\n0 1 0 0 0 1\n" + kTriangles)),
              kTetraArea, 1e-15);
}

TEST(Off, WhatIsWrongIsRefusedWithItsLine) {
  const std::string good = "OFF\n4 4 0\n" + kVertices;
  const std::pair<std::string, const char*> files[] = {
      {"4 4 0\n" + kVertices + kTriangles, ":1: it doesn't begin with OFF"},
      {"4OFF\n4 4 0\n" + kVertices + kTriangles, ":1: '4OFF' isn't read"},
      {"OFF BINARY\n4 4 0\n", ":1: 'BINARY'"},
      {"OFF\n4\n" + kVertices, ":2: a number is missing"},
      {"OFF\n4 -4 0\n" + kVertices + kTriangles, ":2: a count is negative"},
      {"OFF\n5 4 0\n" + kVertices + kTriangles, ":"},
      {"OFF\n4 5 0\n" + kVertices + kTriangles, "it has 4 of 5 faces"},
      {"OFF\n4 3 0\n" + kVertices + kTriangles, ":10: more follows"},
      {"OFF\n4000000000 4000000000 0\n" + kVertices, "cut off"},
      {good + "3 0 2 1\n3 0 1 3\n3 1 2 4\n3 0 3 2\n", ":9: face 2 refers to vertex 4"},
      {good + "3 0 2 1\n3 0 1 3\n3 1 2 -1\n3 0 3 2\n", ":9: face 2 refers to vertex -1"},
      {good + "3 0 2 1\n3 0 1 3\n3 1 2\n3 0 3 2\n", ":9: a number is missing"},
      {good + "3 0 2 1\n3 0 1 3\n0\n3 0 3 2\n", ":9: a face without"},
      {good + "3 0 2 1\n3 0 1 3\n3 1 2 3 9 9\n3 0 3 2\n", ":9: "},
      {good + "3 0 2 1\n3 0 1 3\n3 1 2 3.5\n3 0 3 2\n", ":9: "},
      {"OFF\n4 4 0\n0 0 0\n1 0 nan\n0 1 0\n0 0 1\n" + kTriangles, ":4: 'nan'"},
      {"OFF\n4 1 0\n" + kVertices + "2 0 1\n", "1 point or line"},
      {"OFF", "cut off"}};
  for (const auto& [text, part] : files) expectUnread("a.off", text, part);
  EXPECT_TRUE(warnsOf(readContent("a.off", "OFF\n4 2 0\n" + kVertices + "3 0 1 2\n1 3\n"),
                      "1 point or line left out"));
}

}  // namespace
}  // namespace kios::testing
