// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "read_mesh.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "input.h"

namespace kios::files {
namespace {

std::uint64_t hashOf(const fcl::Vector3d& p) {
  std::uint64_t hash = 0;
  for (const double x : {p.x(), p.y(), p.z()}) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

std::string contentOf(const std::string& file, std::size_t most) {
  const auto fail = [&](const std::string& what) { throw OpenError(file + ": " + what, errno); };
  struct stat status {};
  // A FIFO would wait for its writer.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0 && errno == ENOENT) fail("there is no such file.");
  if (descriptor < 0) fail(std::string("it can't be opened: ") + std::strerror(errno) + ".");
  const struct Closed {
    int descriptor;
    ~Closed() { ::close(descriptor); }
  } closed{descriptor};
  if (::fstat(descriptor, &status) != 0) fail("it can't be read.");
  errno = EISDIR;
  if (S_ISDIR(status.st_mode)) fail("this is a directory, not a file.");
  const Input input{file, {}};
  if (!S_ISREG(status.st_mode)) input.refuse(nullptr, "this is no regular file.");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) input.refuse(nullptr, "the file is empty.");
  if (size > most) {
    input.refuse(nullptr, "it is too large: " + std::to_string(size) + " bytes, of at most " +
                              std::to_string(most) + ".");
  }
  std::string content;
  content.reserve(size + 1);
  content.resize(size);
  for (std::size_t at = 0; at < size;) {
    const ssize_t n = ::read(descriptor, &content[at], size - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("it can't be read to its end.");
    at += static_cast<std::size_t>(n);
  }
  return content;
}

Mesh readMesh(const std::string& file) {
  return readMesh(file, contentOf(file, std::size_t{1} << 32));
}

Mesh readMesh(const std::string& file, std::string content) {
  content += '\n';
  const Input input{file, std::string_view(content).substr(0, content.size() - 1)};
  std::string kind = std::filesystem::path(file).extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto read = kind == ".stl"   ? readStl
                    : kind == ".obj" ? readObj
                    : kind == ".off" ? readOff
                    : kind == ".ply" ? readPly
#ifdef KIOS_HAVE_TINYXML2
                    : kind == ".dae" ? readDae
#endif
                                     : readOther;
  return read(input);
}

void weld(Mesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  std::size_t size = 16;
  while (size < 2 * n) size *= 2;
  constexpr std::size_t kFree = SIZE_MAX;
  std::vector<std::size_t> table(size, kFree), renumbered(n);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const fcl::Vector3d p = mesh.vertices[i].array() + 0.0;  // -0 is 0
    std::size_t slot = hashOf(p) & (size - 1);
    while (table[slot] != kFree && mesh.vertices[table[slot]] != p) slot = (slot + 1) & (size - 1);
    if (table[slot] == kFree) {
      table[slot] = kept;
      mesh.vertices[kept++] = p;
    }
    renumbered[i] = table[slot];
  }
  mesh.vertices.resize(kept);
  for (fcl::Triangle& t : mesh.triangles) {
    t.set(renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]);
  }
}

}  // namespace kios::files
