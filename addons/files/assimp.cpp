// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// assimp 5.2 crashes on some damaged files and takes gigabytes for others, so that it runs in a
// process of its own. Its coordinates are floats.
#include <assimp/scene.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <sstream>

#include "input.h"

namespace kios::files {
namespace {

/// What the process sends, one array after the other, with their sizes before.
struct Soup {
  std::vector<char> error;
  std::vector<fcl::Vector3d> vertices;
  std::vector<std::uint32_t> faces;  ///< a number of corners, the corners, the object
  std::vector<char> objects;         ///< names, each with a 0 behind
  std::vector<char> parts;           ///< one each

  template <typename Function>
  void each(Function&& function) {
    function(error);
    function(vertices);
    function(faces);
    function(objects);
    function(parts);
  }
};

void append(const aiMesh& part, const Eigen::Affine3d& X, std::uint32_t object, Soup& soup) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    soup.vertices.emplace_back(X * fcl::Vector3d(p.x, p.y, p.z));
  }
  const bool mirrored = X.linear().determinant() < 0;  // its outside stays outside
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    soup.faces.push_back(face.mNumIndices);
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      const unsigned k = face.mIndices[mirrored ? face.mNumIndices - 1 - c : c];
      soup.faces.push_back(k < part.mNumVertices ? first + k : UINT32_MAX);
    }
    soup.faces.push_back(object);
  }
  soup.parts.push_back(1);
}

void import(const std::string& file, Soup& soup) {
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(file, 0);
  if (!scene || !scene->mRootNode) {
    const std::string error = importer.GetErrorString();
    if (error.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    soup.error.assign(error.begin(), error.begin() + std::min<std::ptrdiff_t>(error.size(), 300));
    while (!soup.error.empty() && soup.error.back() == '.') soup.error.pop_back();
    std::replace_if(
        soup.error.begin(), soup.error.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return;
  }
  std::uint32_t object = 0;
  std::vector<std::pair<const aiNode*, Eigen::Affine3d>> waiting;
  waiting.emplace_back(scene->mRootNode, Eigen::Affine3d::Identity());
  while (!waiting.empty()) {
    const auto [node, X_P] = waiting.back();
    waiting.pop_back();
    const aiMatrix4x4& m = node->mTransformation;  // by rows
    using Rows = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;
    const Eigen::Affine3d X = X_P * Eigen::Affine3d(Eigen::Map<const Rows>(&m.a1).cast<double>());
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      append(*scene->mMeshes[node->mMeshes[i]], X, object, soup);
    }
    if (node->mNumMeshes > 0) {
      const char* const name = node->mName.C_Str();
      soup.objects.insert(soup.objects.end(), name, name + std::strlen(name) + 1);
      ++object;
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) waiting.emplace_back(node->mChildren[i], X);
  }
}

void limit(int resource, rlim_t most) {
  const struct rlimit both { most, most };
  ::setrlimit(resource, &both);
}

std::size_t mostMemory(const Input& input) {
  return (std::size_t{1} << 29) + 64 * input.content.size();
}

[[noreturn]] void importAndSend(const Input& input, int to) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM, SIGPIPE}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
  ::alarm(static_cast<unsigned>(20 + input.content.size() / 500000));
  limit(RLIMIT_CORE, 0);
  std::size_t pages = 0;  // what the process has is the caller's
  if (std::ifstream("/proc/self/statm") >> pages) {
    limit(RLIMIT_AS, pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + mostMemory(input));
  }
  Soup soup;
  try {
    import(input.name, soup);
  } catch (const std::exception&) {
    const std::string_view words = "it takes more memory than a file of its size should";
    soup = Soup();
    soup.error.assign(words.begin(), words.end());
  }
  const auto write = [to](const void* data, std::size_t size) {
    for (const char* at = static_cast<const char*>(data); size > 0;) {
      const ssize_t n = ::write(to, at, size);
      if (n <= 0) ::_exit(1);
      at += n;
      size -= static_cast<std::size_t>(n);
    }
  };
  soup.each([&](const auto& array) {
    const std::size_t size = array.size() * sizeof array[0];
    write(&size, sizeof size);
    write(array.data(), size);
  });
  ::_exit(0);
}

/// What assimp makes of a file; with an error that nobody wrote if its process dies.
Soup importApart(const Input& input) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) input.refuse(nullptr, "there is no pipe to read it through.");
  const pid_t child = ::fork();
  if (child == 0) importAndSend(input, ends[1]);
  ::close(ends[1]);
  const auto read = [&](char* to, std::size_t size) {
    while (size > 0) {
      const ssize_t n = ::read(ends[0], to, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      to += n;
      size -= static_cast<std::size_t>(n);
    }
    return true;
  };
  Soup soup;
  bool whole = child > 0;
  soup.each([&](auto& array) {
    std::size_t size = 0;
    whole = whole && read(reinterpret_cast<char*>(&size), sizeof size);
    whole = whole && size <= mostMemory(input);  // it may have gone mad
    if (!whole) return;
    array.resize(size / sizeof array[0]);
    whole = read(reinterpret_cast<char*>(array.data()), size);
  });
  ::close(ends[0]);
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (!whole) input.refuse(nullptr, "it can't be read as a mesh: assimp fails on it.");
  return soup;
}

}  // namespace

Mesh readOther(const Input& input) {
  Soup soup = importApart(input);
  if (!soup.error.empty()) {
    input.refuse(nullptr, "it can't be read as a mesh: " +
                              std::string(soup.error.begin(), soup.error.end()) + ".");
  }
  Mesh mesh;
  mesh.vertices = std::move(soup.vertices);
  mesh.parts = static_cast<int>(soup.parts.size());
  Faces faces(input);
  for (const char *name = soup.objects.data(), *const end = name + soup.objects.size(); name < end;
       name += std::strlen(name) + 1) {
    faces.beginObject(name);
  }
  // The process sends whole faces, each followed by its object.
  for (std::size_t i = 0; i < soup.faces.size(); ++i) {
    const std::size_t end = std::min<std::size_t>(i + 1 + soup.faces[i], soup.faces.size() - 1);
    faces.resumeObject(static_cast<int>(soup.faces[end]));
    faces.begin(nullptr);
    while (++i < end) faces.add(soup.faces[i]);
  }
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    box.extend(mesh.vertices[i]);
    if (mesh.vertices[i].allFinite()) continue;
    input.refuse(nullptr, "vertex " + std::to_string(i) +
                              " is not finite; repair the mesh: no query can answer for it.");
  }
  faces.finish(mesh);
  // Binary formats keep floats themselves, but not what places them.
  const double farthest = std::max(-box.min().minCoeff(), box.max().maxCoeff());
  if (farthest * 0x1p-24 > 1e-6 * box.diagonal().norm()) {
    std::ostringstream text;
    text << "its coordinates, up to " << farthest << ", were read as floats, by which they may be "
         << farthest * 0x1p-24 << " off.";
    mesh.warnings.push_back(input.sentence(nullptr, text.str()));
  }
  return mesh;
}

}  // namespace kios::files
