// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are cut off are read whole, warned of or refused, and white space is free.
#include <cmath>

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
