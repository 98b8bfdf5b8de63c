// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "scenes/mesh.h"

// Files that the tests make, in a folder of their own for each test.

namespace kios::inspect {

inline std::filesystem::path sampleFile(const std::string& name) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(testing::TempDir()) / "kios_inspect" / test->name();
  std::filesystem::create_directories(folder);
  return folder / name;
}

inline std::filesystem::path writeText(const std::string& name, const std::string& text) {
  const auto file = sampleFile(name);
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// Binary; normals are zero, as many exporters leave them.
inline std::filesystem::path writeStl(const std::string& name, const scenes::Mesh& mesh) {
  std::string out(80, ' ');
  const auto put = [&](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0F);
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < 3; ++i) put(static_cast<float>(mesh.vertices[t[c]][i]));
    }
    put(std::uint16_t{0});
  }
  return writeText(name, out);
}

inline std::filesystem::path writeObj(const std::string& name, const scenes::Mesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  for (const fcl::Vector3d& v : mesh.vertices) out << "v " << v.transpose() << "\n";
  for (const fcl::Triangle& t : mesh.triangles) {
    out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  return writeText(name, out.str());
}

/// Returns a Collada scene that calls z up: the triangle (0,0,0) (1,0,0) (0,1,0), moved by 10 along
/// x, and turned by 90 degrees about z and doubled below a node that is moved by 5 along z.
inline std::filesystem::path writeScene(const std::string& name) {
  return writeText(name, R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1" name="meter"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g" name="triangle"><mesh>
    <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
      <technique_common><accessor source="#a" count="3" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s" name="s">
    <node id="moved"><matrix>1 0 0 10  0 1 0 0  0 0 1 0  0 0 0 1</matrix>
      <instance_geometry url="#g"/></node>
    <node id="parent"><matrix>1 0 0 0  0 1 0 0  0 0 1 5  0 0 0 1</matrix>
      <node id="turned"><matrix>0 -2 0 0  2 0 0 0  0 0 2 0  0 0 0 1</matrix>
        <instance_geometry url="#g"/></node></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)");
}

}  // namespace kios::inspect
