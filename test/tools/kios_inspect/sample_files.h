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

}  // namespace kios::inspect
