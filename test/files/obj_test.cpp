// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Wavefront OBJ as programs write it, and what is refused of it.
#include "files/sample.h"

namespace kios::testing {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, IndicesOfEveryForm) {
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/4/7 2/5/8 3/6/9",
                           "f 1/ 2/ 3/", "f -3 -2 -1", "f 1 -2 3", "fo 1 2 3", "  f\t1  2\v3 ",
                           "f 1 2 3 # a comment", "f +1 2 3#"}) {
    if (std::string(face).find('+') != std::string::npos) {
      expectUnread("a.obj", kTriangle + face + "\n", ":4: ");
      continue;
    }
    const files::Mesh mesh = readContent("a.obj", kTriangle + face + "\n");
    ASSERT_EQ(mesh.triangles.size(), 1u) << face;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(mesh.triangles[0][c], c) << face;
    EXPECT_TRUE(mesh.warnings.empty()) << face;
  }
  // A face may stand before its vertices.
  EXPECT_EQ(readContent("a.OBJ", "f 1 2 3\n" + kTriangle).triangles.size(), 1u);
}

TEST(Obj, DigitsAreThoseOfDoubles) {
  const files::Mesh mesh = readContent("map.obj",
                                       "v 448262.3 4582940.7 12.5\nv 448262.5 +4582940.7 1.25e1\n"
                                       "v 448262.3 4582940.9 1e-400\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0], fcl::Vector3d(448262.3, 4582940.7, 12.5));
  EXPECT_EQ(mesh.vertices[1], fcl::Vector3d(448262.5, 4582940.7, 12.5));
  EXPECT_EQ(mesh.vertices[2].z(), 0);
}

// A comment ends with its line, whatever Python takes for the end of one.
TEST(Obj, LinesEndWithTheirBreaksAlone) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBF# a\fv 7 7 7 \xE2\x80\xA8v 8 8 8 \xC2\x85v 9 9 9 \\\n" +
                       kTriangle + "f 1 2 \\\n 3\nf 1 \\ \n \\\n2 3\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) {
      text.replace(at, 1, end);
      at += std::strlen(end);
    }
    const files::Mesh mesh = readContent("a.obj", text);
    EXPECT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_TRUE(mesh.warnings.empty());
  }
  expectUnread("a.obj", "\r\rv 0 0 0\r\nv 0 0 x\n", ":4: 'x' is no finite number");
}

TEST(Obj, WhatIsLeftOutIsSaid) {
  const files::Mesh mesh = readContent(
      "a.obj",
      "mtllib a.mtl\ng a\nusemtl red\ns 1\nvt 0 0\nvn 0 0 1\n" + kTriangle +
          "f 1 2 3\nusemtl blue\nf 1 2 3\ng b\nf 2 3 1\nl 1 2/2 -1\np 4\nf 1 2\ncurv 0 1 1 2\n"
          "v 1 1 1 0.5\nv 2 2 2 255 0 0\nv 3 3 3\nl 5 4\n");
  EXPECT_EQ(mesh.parts, 3);
  EXPECT_EQ(mesh.other_faces, 4u);
  EXPECT_TRUE(warnsOf(mesh, "4 points or lines left out"));
  EXPECT_TRUE(warnsOf(mesh, ":18: 'curv'"));
  EXPECT_TRUE(warnsOf(mesh, "1 weight of a vertex left out"));
  EXPECT_TRUE(warnsOf(mesh, "1 of 6 vertices are in nothing"));
}

TEST(Obj, WhatIsWrongIsRefusedWithItsLine) {
  const std::pair<const char*, const char*> lines[] = {
      {"f 0 1 2", ":4: a face's vertex has the index 0"},
      {"f 1 2 9", ":4: face 0 refers to vertex 9, but there are 3"},
      {"f 1 2 -4", ":4: face 0 refers to vertex 0, but there are 3"},
      {"f 1 2 3.5", ":4: '3.5' is no corner"},
      {"f 1 2 3/1/1/1", ":4: "},
      {"f 1 2 x", ":4: "},
      {"f 1 2 99999999999999999999", ":4: "},
      {"f", ":4: a face without"},
      {"v 1 2", ":4: a number is missing"},
      {"v 1 2 nan", ":4: 'nan' is no finite number"},
      {"v 1 2 inf", ":4: "},
      {"v 1 2 1e999", ":4: "},
      {"v 1 2 1,5", ":4: '1,5'"},
      {"v 1 2 0x10", ":4: "},
      {"v 1 2 3 4 5", ":4: a vertex of too many"},
      {"v 1 2 3 4 5 6 7 8", ":4: "}};
  for (const auto& [line, part] : lines) {
    expectUnread("a.obj", kTriangle + line + "\nf 1 2 3\n", part);
  }
  expectUnread("a.obj", kTriangle, "it holds no triangles (3 vertices, 0 points or lines)");
  expectUnread("a.obj", kTriangle + "f 1 2 3 \\", ":4: '\\' is no corner");
  expectUnread("a.obj", std::string("v 0 0 0\0\n", 9), ":1: '0?'");
}

TEST(Obj, ObjectsOrElseGroupsAreTold) {
  const std::string faces = "f 1 2 3\nf 1 2 3 4\n",
                    vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto objects = [&](const std::string& content) {
    const files::Mesh mesh = readContent("objects.obj", vertices + content);
    std::string text;
    for (std::size_t t = 0; t < mesh.object_of.size(); ++t) {
      text += mesh.objects.at(static_cast<std::size_t>(mesh.object_of[t])) + ',';
    }
    EXPECT_TRUE(mesh.objects.empty() || mesh.object_of.size() == mesh.triangles.size());
    return text;
  };
  EXPECT_EQ(objects(faces), "");
  EXPECT_EQ(objects(faces + "o a\n" + faces), ",,,a,a,a,");
  EXPECT_EQ(objects("o a\ng x\n" + faces + "usemtl m\ng y\n" + faces), "a,a,a,a,a,a,");
  EXPECT_EQ(objects("o pin #1\n" + faces + "o  pin #2\\\n b\nf 1 2 3 # pin\n"),
            "pin #1,pin #1,pin #1,pin #2 b,");
  EXPECT_EQ(objects("g x#1\nf 1 2 3\ng x #\nf 1 2 3\ng x#1\nf 1 2 3\n"), "x#1,x #,x#1,");
  EXPECT_EQ(objects("g x\nf 1 2 3\ng y z\nf 1 2 3\ng x\n" + faces), "x,y z,x,x,x,");
  const files::Mesh twice = readContent("twice.obj", vertices + "o a\n" + faces + "o a\n" + faces);
  EXPECT_EQ(twice.objects.size(), 2u);
  EXPECT_EQ(twice.object_of, (std::vector<int>{0, 0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace kios::testing
