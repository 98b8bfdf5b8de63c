// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace kios::scenes {
struct BodyScene;
struct Cell;
struct Mesh;
}  // namespace kios::scenes

namespace kios::bench {

class Crowd;
class MeshSet;
class MotionSet;
class SceneSet;
struct Way;

/// Makes entrants over our volume by one build of the library: this program's, or that of a shared
/// object (library.cpp with what it names, over one revision's static library). Nothing of ours
/// crosses it, only FCL's types and the abstract classes named here.
struct Library {
  std::unique_ptr<MeshSet> (*mesh_set)();
  std::unique_ptr<MeshSet> (*tree_set)();  ///< FCL's recursion over our volume, by its nodes
  std::unique_ptr<Crowd> (*crowd)();
  std::unique_ptr<SceneSet> (*scene_set)(const scenes::BodyScene& scene);
  std::unique_ptr<MotionSet> (*motion_set)(const scenes::Cell& cell);
  Way (*continuous)(const std::string& name, const scenes::Mesh& a, const scenes::Mesh& b);
};

/// Our volume as `bv` of rows, and FCL's recursion over it; by an earlier revision's library the
/// name ends by kBefore.
inline constexpr char kOurs[] = "kios";
inline constexpr char kOurTree[] = "kios_tree";
inline constexpr char kBefore[] = "_before";

bool isBefore(const std::string& bv);
/// Returns whether it is kOurs, before or now.
bool isOurs(const std::string& bv);

/// From now on each of ours is asked by both libraries, each a shared object. Throws
/// std::runtime_error if one can't be loaded.
void loadLibraries(const std::filesystem::path& before, const std::filesystem::path& now);

/// Returns the library that serves one of ours.
const Library& libraryOf(const std::string& bv);

/// Returns the names as they are; while libraries are compared, kOurs and kOurTree are followed by
/// themselves before, and others of ours (`kios_...`, `sampled_...`) are left out.
std::vector<std::string> compared(const std::vector<std::string>& names);

/// Returns how often an entrant answers in a repeat: while libraries are compared, both answer
/// several times, more often where a pass is short.
int roundsOf(const std::string& bv, double us_of_pass = std::numeric_limits<double>::infinity());

}  // namespace kios::bench

/// The makers of what it is linked with.
extern "C" const kios::bench::Library kios_bench_library;
