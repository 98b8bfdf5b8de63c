// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstring>
#include <string>

namespace kios::testing {

/// A tetrahedron, its faces turned outwards.
inline const double kTetra[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
inline const double kTetraArea = 1.5 + std::sqrt(3.0) / 2;

/// The number as its bytes lie in memory, or the other way round.
template <typename Number>
std::string bytesOf(Number x, bool swapped = false) {
  std::string bytes(sizeof x, '\0');
  std::memcpy(&bytes[0], &x, sizeof x);
  if (swapped) bytes.assign(bytes.rbegin(), bytes.rend());
  return bytes;
}

/// A file of the tetrahedron as each kind writes it, with digits that a float doesn't keep where it
/// can. Kinds: obj, off, coff, stl, binary.stl, ply, little.ply, big.ply, dae.
inline std::string tetrahedron(const std::string& kind) {
  const auto vertex = [](int i) {
    std::string text;
    for (const double x : kTetra[i]) text += (text.empty() ? "" : " ") + std::to_string(x);
    return text;
  };
  const auto face = [](int i, int base) {
    std::string text;
    for (const int v : kFaces[i]) text += " " + std::to_string(v + base);
    return text;
  };
  std::string text;
  if (kind == "obj") {
    text = "# made by hand\no tetra\n";
    for (int i = 0; i < 4; ++i) text += "v " + vertex(i) + "\n";
    for (int i = 0; i < 4; ++i) text += "f" + face(i, 1) + "\n";
  } else if (kind == "off" || kind == "coff") {
    const bool color = kind == "coff";
    text = color ? "COFF\n4 4 6\n" : "OFF\n4 4 6\n";
    for (int i = 0; i < 4; ++i) text += vertex(i) + (color ? " 255 0 0 255\n" : "\n");
    for (int i = 0; i < 4; ++i) text += "3" + face(i, 0) + (color ? " 0 0.5 1\n" : "\n");
  } else if (kind == "stl") {
    text = "solid tetra\n";
    for (const auto& f : kFaces) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int v : f) text += "vertex " + vertex(v) + "\n";
      text += "endloop\nendfacet\n";
    }
    text += "endsolid tetra\n";
  } else if (kind == "binary.stl") {
    text = std::string(80, '\0') + bytesOf(4u);
    for (const auto& f : kFaces) {
      text += std::string(12, '\0');
      for (const int v : f) {
        for (const double x : kTetra[v]) text += bytesOf(static_cast<float>(x));
      }
      text += std::string(2, '\0');
    }
  } else if (kind == "dae") {
    std::string vertices, faces;
    for (int i = 0; i < 4; ++i) vertices += vertex(i) + " ";
    for (int i = 0; i < 4; ++i) faces += face(i, 0);
    text =
        "<COLLADA><library_geometries><geometry id='g'><mesh>\n<source id='s'>"
        "<float_array id='a' count='12'>" +
        vertices +
        "</float_array>\n<technique_common><accessor source='#a' count='4' stride='3'/>"
        "</technique_common></source>\n<vertices id='v'><input semantic='POSITION' source='#s'/>"
        "</vertices>\n<triangles count='4'><input semantic='VERTEX' source='#v' offset='0'/>\n<p>" +
        faces +
        "</p></triangles></mesh></geometry></library_geometries>\n<library_visual_scenes>"
        "<visual_scene id='w'>\n<node><instance_geometry url='#g'/></node>\n</visual_scene>"
        "</library_visual_scenes>\n<scene><instance_visual_scene url='#w'/></scene></COLLADA>";
  } else {  // ply
    const bool ascii = kind == "ply", swapped = kind == "big.ply";
    text = std::string("ply\nformat ") +
           (ascii     ? "ascii"
            : swapped ? "binary_big_endian"
                      : "binary_little_endian") +
           " 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty double y\n"
           "property double z\nelement face 4\nproperty list uchar int vertex_indices\n"
           "end_header\n";
    for (int i = 0; i < 4; ++i) {
      if (ascii) text += vertex(i) + "\n";
      for (const double x : kTetra[i]) text += ascii ? "" : bytesOf(x, swapped);
    }
    for (int i = 0; i < 4; ++i) {
      text += ascii ? "3" + face(i, 0) + "\n" : std::string(1, '\3');
      for (const int v : kFaces[i]) text += ascii ? "" : bytesOf(v, swapped);
    }
  }
  return text;
}

}  // namespace kios::testing
