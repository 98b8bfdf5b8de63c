// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fcl_kios/model.h"
#include "fcl_kios/scene.h"
#include "inspect/progress.h"

namespace kios::clash_tool {

struct Part {
  std::string name;  ///< unlike all others, printable as they all are
  std::string file, group;
  std::shared_ptr<const Modeld> model;  ///< one for all places of a file
  UnalignedPose X_WP = UnalignedPose::Identity();
  std::string open;      ///< why it is no solid; empty if it is one
  bool flat = false;     ///< a solid of no volume, but for rounding
  std::string repaired;  ///< what was changed

  ClashPart toClashPart(int of_group) const { return {model, X_WP, name, of_group}; }
};

struct Assembly {
  std::vector<Part> parts;
  std::vector<std::string> taken;     ///< names of parts, of those that couldn't be read, too
  std::vector<std::string> errors;    ///< a sentence for each file or part that couldn't be read
  std::vector<std::string> warnings;  ///< what was left out of files
};

/// A text whose control characters, line breaks among them, and bytes that are no UTF-8 are
/// replaced by U+FFFD, each.
std::string printable(std::string_view text);

/// Reads meshes, a part for each object of a file that has several, and manifests (.json), as
/// docs/clash.md lists them. Parts of equal names are numbered. The group of a mesh's parts is the
/// file's name without ending. With `repair` each mesh is repaired first.
Assembly readParts(const std::vector<std::filesystem::path>& files, bool repair,
                   inspect::Progress& progress);

}  // namespace kios::clash_tool
