// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// PLY, text and binary, and what is refused of it.
#include "files/sample.h"

namespace kios::testing {
namespace {

const std::string kVertexHead =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHead = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPlyVertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string ply(const std::string& head, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + head + "end_header\n" + body;
}

TEST(Ply, AllFormatsAreRead) {
  for (const char* kind : {"ply", "little.ply", "big.ply"}) {
    const files::Mesh mesh = readContent("a.ply", tetrahedron(kind));
    EXPECT_EQ(mesh.triangles.size(), 4u) << kind;
    EXPECT_NEAR(areaOf(mesh), kTetraArea, 1e-15) << kind;
    EXPECT_TRUE(mesh.warnings.empty()) << kind;
  }
}

TEST(Ply, PropertiesOfEveryTypeAndOrder) {
  const std::string head =
      "ply\r\nformat binary_little_endian 1.0\r\nelement face 1\r\nproperty uchar red\r\n"
      "property list ushort uint vertex_index\r\nproperty list uint8 float32 texcoord\r\n"
      "element vertex 3\r\nproperty int8 label\r\nproperty float64 z\r\nproperty int y\r\n"
      "property list uchar short other\r\nproperty int16 x\r\nend_header\r\n";
  std::string body = "\x7f" + bytesOf(std::uint16_t{3}) + bytesOf(0u) + bytesOf(1u) + bytesOf(2u) +
                     "\2" + bytesOf(0.5F) + bytesOf(0.5F);
  for (int i = 0; i < 3; ++i) {
    body += "\xff" + bytesOf(448262.3 + i) + bytesOf(-100000 * i) + "\1" +
            bytesOf(std::int16_t{9}) + bytesOf(static_cast<std::int16_t>(-i * i));
  }
  const files::Mesh mesh = readContent("a.ply", head + body);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[2], fcl::Vector3d(-4, -200000, 448264.3));
  expectUnread("a.ply", head + body.substr(0, body.size() - 1), "it has 2 of 3 elements 'vertex'");
  EXPECT_TRUE(warnsOf(readContent("a.ply", head + body + "x"), "1 byte behind the last element"));
}

TEST(Ply, WhatIsLeftOutIsSaid) {
  const files::Mesh mesh =
      readContent("a.ply", ply(kVertexHead + kFaceHead +
                                   "element edge 2\nproperty int vertex1\nproperty int "
                                   "vertex2\nelement camera 1\nproperty float f\n",
                               kPlyVertices + "3 0 1 2\n0 1\n1 2\n0.5\n"));
  EXPECT_EQ(mesh.other_faces, 2u);
  EXPECT_TRUE(warnsOf(mesh, "2 points or lines"));
  EXPECT_TRUE(warnsOf(mesh, "'camera'"));
}

TEST(Ply, WhatIsWrongIsRefusedWithItsLine) {
  const std::pair<std::string, const char*> files[] = {
      {"plx\n", ":1: it doesn't begin with ply"},
      {"ply\nelement vertex 3\nend_header\n", "no format"},
      {"ply\nformat ascii 1.0\nelement vertex 3\n", "'end_header' is missing"},
      {"ply\nformat text 1.0\nend_header\n", ":2: 'text'"},
      {ply("element vertex -3\n", ""), ":3: a count is negative"},
      {ply("element vertex 3\nproperty real x\n", ""), ":4: 'real'"},
      {ply("elemet vertex 3\n", ""), ":3: 'elemet'"},
      {ply("element vertex 3\nproperty float x\n", "0\n0\n0\n"), ":3: vertices need x, y and z"},
      {ply(kVertexHead + "element face 1\nproperty int a\n", kPlyVertices + "3\n"),
       ":7: faces need"},
      {ply(kVertexHead + "element patch 4000000000\n", kPlyVertices), ":7: an element without"},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1 7\n"),
       ":13: face 0 refers to vertex 7, but there are 3"},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1 -1\n"),
       ":13: face 0 refers to vertex -1"},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1 1.5\n"), ":13: "},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "-3 0 1 2\n"), ":13: "},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1\n"), ":13: a number is missing"},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1 2 3\n"), ":13: more numbers"},
      {ply(kVertexHead + kFaceHead, kPlyVertices + "3 0 1 2\n3 0 1 2\n"), ":14: more follows"},
      {ply(kVertexHead + kFaceHead, "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), ":11: a number is missing"},
      {ply(kVertexHead + kFaceHead, "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"), ":11: 'nan'"},
      {ply(kVertexHead + kFaceHead, "0 0 0\n1 0 0\n"), "it has 2 of 3 elements 'vertex'"},
      {ply(kVertexHead, kPlyVertices), "no triangles"}};
  for (const auto& [text, part] : files) expectUnread("a.ply", text, part);
}

}  // namespace
}  // namespace kios::testing
