// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// OFF, as Geomview and what came after it write it. assimp keeps floats and takes colours for
// faces; CGAL's reader says of what is wrong only that something is.
#include <stdexcept>

#include "input.h"

namespace kios::files {
namespace {

struct Header {
  std::size_t vertices = 0, faces = 0;
  bool plain = true;  ///< vertices are but places, or have a colour that the header doesn't name
};

Header readHeader(Text& text) {
  text.ended();
  const std::string_view word = text.word();
  const std::size_t keyword = word.find("OFF");
  std::string_view kinds = word.substr(0, keyword);
  if (keyword == std::string_view::npos) text.refuse("it doesn't begin with OFF.");
  const bool plain = kinds.empty();
  for (const std::string_view kind : {"ST", "C", "N"}) {
    if (kinds.substr(0, kind.size()) == kind) kinds.remove_prefix(kind.size());
  }
  if (!kinds.empty()) text.refuse(quoted(word) + " isn't read; OFF, COFF, NOFF and STOFF are.");
  text.moveTo(word.data() + keyword + 3);  // OFF4 4 0
  text.ended();
  Header header;
  header.plain = plain;
  header.vertices = text.count();
  header.faces = text.count();
  if (!text.lineEnded()) text.count();  // edges
  return header;
}

/// Passes numbers up to the line's end; how many they are.
int passNumbers(Text& text) {
  int n = 0;
  for (; !text.lineEnded(); ++n) text.number();
  return n;
}

/// Reads a file each of whose vertices and faces is a line, perhaps with a colour, or else one
/// whose lines end anywhere.
Mesh read(const Input& input, bool by_lines) {
  Text text(input, '#');
  const Header header = readHeader(text);
  Mesh mesh;
  mesh.parts = 1;
  Faces faces(input);
  if (!by_lines && !header.plain) text.refuse("its lines end anywhere.");
  if (by_lines && !text.lineEnded()) text.refuse("a number that isn't expected.");
  const auto next = [&](bool begins, std::size_t i, std::size_t n, const char* what) {
    if ((begins || !by_lines) && text.ended()) {
      text.refuse("the file is cut off: it has " + std::to_string(i) + " of " + std::to_string(n) +
                  " " + what + ".");
    }
  };
  int extra = -1;
  for (std::size_t i = 0; i < header.vertices; ++i) {
    double p[3];
    for (double& x : p) {
      next(&x == p, i, header.vertices, "vertices");
      x = text.number();
    }
    mesh.vertices.emplace_back(p[0], p[1], p[2]);
    if (!by_lines) continue;
    const int more = passNumbers(text);
    const bool color = more == 0 || more == 3 || more == 4;
    if (more > 9 || (header.plain && !color) || (i > 0 && more != extra)) {
      text.refuse("a vertex of too many or too few numbers.");
    }
    extra = more;
  }
  for (std::size_t i = 0; i < header.faces; ++i) {
    next(true, i, header.faces, "faces");
    faces.begin(text.at());
    const std::size_t n = text.count();
    if (n == 0) text.refuse("a face without vertices.");
    for (std::size_t c = 0; c < n; ++c) {
      next(false, i, header.faces, "faces");
      faces.add(text.integer());
    }
    const int more = by_lines ? passNumbers(text) : 0;
    if (more == 2 || more > 4) text.refuse("a face of too many or too few numbers.");
  }
  if (!text.ended()) {
    text.refuse("more follows than the " + std::to_string(header.vertices) + " vertices and " +
                std::to_string(header.faces) + " faces that its head counts.");
  }
  text.warnOfOpenLine(mesh);
  faces.finish(mesh);
  return mesh;
}

}  // namespace

Mesh readOff(const Input& input) {
  try {
    return read(input, true);
  } catch (const std::invalid_argument&) {
    const std::exception_ptr error = std::current_exception();
    try {
      return read(input, false);
    } catch (const std::invalid_argument&) {
      std::rethrow_exception(error);
    }
  }
}

}  // namespace kios::files
