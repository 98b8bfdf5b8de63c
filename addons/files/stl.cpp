// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// STL, binary and text. assimp keeps floats, takes the part of a text that is there for the whole
// and refuses trailing bytes.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "input.h"

namespace kios::files {
namespace {

constexpr std::size_t kHead = 84, kTriangle = 50;

/// Whether a word is a keyword, in letters of any case.
bool is(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

/// Passes the next word, on whatever line it stands.
void expect(Text& text, std::string_view keyword) {
  if (text.ended()) text.refuse("the file is cut off: '" + std::string(keyword) + "' is missing.");
  const char* const place = text.at();
  const std::string_view word = text.word();
  if (is(word, keyword)) return;
  text.moveTo(place);
  text.refuse(quoted(word) + " stands where '" + std::string(keyword) + "' is missing.");
}

Mesh readAscii(const Input& input) {
  Text text(input, 0);
  Mesh mesh;
  Faces faces(input);
  const auto next = [&](const char* missing) {
    if (text.ended())
      text.refuse("the file is cut off: '" + std::string(missing) + "' is missing.");
    return text.at();
  };
  for (; !text.ended(); text.nextLine()) {  // what stands behind endsolid is a name, too
    const char* const begin = text.at();
    if (!mesh.vertices.empty() && !is(text.word(), "solid")) {
      mesh.warnings.push_back(input.sentence(begin, "what follows the last solid is left out."));
      break;
    }
    text.moveTo(begin);
    expect(text, "solid");
    text.nextLine();
    const std::size_t before = mesh.vertices.size();
    for (;;) {
      const char* const facet = next("endsolid");
      if (is(text.word(), "endsolid")) break;
      text.moveTo(facet);
      expect(text, "facet");
      expect(text, "normal");
      for (int i = 0; i < 3 && !text.lineEnded(); ++i) text.word();  // whatever it is
      expect(text, "outer");
      expect(text, "loop");
      faces.begin(facet);
      std::size_t corners = 0;
      for (const char* place = next("endloop"); !is(text.word(), "endloop"); ++corners) {
        text.moveTo(place);
        expect(text, "vertex");
        const double x = text.number(), y = text.number(), z = text.number();
        faces.add(static_cast<long long>(mesh.vertices.size()));
        mesh.vertices.emplace_back(x, y, z);
        place = next("endloop");
      }
      if (corners < 3) input.refuse(facet, "a facet of fewer than three vertices.");
      expect(text, "endfacet");
    }
    mesh.parts += mesh.vertices.size() > before;
  }
  faces.finish(mesh);
  return mesh;
}

Mesh readBinary(const Input& input, std::size_t triangles) {
  const char* const data = input.content.data();
  const std::size_t bytes = input.content.size() - kHead, there = bytes / kTriangle;
  const std::size_t rest = there < triangles ? 0 : bytes - triangles * kTriangle;
  const bool padded =  // rather than by triangles that nobody counted
      rest % kTriangle != 0 ||
      input.content.find_first_not_of('\0', input.content.size() - rest) == std::string_view::npos;
  if (there < triangles || !padded) {
    input.refuse(nullptr, "its head counts " + counted(triangles, "triangle", "triangles") +
                              ", but it has " + std::to_string(there) +
                              (there < triangles ? "; is it cut off?" : "."));
  }
  Mesh mesh;
  mesh.parts = 1;
  mesh.vertices.reserve(3 * triangles);
  mesh.triangles.reserve(triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      float p[3];
      std::memcpy(p, data + kHead + i * kTriangle + 12 * (c + 1), sizeof p);
      mesh.vertices.emplace_back(p[0], p[1], p[2]);
      if (mesh.vertices.back().allFinite()) continue;
      input.refuse(nullptr, "vertex " + std::to_string(c) + " of triangle " + std::to_string(i) +
                                " is not finite; repair the mesh: no query can answer for it.");
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  if (rest > 0) {
    mesh.warnings.push_back(input.sentence(
        nullptr, counted(rest, "byte", "bytes") + " behind the last triangle left out."));
  }
  Faces(input).finish(mesh);
  return mesh;
}

}  // namespace

Mesh readStl(const Input& input) {
  const std::string_view content = input.content;
  std::uint32_t triangles = 0;
  if (content.size() >= kHead) std::memcpy(&triangles, content.data() + kHead - 4, 4);
  const bool counted_right = content.size() == kHead + kTriangle * std::size_t{triangles};
  Text text(input, 0);
  const bool solid = !text.ended() && is(text.word(), "solid");
  if (!counted_right && solid && content.substr(0, kHead).find('\0') == std::string_view::npos) {
    return readAscii(input);  // a binary one has zeros in its count
  }
  if (content.size() < kHead) {
    input.refuse(nullptr,
                 "it is neither binary STL, which has a head of 84 bytes, nor text, which "
                 "begins with solid.");
  }
  return readBinary(input, triangles);
}

}  // namespace kios::files
