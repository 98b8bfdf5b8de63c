// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// octomap's files. Its own reader trusts its input: it recurses, and reads on, for ever.
#include "files/octomap.h"

#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fcl/config.h>
#include "files/read_mesh.h"
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#include <octomap/OcTree.h>
#endif

namespace kios::files {
namespace {

constexpr int kLevels = 16;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

/// A node is its value, if it has one, and which of its eight children there are, in order. Without
/// values that is two bits a child, and of three kinds only 3 is a node by itself.
void requireNodes(std::string_view nodes, bool with_values) {
  std::vector<int> levels = {0};
  std::size_t at = 0;
  while (!levels.empty()) {
    const int level = levels.back();
    levels.pop_back();
    const std::size_t value = with_values ? sizeof(float) : 0, bits = with_values ? 1 : 2;
    if (nodes.size() - at < value + bits) refuse("the octree's nodes end too early.");
    if (with_values) {
      float log_odds = 0;
      std::memcpy(&log_odds, nodes.data() + at, sizeof(log_odds));
      if (!std::isfinite(log_odds)) refuse("a value of the octree is not finite.");
      at += value;
    }
    for (int child = 0; child < 8; ++child) {
      const auto byte = static_cast<unsigned char>(nodes[at + (with_values ? 0 : child / 4)]);
      const bool is_node =
          with_values ? (byte >> child & 1) == 1 : (byte >> 2 * (child % 4) & 3) == 3;
      if (!is_node) continue;
      if (level + 1 > kLevels - (with_values ? 0 : 1)) refuse("the octree has too many levels.");
      levels.push_back(level + 1);
    }
    at += bits;
  }
  if (at < nodes.size()) refuse("data follow the octree's last node.");
}

}  // namespace

std::shared_ptr<fcl::CollisionGeometryd> octreeOf(std::string_view nodes, bool with_values,
                                                  double resolution) {
  if (!(resolution > 0 && std::isfinite(resolution))) {
    refuse("the octree's resolution must be positive.");
  }
  requireNodes(nodes, with_values);
#if FCL_HAVE_OCTOMAP
  const auto tree = std::make_shared<octomap::OcTree>(resolution);
  std::istringstream stream{std::string(nodes)};
  if (with_values) {
    tree->readData(stream);
    tree->updateInnerOccupancy();  // octomap's lazy updates leave inner nodes as they were
  } else {
    tree->readBinaryData(stream);
  }
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
#else
  refuse("FCL was built without octomap, so that there are no octrees.");
#endif
}

std::shared_ptr<fcl::CollisionGeometryd> readOctomap(const std::string& file) {
  const std::string content = contentOf(file, std::size_t{1} << 31);
  const auto refuseHere = [&](const std::string& what) { refuse(file + ": " + what); };
  std::istringstream stream(content);
  std::string line;
  std::getline(stream, line);
  const bool with_values = line.rfind("# Octomap OcTree file", 0) == 0;
  if (!with_values && line.rfind("# Octomap OcTree binary file", 0) != 0) {
    refuseHere(
        "it is no octomap: its first line must be '# Octomap OcTree binary file', as in .bt "
        "files, or '# Octomap OcTree file', as in .ot files.");
  }
  std::string kind;
  double resolution = 0;
  while (std::getline(stream, line) && line.rfind("data", 0) != 0) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "id") words >> kind;
    if (key == "res") words >> resolution;
  }
  if (!stream) refuseHere("it ends before its data.");
  if (kind != "OcTree") refuseHere("its id must be OcTree, but is '" + kind + "'.");
  const auto begin = static_cast<std::size_t>(stream.tellg());
  if (begin >= content.size()) refuseHere("the octree has no cells.");
  try {
    return octreeOf(std::string_view(content).substr(begin), with_values, resolution);
  } catch (const std::invalid_argument& error) {
    refuseHere(error.what());
    throw;
  }
}

}  // namespace kios::files
