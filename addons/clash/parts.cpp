// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "fcl_kios/repair.h"
#include "fcl_kios/solids.h"
#include "files/input.h"

namespace kios::clash_tool {
namespace {

using Json = nlohmann::json;
using files::Mesh;
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument(what); }

/// The objects of a mesh that have triangles, each with its vertices alone; the mesh itself,
/// without a name, where there is one at most.
std::vector<std::pair<std::string, Mesh>> objectsOf(Mesh&& mesh) {
  const std::size_t n = mesh.objects.size();
  std::vector<std::vector<fcl::Triangle>> triangles(n);
  for (std::size_t t = 0; t < mesh.object_of.size(); ++t) {
    triangles[static_cast<std::size_t>(mesh.object_of[t])].push_back(mesh.triangles[t]);
  }
  std::vector<std::pair<std::string, Mesh>> objects;
  std::vector<std::size_t> place(mesh.vertices.size()), of(mesh.vertices.size(), SIZE_MAX);
  for (std::size_t i = 0; i < n; ++i) {
    if (triangles[i].empty()) continue;
    Mesh& object = objects.emplace_back(mesh.objects[i], Mesh()).second;
    const auto moved = [&](std::size_t v) {
      if (of[v] != i) {
        of[v] = i;
        place[v] = object.vertices.size();
        object.vertices.push_back(mesh.vertices[v]);
      }
      return place[v];
    };
    for (const fcl::Triangle& t : triangles[i]) {
      const std::size_t a = moved(t[0]), b = moved(t[1]), c = moved(t[2]);
      object.triangles.emplace_back(a, b, c);
    }
  }
  if (objects.size() > 1) return objects;
  objects.clear();
  objects.emplace_back(std::string(), std::move(mesh));
  return objects;
}

/// Returns true if a closed mesh has no volume that rounding wouldn't make: its two sides are one.
bool isFlat(const Mesh& mesh) {
  double volume = 0, permanents = 0;
  const fcl::Vector3d& origin = mesh.vertices[mesh.triangles[0][0]];
  for (const fcl::Triangle& t : mesh.triangles) {
    const fcl::Vector3d p = mesh.vertices[t[0]] - origin, q = mesh.vertices[t[1]] - origin,
                        r = mesh.vertices[t[2]] - origin;
    volume += p.dot(q.cross(r));
    permanents += p.norm() * q.norm() * r.norm();
  }
  return std::abs(volume) <= 1e-13 * permanents;
}

class PartReader {
 public:
  PartReader(Assembly& assembly, bool repair, inspect::Progress& progress)
      : assembly_(assembly), repair_(repair), progress_(progress) {}

  void read(const fs::path& file) {
    std::string kind = file.extension().string();
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    trying([&] { kind == ".json" ? readManifest(file) : readObjects(file); });
  }

 private:
  /// Notes what is thrown.
  void trying(const std::function<void()>& what) {
    try {
      what();
    } catch (const std::exception& error) {
      std::string said = error.what();
      if (said.rfind("fcl_kios: ", 0) == 0) said.erase(0, 10);
      assembly_.errors.push_back(printable(said));
    }
  }

  /// Gives a part a name of its own, whether it can be read or not, so that numbers stay.
  std::string claim(const std::string& written) {
    const std::string name = printable(written);
    std::string claimed;
    int& number = numbers_[name];
    do {
      claimed = ++number == 1 ? name : name + "#" + std::to_string(number);
    } while (!names_.insert(claimed).second);
    assembly_.taken.push_back(claimed);
    return claimed;
  }

  Mesh readFile(const fs::path& file) {
    progress_.step("reading " + printable(file.string()));
    Mesh mesh = files::readMesh(file.string());
    for (const std::string& warning : mesh.warnings) {
      assembly_.warnings.push_back(printable(warning));
    }
    return mesh;
  }

  void readObjects(const fs::path& file) {
    for (auto& [object, mesh] : objectsOf(readFile(file))) {
      Part part;
      part.name = claim(object.empty() ? file.stem().string() : object);
      part.file = file.string();
      part.group = file.stem().string();
      trying([&, &read = mesh] {
        build(read, part);
        add(part);
      });
    }
  }

  void readManifest(const fs::path& file) {
    progress_.step("reading " + printable(file.string()));
    Json manifest;
    try {
      std::vector<std::set<std::string>> keys;  // of the objects that are open
      manifest =
          Json::parse(files::contentOf(file.string(), std::size_t{1} << 30),
                      [&](int, Json::parse_event_t event, const Json& read) {
                        if (event == Json::parse_event_t::object_start) keys.emplace_back();
                        if (event == Json::parse_event_t::object_end) keys.pop_back();
                        if (event == Json::parse_event_t::key && !keys.back().insert(read).second) {
                          fail(file.string() + ": an object has the key '" +
                               read.get<std::string>() + "' twice.");
                        }
                        return true;
                      });
    } catch (const Json::exception& error) {
      fail(file.string() + ": it is no JSON: " + error.what() + ".");
    }
    if (!manifest.is_object() || manifest.size() != 1 || !manifest.contains("parts") ||
        !manifest["parts"].is_array()) {
      fail(file.string() + ": a manifest is {\"parts\": [...]}, and nothing else.");
    }
    std::size_t index = 0;
    for (const Json& entry : manifest["parts"]) {
      const std::string where = file.string() + ": part " + std::to_string(index++);
      trying([&] { readEntry(entry, file.parent_path(), where); });
    }
  }

  void readEntry(const Json& entry, const fs::path& folder, const std::string& where) {
    if (!entry.is_object()) fail(where + " is no object.");
    for (const auto& [key, value] : entry.items()) {
      if (key != "name" && key != "file" && key != "pose" && key != "group") {
        std::string what = where;
        fail(what.append(" has the key '")
                 .append(key)
                 .append("'; name, file, pose and group are known."));
      }
      if (key != "pose" && !value.is_string()) {
        std::string what = where;
        fail(what.append(" has a ").append(key).append(" that is no text."));
      }
    }
    if (!entry.contains("file")) fail(where + " has no file.");
    const fs::path file = folder / entry["file"].get<std::string>();
    Part part;
    const std::string name = entry.value("name", "");
    part.name = claim(name.empty() ? file.stem().string() : name);
    if (entry.contains("pose")) part.X_WP = poseOf(entry["pose"], where);
    const auto [known, first] = models_.try_emplace(file.lexically_normal().string());
    if (first) {
      Mesh mesh = readFile(file);
      build(mesh, known->second);
    } else if (!known->second.model) {
      fail(where + " has the file " + file.string() + ", which can't be read.");
    }
    part.model = known->second.model;
    part.open = known->second.open;
    part.flat = known->second.flat;
    part.repaired = known->second.repaired;
    part.group = entry.value("group", "");
    part.file = file.string();
    add(part);
  }

  static UnalignedPose poseOf(const Json& pose, const std::string& where) {
    std::vector<double> numbers;
    const auto add = [&](const Json& row, std::size_t n) {
      bool good = row.is_array() && row.size() == n;
      for (std::size_t i = 0; good && i < n; ++i) {
        good = row[i].is_number();
        if (good) numbers.push_back(row[i].get<double>());
      }
      return good;
    };
    const bool in_rows = pose.is_array() && pose.size() == 4;
    const bool good = in_rows ? std::all_of(pose.begin(), pose.end(),
                                            [&](const Json& row) { return add(row, 4); })
                              : add(pose, 16);
    if (!good || numbers[12] != 0 || numbers[13] != 0 || numbers[14] != 0 || numbers[15] != 1) {
      fail(where +
           ": a pose is four rows of four numbers, or the 16 in a list; the last row is 0 0 0 1.");
    }
    UnalignedPose X;
    X.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
    return X;
  }

  void build(Mesh& mesh, Part& part) const {
    files::weld(mesh);
    if (repair_) {
      RepairResultd repaired = kios::repair(mesh.vertices, mesh.triangles, RepairRequest());
      part.repaired = summaryOf(repaired);
      mesh.vertices = std::move(repaired.vertices);
      mesh.triangles = std::move(repaired.triangles);
      if (mesh.triangles.empty()) fail(part.file + ": no triangle is left after " + part.repaired);
    }
    const std::shared_ptr<Modeld> model = makeModel<double>(mesh.vertices, mesh.triangles);
    const Closedness closedness = inspectClosedness(*model);
    if (closedness.isSolid()) {
      markSolid(*model);
      part.flat = isFlat(mesh);
    } else {
      part.open = faultsOf(closedness);
    }
    part.model = model;
  }

  void add(Part part) {
    findClashes({part.toClashPart(0)});  // or it throws, and names the part
    assembly_.parts.push_back(std::move(part));
  }

  Assembly& assembly_;
  const bool repair_;
  inspect::Progress& progress_;
  std::map<std::string, Part> models_;  // by file
  std::unordered_set<std::string> names_;
  std::map<std::string, int> numbers_;
};

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const int length = files::lengthOfCharacter(text);
    const auto bytes = static_cast<std::size_t>(std::max(1, std::abs(length)));
    result += length > 0 ? text.substr(0, bytes) : "\xEF\xBF\xBD";
    text.remove_prefix(bytes);
  }
  return result;
}

Assembly readParts(const std::vector<fs::path>& files, bool repair, inspect::Progress& progress) {
  Assembly assembly;
  PartReader reader(assembly, repair, progress);
  for (const fs::path& file : files) reader.read(file);
  progress.done();
  return assembly;
}

}  // namespace kios::clash_tool
