// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are cut off or altered are read whole, warned of or refused, and white space is free.
#include <algorithm>

#include "files/sample.h"

namespace kios::testing {
namespace {

using scenes::Random;

const std::pair<const char*, const char*> kKinds[] = {
    {"obj", "a.obj"}, {"off", "a.off"},        {"coff", "a.off"},       {"stl", "a.stl"},
    {"ply", "a.ply"}, {"binary.stl", "a.stl"}, {"little.ply", "a.ply"}, {"big.ply", "a.ply"},
#ifdef KIOS_HAVE_TINYXML2
    {"dae", "a.dae"},
#endif
};

bool isWhole(const files::Mesh& mesh) {
  return mesh.triangles.size() == 4 && std::abs(areaOf(mesh) - kTetraArea) < 1e-6;
}

// Nothing says how long an OBJ is: one that ends with a face's line, after which all vertices
// are in faces, is a file.
TEST(CutFiles, NoPrefixIsAPartWithoutAWord) {
  for (const auto& [kind, name] : kKinds) {
    const std::string text = tetrahedron(kind);
    ASSERT_TRUE(isWhole(readContent(name, text))) << kind;
    int refused = 0;
    for (std::size_t n = 1; n < text.size(); ++n) {
      try {
        const files::Mesh mesh = readContent(name, text.substr(0, n));
        const bool line_of_obj = kind == std::string("obj") && text[n - 1] == '\n';
        EXPECT_TRUE(isWhole(mesh) || !mesh.warnings.empty() || line_of_obj) << kind << " at " << n;
      } catch (const std::invalid_argument&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, static_cast<int>(text.size() * 2 / 3)) << kind;
  }
}

TEST(CutFiles, AlteredFilesAreReadOrRefused) {
  Random random(2);
  for (const auto& [kind, name] : kKinds) {
    const std::string text = tetrahedron(kind);
    for (int i = 0; i < 150; ++i) {
      std::string altered = text;
      for (int k = random.unit() < 0.7 ? 1 : 4; k > 0; --k) {
        const auto at = static_cast<std::size_t>(random.unit() * altered.size());
        const auto to = static_cast<std::size_t>(random.unit() * altered.size());
        switch (static_cast<int>(random.unit() * 4)) {
          case 0:
            altered[at] = static_cast<char>(random.unit() * 256);
            break;
          case 1:
            altered[at] = "0123456789-.e\n "[static_cast<int>(random.unit() * 15)];
            break;
          case 2:
            altered.erase(at, 1 + static_cast<std::size_t>(random.unit() * 9));
            break;
          default:
            altered.insert(to, altered.substr(at, static_cast<std::size_t>(random.unit() * 30)));
        }
        if (altered.empty()) altered = "x";
      }
      try {
        const files::Mesh mesh = readContent(name, altered);
        EXPECT_FALSE(mesh.triangles.empty());
        for (const fcl::Triangle& t : mesh.triangles) {
          EXPECT_LT(std::max({t[0], t[1], t[2]}), mesh.vertices.size());
        }
        for (const fcl::Vector3d& v : mesh.vertices) EXPECT_TRUE(v.allFinite());
      } catch (const std::invalid_argument& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
}

TEST(CutFiles, WhiteSpaceIsFree) {
  Random random(3);
  const auto draw = [&](std::initializer_list<const char*> parts) {
    return std::string(parts.begin()[static_cast<std::size_t>(random.unit() * parts.size())]);
  };
  for (const auto& [kind, name] : kKinds) {
    const std::string text = tetrahedron(kind), extension = kind;
    if (extension.find('.') != std::string::npos || extension == "dae") continue;
    for (int i = 0; i < 30; ++i) {
      const std::string line_end = draw({"\n", "\r\n", "\r"});
      const bool comments = extension == "obj" || extension == "off" || extension == "coff";
      std::string spaced;
      for (const char c : text) {
        if (c == '\n' && comments) spaced += draw({"", "", " # 9 9 9", "\t#\f"});
        spaced += c == '\n'  ? draw({"", " ", "\t"}) + line_end
                  : c == ' ' ? draw({" ", "\t", "  ", "\v\f"})
                             : std::string(1, c);
        if (c == '\n' && extension != "ply") spaced += draw({"", "", line_end.c_str(), " \t"});
      }
      SCOPED_TRACE(spaced);
      EXPECT_TRUE(isWhole(readContent(name, spaced)));
    }
  }
}

}  // namespace
}  // namespace kios::testing
