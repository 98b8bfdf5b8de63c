// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_path.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace kios::robot {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> foldersOf(const char* variable) {
  std::vector<fs::path> folders;
  const char* const value = std::getenv(variable);
  if (!value) return folders;
  std::istringstream stream(value);
  for (std::string folder; std::getline(stream, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

/// The folder of a file, and those above it.
std::vector<fs::path> foldersAbove(const std::string& file) {
  std::error_code error;
  fs::path folder = fs::absolute(file, error).lexically_normal().parent_path();
  std::vector<fs::path> folders = {folder};
  while (folder.has_relative_path()) {
    folder = folder.parent_path();
    folders.push_back(folder);
  }
  return folders;
}

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

}  // namespace

std::string resolve(const std::string& uri, const std::string& named_in,
                    const std::map<std::string, std::string>& packages) {
  const auto startsWith = [&](const char* prefix) { return uri.rfind(prefix, 0) == 0; };
  std::vector<fs::path> tried;
  std::string remedy = "see to the path";
  if (startsWith("package://") || startsWith("model://")) {
    std::string path = uri.substr(uri.find("://") + 3);
    path.erase(0, path.find_first_not_of('/'));  // package:///name/path too
    const std::size_t slash = path.find('/');
    const std::string package = path.substr(0, slash);
    const std::string rest = slash == std::string::npos ? "" : path.substr(slash + 1);
    if (package.empty() || rest.empty()) {
      throw std::invalid_argument("'" + uri + "' must be package://name/path.");
    }
    const auto named = packages.find(package);
    if (named != packages.end()) {
      tried.push_back(fs::path(named->second) / rest);
    } else {
      for (const fs::path& folder : foldersOf("ROS_PACKAGE_PATH")) {
        tried.push_back(folder / package / rest);
        if (folder.filename() == package) tried.push_back(folder / rest);
      }
      for (const fs::path& folder : foldersOf("AMENT_PREFIX_PATH")) {
        tried.push_back(folder / "share" / package / rest);
      }
      for (const fs::path& folder : foldersAbove(named_in)) {
        tried.push_back(folder / package / rest);
        tried.push_back(folder / rest);
      }
    }
    remedy = "give the folder of '" + package + "' in `packages`";
  } else if (startsWith("file://")) {
    tried.emplace_back(uri.substr(7));
  } else if (uri.find("://") != std::string::npos) {
    throw std::invalid_argument("'" + uri +
                                "' can't be fetched; name a file, or package://name/path.");
  } else if (fs::path(uri).is_absolute()) {
    tried.emplace_back(uri);
  } else {
    for (const fs::path& folder : foldersAbove(named_in)) tried.push_back(folder / uri);
  }
  for (const fs::path& path : tried) {
    if (isFile(path)) return path.string();
  }
  throw std::invalid_argument("there is no file '" + uri + "', looked for as " +
                              tried.front().string() +
                              (tried.size() > 1 ? " and elsewhere; " : "; ") + remedy + ".");
}

}  // namespace kios::robot
