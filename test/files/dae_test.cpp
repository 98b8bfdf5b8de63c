// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// COLLADA: primitives and nodes of every kind, and what is refused of it.
#include "files/sample.h"

#ifdef KIOS_HAVE_TINYXML2  // else assimp reads it

namespace kios::testing {
namespace {

/// The tetrahedron's file with a part replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = tetrahedron("dae");
  return text.replace(text.find(from), from.size(), to);
}

/// With other primitives; a corner is a vertex and a number of something else.
std::string withPrimitives(const std::string& primitives) {
  std::string text = tetrahedron("dae");
  const std::size_t begin = text.find("<triangles"), end = text.find("</mesh>");
  const std::string inputs =
      "<input semantic='NORMAL' source='#n' offset='1'/><input semantic='VERTEX' source='#v' "
      "offset='0'/>";
  std::string all = primitives;
  for (std::size_t at = 0; (at = all.find("$", at)) != std::string::npos;)
    all.replace(at, 1, inputs);
  return text.replace(begin, end - begin, all);
}

TEST(Dae, PrimitivesOfEveryKind) {
  const char* const kinds[] = {
      "<triangles count='4'>$<p>0 9 2 9 1 9 0 9 1 9 3 9 1 9 2 9 3 9 0 9 3 9 2 9</p></triangles>",
      ("<polylist count='4'>$<vcount>3 3 3 3</vcount>"
       "<p>0 9 2 9 1 9 0 9 1 9 3 9 1 9 2 9 3 9 0 9 3 9 2 9</p></polylist>"),
      ("<polygons count='4'>$<p>0 9 2 9 1 9</p><p>0 9 1 9 3 9</p><p>1 9 2 9 3 9</p>"
       "<p>0 9 3 9 2 9</p></polygons>"),
      "<tristrips count='1'>$<p>0 9 2 9 1 9 3 9 0 9 2 9</p></tristrips>",
      "<trifans count='2'>$<p>0 9 2 9 1 9 3 9 2 9</p><p>1 9 2 9 3 9</p></trifans>"};
  for (const char* kind : kinds) {
    SCOPED_TRACE(kind);
    const files::Mesh mesh = readContent("a.dae", withPrimitives(kind));
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(areaOf(mesh), kTetraArea, 1e-15);
    double volume = 0;
    for (const fcl::Triangle& t : mesh.triangles) {
      volume += mesh.vertices[t[0]].cross(mesh.vertices[t[1]]).dot(mesh.vertices[t[2]]) / 6;
    }
    EXPECT_NEAR(volume, 1.0 / 6, 1e-15);
    EXPECT_TRUE(mesh.warnings.empty());
  }
  const files::Mesh mesh = readContent(
      "a.dae", withPrimitives("<lines count='2'>$<p>0 0 1 0 1 0 2 0</p></lines>"
                              "<polygons count='2'>$<p>0 0 1 0 2 0</p><ph/></polygons>"));
  EXPECT_TRUE(warnsOf(mesh, "2 points or lines"));
  EXPECT_TRUE(warnsOf(mesh, "1 element <ph> left out"));
}

TEST(Dae, NodesArePlacedInDoubles) {
  const files::Mesh mesh = readContent(
      "a.dae",
      with("<node><instance_geometry url='#g'/></node>",
           "<node id='n'><translate>448262.3 4582940.7 0</translate><rotate>0 0 2 90</rotate>"
           "<scale>-1 1 1</scale><node><matrix>1 0 0 0.1 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"
           "<instance_geometry url='#g'/></node></node><node><instance_node url='#n'/></node>"));
  ASSERT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.parts, 2);
  EXPECT_LT((mesh.vertices[1] - fcl::Vector3d(448262.3, 4582940.7 - 1.1, 0)).norm(), 1e-9);
  double volume = 0;  // mirrored, its outside is outside
  for (int i = 0; i < 4; ++i) {
    const fcl::Triangle& t = mesh.triangles[i];
    const fcl::Vector3d o = mesh.vertices[0];
    volume +=
        (mesh.vertices[t[0]] - o).cross(mesh.vertices[t[1]] - o).dot(mesh.vertices[t[2]] - o) / 6;
  }
  EXPECT_NEAR(volume, 1.0 / 6, 1e-9);
}

TEST(Dae, NodesAreObjectsByTheirNamesOrIds) {
  const std::string geometry = "<instance_geometry url='#g'/>";
  const files::Mesh mesh = readContent(
      "a.dae",
      with("<node>" + geometry + "</node>", "<node id='a' name='left'>" + geometry +
                                                "</node><node id='right'>" + geometry + "</node>"));
  EXPECT_EQ(mesh.objects, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(mesh.object_of, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(Dae, TheUnitCountsTheUpAxisDoesNot) {
  const files::Mesh mesh = readContent(
      "a.DAE",
      with("<COLLADA>", "<COLLADA><asset><unit meter='0.001'/><up_axis>Y_UP</up_axis></asset>"));
  EXPECT_EQ(mesh.vertices[3], fcl::Vector3d(0, 0, 0.001));
}

TEST(Dae, WhatIsWrongIsRefusedWithItsLine) {
  const std::pair<std::string, const char*> files[] = {
      {with(" count='12'", ""), ":2: <float_array> needs the attribute count"},
      {with("count='12'", "count='400000000'"), ":2: <float_array> has 12 numbers where 400000000"},
      {with("count='4' stride", "count='9000000000' stride"), ":3: <accessor> has a count that"},
      {with("count='4' stride", "count='400000000' stride"), ":3: <accessor> reaches beyond"},
      {with("count='4' stride='3'", "count='4'"), ":3: <accessor> reaches beyond"},
      {with("<triangles count='4'", "<triangles"), ":5: <triangles> needs the attribute count"},
      {with("<triangles count='4'", "<triangles count='5'"), ":6: <p> has 12 corners"},
      {with("<triangles count='4'", "<triangles count='4000000000'"),
       ":5: <triangles> has a count that is too large"},
      {with("<triangles count='4'", "<triangles count='-1'"), ":5: <triangles> holds '-1'"},
      {with("<triangles count='4'", "<polylist count='4'"), "line 5: it is no well-formed XML"},
      {with("<p> 0", "<p> 7"), ":6: <p> refers to vertex 7, but there are 4"},
      {with("<p> 0", "<p> -1"), ":6: <p> holds '-1'"},
      {with("<p> 0", "<p> x"), ":6: <p> holds 'x'"},
      {with("'#g'", "'#h'"), ":8: <instance_geometry> needs the url of a <geometry>"},
      {with("'#g'", "'#a'"), ":8: <instance_geometry> needs the url"},
      {with("'#v'", "'#s'"), ":5: <input> needs the source of a <vertices>"},
      {with("POSITION", "NORMAL"), ":5: <input> leads to no POSITION"},
      {with("semantic='VERTEX'", "semantic='NORMAL'"), ":5: <triangles> needs an <input"},
      {with("1.000000", "nan"), ":2: <float_array> holds 'nan'"},
      {with("1.000000", "1e999"), ":2: <float_array> holds"},
      {with("<scene>", "<scenes>"), "well-formed"},
      {with("<scene><instance_visual_scene url='#w'/></scene>", ""),
       ":1: <COLLADA> needs a <scene>"},
      {with("<node>", "<node><matrix>1 2 3</matrix>"), ":8: <matrix> has 3 numbers where 16"},
      {with("<node>", "<node><scale>1e300 1 1</scale><scale>1e300 1 1</scale>"),
       "nothing is finite"},
      {with("<node>", "<node id='n'><instance_node url='#n'/>"),
       ":8: <node> is a hundred nodes deep"},
      {with("<COLLADA>", "<COLLADA><asset><unit meter='0'/></asset>"), ":1: <unit> has a meter"},
      {"<x3d/>", ":1: <x3d> stands where <COLLADA>"},
      {"<?xml version='1.0'?>", "without an element"}};
  for (const auto& [text, part] : files) expectUnread("a.dae", text, part);
}

// A few nodes that place each other twice make more triangles than memory holds.
TEST(Dae, CopiesOfCopiesHaveALimit) {
  std::string nodes = "<node><instance_node url='#n0'/></node>";
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<instance_node url='#n" + std::to_string(i + 1) + "'/>";
    nodes += "<node id='n" + std::to_string(i) + "'>" + next + next + "</node>";
  }
  nodes += "<node id='n40'><instance_geometry url='#g'/></node>";
  expectUnread("a.dae", with("<node><instance_geometry url='#g'/></node>", nodes),
               "is placed too often");
}

}  // namespace
}  // namespace kios::testing

#endif
