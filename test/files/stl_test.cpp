// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// STL of both kinds as programs write it, and what is refused of it.
#include <limits>

#include "files/sample.h"

namespace kios::testing {
namespace {

TEST(Stl, BinaryFilesOfEveryHead) {
  const std::string good = tetrahedron("binary.stl");
  for (const std::string& head :
       {std::string(80, '\0'), "solid made by a program" + std::string(57, ' '),
        "solid x\nfacet normal 0 0 0" + std::string(54, '\0')}) {
    const files::Mesh mesh = readContent("a.STL", head + good.substr(80));
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(areaOf(mesh), kTetraArea, 1e-7);
    EXPECT_TRUE(mesh.warnings.empty());
    const files::Mesh more = readContent("a.stl", head + good.substr(80) + "made by a scanner");
    EXPECT_EQ(more.triangles.size(), 4u);
    EXPECT_TRUE(warnsOf(more, "17 bytes behind the last triangle"));
    const std::string padding(100, '\0');
    EXPECT_TRUE(warnsOf(readContent("a.stl", good + padding), "100 bytes behind"));
  }
}

TEST(Stl, BinaryFilesThatAreWrong) {
  std::string bad = tetrahedron("binary.stl");
  expectUnread("a.stl", bad.substr(0, 200), "counts 4 triangles, but it has 2; is it cut off?");
  expectUnread("a.stl", bad.substr(0, 50), "neither binary");
  bad[80] = 3;
  expectUnread("a.stl", bad, "counts 3 triangles, but it has 4");
  bad[80] = 0;
  expectUnread("a.stl", bad.substr(0, 84), "no triangles");
  bad = tetrahedron("binary.stl");
  bad.replace(84 + 50 + 12 + 4, 4, bytesOf(std::numeric_limits<float>::quiet_NaN()));
  expectUnread("a.stl", bad, "vertex 0 of triangle 1 is not finite");
}

TEST(Stl, TextOfEveryForm) {
  const std::string good = tetrahedron("stl");
  std::string upper = good, flat = good, normals = good;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (std::size_t i = 12; i + 1 < flat.size(); ++i) flat[i] = flat[i] == '\n' ? ' ' : flat[i];
  for (std::size_t at; (at = normals.find("0 0 0\nouter")) != std::string::npos;) {
    normals.replace(at, 5, "nan -nan(ind) 1.#IND");
  }
  for (const std::string& text : {good, upper, flat, normals, "\xEF\xBB\xBF \n" + good}) {
    const files::Mesh mesh = readContent("a.stl", text);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.parts, 1);
    EXPECT_NEAR(areaOf(mesh), kTetraArea, 1e-15);
    EXPECT_TRUE(mesh.warnings.empty());
  }
  EXPECT_EQ(readContent("a.stl", good + good).parts, 2);
  EXPECT_EQ(readContent("a.stl", good + good).triangles.size(), 8u);
}

TEST(Stl, TextThatIsWrongIsRefusedWithItsLine) {
  const std::string good = tetrahedron("stl");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  expectUnread("a.stl", good.substr(0, good.find("endsolid")), ":30: the file is cut off");
  expectUnread("a.stl", good.substr(0, good.find("endfacet")), "'endfacet' is missing");
  expectUnread("a.stl", with("endloop", "endlop"), ":7: 'endlop'");
  expectUnread("a.stl", with("vertex", "vertx"), ":4: 'vertx'");
  expectUnread("a.stl", with("0.000000 0.000000 0.000000\n", "0 0\n"), ":4: a number is missing");
  expectUnread("a.stl", with("0.000000 0.000000 0.000000\n", "0 0 inf\n"), ":4: 'inf'");
  expectUnread("a.stl", with("vertex 0.000000 0.000000 0.000000\n", ""), ":2: a facet of fewer");
  EXPECT_TRUE(warnsOf(readContent("a.stl", good + "\x1a"), ":31: what follows the last solid"));
  expectUnread("a.stl", "solid x\nendsolid x\n" + std::string(80, ' '), "no triangles");
}

TEST(Stl, EqualVerticesAreWelded) {
  std::string text = tetrahedron("stl");
  text.replace(text.find("0.000000"), 8, "-0.00000");
  files::Mesh mesh = readContent("a.stl", text);
  const double area = areaOf(mesh);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  files::weld(mesh);
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(areaOf(mesh), area);
  EXPECT_EQ(mesh.vertices[1], fcl::Vector3d(0, 1, 0));  // in the order of the file
}

}  // namespace
}  // namespace kios::testing
