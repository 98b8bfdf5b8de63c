// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/read_mesh.h"
#include "files/tetrahedron.h"
#include "scenes/random.h"

// Mesh files that the tests write themselves.

namespace kios::testing {

/// Writes a file into a folder that goes with the program, and reads it.
inline files::Mesh readContent(const std::string& name, const std::string& content) {
  static const struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("kios_files_" + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
  } folder;
  const std::string file = (folder.path / name).string();
  std::filesystem::remove(file);  // a file system may write what is cut to nothing to the disk
  std::ofstream(file, std::ios::binary) << content;
  return files::readMesh(file);
}

/// The file is refused in one line, which names it and holds `part`: ":3: " is a line.
inline void expectUnread(const std::string& name, const std::string& content,
                         const std::string& part) {
  SCOPED_TRACE(content.substr(0, 200));
  try {
    readContent(name, content);
    ADD_FAILURE() << "not refused: " << part;
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(name + ":"), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 400u);
  }
}

inline double areaOf(const files::Mesh& mesh) {
  double area = 0;
  for (const fcl::Triangle& t : mesh.triangles) {
    const fcl::Vector3d& a = mesh.vertices[t[0]];
    area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
  }
  return area;
}

/// Whether any warning holds a part of a sentence.
inline bool warnsOf(const files::Mesh& mesh, const std::string& part) {
  for (const std::string& warning : mesh.warnings) {
    if (warning.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace kios::testing
