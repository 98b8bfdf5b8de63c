// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Wavefront OBJ. tinyobjloader takes a missing vertex or number for 0 without a word, and assimp
// keeps floats.
#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <system_error>

#include "input.h"

namespace kios::files {
namespace {

/// The vertex of a corner i, i/t, i//n or i/t/n: from 1 on, or from the last one backwards.
long long readCorner(const Input& input, std::string_view word, std::size_t vertices) {
  const char *at = word.data(), *const end = at + word.size();
  long long index[3] = {0, 0, 0};
  for (int k = 0;; ++k) {
    const auto [next, error] = std::from_chars(at, end, index[k]);
    const bool left_out = k > 0 && next == at && (next == end || *next == '/');
    if (!left_out && error != std::errc()) break;
    if (next == end && index[0] > 0) return index[0] - 1;
    if (next == end && index[0] < 0) return index[0] + static_cast<long long>(vertices);
    if (next == end) input.refuse(word.data(), "a face's vertex has the index 0; they begin at 1.");
    if (*next != '/' || k == 2) break;
    at = next + 1;
  }
  input.refuse(word.data(), quoted(word) + " is no corner of a face.");
}

/// Says nothing of where the triangles are.
bool isOfLooks(std::string_view key) {
  static constexpr std::string_view kKeys[] = {
      "vt",  "vn",    "s",        "mtllib",   "maplib",     "usemap",   "mg",
      "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
  return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
}

}  // namespace

Mesh readObj(const Input& input) {
  Text text(input, '#', true);
  Mesh mesh;
  Faces faces(input, 1);
  std::string names[3];         // of object, group and material
  std::set<std::string> parts;  // those that have faces
  bool same_part = false, has_objects = false;
  std::map<std::string, int> groups;  // which may go on later, as objects don't
  std::size_t weights = 0, unknown = 0;
  std::string first_unknown;
  std::vector<long long> ends;  // of lines, and points
  for (; !text.ended(); text.nextLine()) {
    const char* const line = text.at();
    const std::string_view key = text.word();
    if (key == "v") {
      const double x = text.number(), y = text.number(), z = text.number();
      mesh.vertices.emplace_back(x, y, z);
      double more[4] = {1, 0, 0, 0};  // a weight, or a colour
      int n = 0;
      while (n < 4 && !text.lineEnded()) more[n++] = text.number();
      if (n == 2 || !text.lineEnded()) text.refuse("a vertex of too many numbers.");
      weights += n == 1 && more[0] != 1;
    } else if (key == "f" || key == "fo") {
      faces.begin(line);
      if (text.lineEnded()) text.refuse("a face without vertices.");
      while (!text.lineEnded()) faces.add(readCorner(input, text.word(), mesh.vertices.size()));
      if (!same_part) parts.insert(names[0] + '\n' + names[1] + '\n' + names[2]);
      same_part = true;
    } else if (key == "l" || key == "p") {
      ++mesh.other_faces;
      while (!text.lineEnded()) {
        ends.push_back(readCorner(input, text.word(), mesh.vertices.size()));
      }
    } else if (key == "o" || key == "g" || key == "usemtl") {
      const std::string& name = names[key == "o" ? 0 : key == "g" ? 1 : 2] = text.name();
      same_part = false;
      if (key == "usemtl" || (key == "g" && has_objects)) continue;
      has_objects = key == "o";
      const auto group = groups.find(name);
      if (has_objects) {
        faces.beginObject(name);
      } else if (group != groups.end()) {
        faces.resumeObject(group->second);
      } else {
        groups[name] = faces.beginObject(name);
      }
    } else if (!isOfLooks(key) && ++unknown == 1) {
      first_unknown = input.sentence(line, quoted(key));
    }
  }
  mesh.parts = static_cast<int>(parts.size());
  text.warnOfOpenLine(mesh);
  if (unknown > 0) {
    mesh.warnings.push_back(first_unknown + " isn't known, the first of " +
                            counted(unknown, "such line", "such lines") + " left out.");
  }
  if (weights > 0) {
    mesh.warnings.push_back(input.sentence(
        nullptr, counted(weights, "weight of a vertex", "weights of vertices") + " left out."));
  }
  faces.finish(mesh);
  // A file that lacks its last lines looks like one that never had them, but for vertices.
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const fcl::Triangle& t : mesh.triangles) used[t[0]] = used[t[1]] = used[t[2]] = 1;
  for (const long long v : ends) {
    if (v < 0 || v >= static_cast<long long>(used.size())) {
      input.refuse(nullptr, "a line or a point refers to a vertex that isn't there.");
    }
    used[static_cast<std::size_t>(v)] = 1;
  }
  const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  if (unused > 0) {
    mesh.warnings.push_back(
        input.sentence(nullptr, std::to_string(unused) + " of " + std::to_string(used.size()) +
                                    " vertices are in nothing; is the file cut off?"));
  }
  return mesh;
}

}  // namespace kios::files
