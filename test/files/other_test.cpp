// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is no file of ours: other kinds of things, sizes and formats.
#include <sys/stat.h>

#include <cerrno>

#include "files/sample.h"

namespace kios::testing {
namespace {

namespace fs = std::filesystem;

TEST(OtherFiles, RegularOnesOfSomeSizeAlone) {
  const fs::path folder = fs::temp_directory_path() / ("kios_other_" + std::to_string(getpid()));
  fs::create_directories(folder / "d.stl");
  const std::string fifo = folder / "fifo.stl", sparse = folder / "sparse.stl",
                    none = folder / "n.stl";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  std::ofstream(sparse).put('x');
  fs::resize_file(sparse, std::uintmax_t{5} << 30);
  std::ofstream(folder / "empty.obj");
  const auto message = [](const std::string& file) -> std::string {
    try {
      files::readMesh(file);
    } catch (const files::OpenError& error) {
      return error.what() + std::to_string(error.code);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_EQ(message(none), none + ": there is no such file." + std::to_string(ENOENT));
  EXPECT_EQ(
      message(folder / "d.stl"),
      (folder / "d.stl").string() + ": this is a directory, not a file." + std::to_string(EISDIR));
  EXPECT_EQ(message(fifo), fifo + ": this is no regular file.");
  EXPECT_EQ(message("/dev/zero"), "/dev/zero: this is no regular file.");
  EXPECT_NE(message(sparse).find("too large"), std::string::npos);
  EXPECT_NE(message(folder / "empty.obj").find("the file is empty"), std::string::npos);
  fs::remove_all(folder);
}

std::string ac3d(const char* vertices) {
  return std::string(
             "AC3Db\nMATERIAL \"\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
             "OBJECT world\nkids 1\nOBJECT poly\nnumvert 4\n") +
         vertices + "numsurf 1\nSURF 0x0\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nkids 0\n";
}

TEST(OtherFiles, AssimpReadsThemInAProcessOfItsOwn) {
  const std::string dart = "4 -1 0\n1 0 0\n4 1 0\n0 0 0\n";
  files::Mesh mesh;
  try {
    mesh = readContent("a.ac", ac3d(dart.c_str()));
  } catch (const std::invalid_argument& error) {
    if (std::strstr(error.what(), "others need assimp")) GTEST_SKIP() << error.what();
    FAIL() << error.what();
  }
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(areaOf(mesh), 1, 1e-6);  // 7 as a fan
  EXPECT_TRUE(mesh.warnings.empty());
  mesh = readContent("a.ac", ac3d("448262.3 4582940.7 0\n448262.5 4582940.7 0\n"
                                  "448262.5 4582940.9 0\n448262.3 4582940.9 0\n"));
  EXPECT_TRUE(warnsOf(mesh, "were read as floats"));
  expectUnread("a.ac", "this is no mesh\n", "it can't be read as a mesh: ");
  expectUnread("unknown", "this is no mesh\n", "it can't be read as a mesh: ");
  // assimp 5.2 crashes on the first and takes gigabytes for the second.
  const std::string dae = tetrahedron("dae");
  for (const char* count : {"", " count='400000000'"}) {
    std::string text = dae;
    text.replace(text.find(" count='12'"), 11, count);
    expectUnread("a.xml", text, "it can't be read as a mesh: ");
  }
}

}  // namespace
}  // namespace kios::testing
