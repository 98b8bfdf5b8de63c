// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kios::inspect {

/// Holds the options of the command line.
struct Options {
  std::vector<std::filesystem::path> meshes;  // one, or two for their distance
  std::string pose_a = "0,0,0", pose_b = "0,0,0";
  int repeats = 101;
  int level = -1;  // -1: not given
  std::filesystem::path html;
  double html_limit = 20;
  bool repair = false;  // implied by the next three
  double weld = 1e-5;
  int fill_holes = 0;
  std::filesystem::path write;  // the repaired mesh, as OBJ
  bool json = false;
  bool strict = false;
  bool quiet = false;
};

}  // namespace kios::inspect
