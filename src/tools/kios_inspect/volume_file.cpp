// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "volume_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace kios::inspect {
namespace {

using Json = nlohmann::ordered_json;

/// Little-endian, as both formats are, whatever the machine.
void put(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}
void put(std::string& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  put(out, bits);
}
template <typename T>
void put(std::string& out, const std::array<T, 3>& values) {
  for (const T& value : values) put(out, value);
}

std::string ply(const std::vector<PaintedMesh>& meshes) {
  std::size_t vertices = 0, triangles = 0;
  for (const PaintedMesh& mesh : meshes) {
    vertices += mesh.vertices.size();
    triangles += mesh.triangles.size();
  }
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment written by kios_inspect\n";
  out += "element vertex " + std::to_string(vertices) + "\n";
  for (const char* name :
       {"float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"}) {
    out += std::string("property ") + name + "\n";
  }
  out += "element face " + std::to_string(triangles) + "\n";
  out += "property list uchar uint vertex_indices\nend_header\n";
  for (const PaintedMesh& mesh : meshes) {
    for (const auto& vertex : mesh.vertices) {
      put(out, vertex);
      for (const std::uint8_t channel : mesh.color) out += static_cast<char>(channel);
    }
  }
  std::uint32_t first = 0;
  for (const PaintedMesh& mesh : meshes) {
    for (const auto& triangle : mesh.triangles) {
      out += '\3';
      for (const std::uint32_t corner : triangle) put(out, first + corner);
    }
    first += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  return out;
}

/// Arrays in one binary buffer, and what glTF wants to know of each.
class Buffer {
 public:
  static constexpr int kFloat = 5126, kUnsigned = 5125;          // component types
  static constexpr int kVertexBuffer = 34962, kIndices = 34963;  // targets

  template <typename T>
  int add(const std::vector<std::array<T, 3>>& values, int component, int target, bool bounds) {
    const std::size_t begin = bytes_.size();
    for (const auto& value : values) put(bytes_, value);
    views_.push_back({{"buffer", 0},
                      {"byteOffset", begin},
                      {"byteLength", bytes_.size() - begin},
                      {"target", target}});
    const bool indices = target == kIndices;
    Json accessor = {{"bufferView", views_.size() - 1},
                     {"componentType", component},
                     {"count", indices ? 3 * values.size() : values.size()},
                     {"type", indices ? "SCALAR" : "VEC3"}};
    if (bounds) {
      std::array<T, 3> lower = values.front(), upper = lower;
      for (const auto& value : values) {
        for (int i = 0; i < 3; ++i) {
          lower[i] = std::min(lower[i], value[i]);
          upper[i] = std::max(upper[i], value[i]);
        }
      }
      accessor["min"] = lower;
      accessor["max"] = upper;
    }
    accessors_.push_back(accessor);
    return static_cast<int>(accessors_.size()) - 1;
  }

  const std::string& bytes() const { return bytes_; }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

/// glTF's colours are linear.
double linear(std::uint8_t channel) {
  const double encoded = channel / 255.0;
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Json material(const PaintedMesh& mesh) {
  const auto& [red, green, blue] = mesh.color;
  Json result = {{"pbrMetallicRoughness",
                  {{"baseColorFactor",
                    {linear(red), linear(green), linear(blue), mesh.see_through ? 0.4 : 1.0}},
                   {"metallicFactor", 0},
                   {"roughnessFactor", 0.6}}}};
  if (mesh.see_through) {
    result["alphaMode"] = "BLEND";
  } else {
    result["doubleSided"] = true;
  }
  return result;
}

std::string glb(const std::vector<PaintedMesh>& meshes) {
  Buffer buffer;
  Json nodes = Json::array(), gltf_meshes = Json::array(), materials = Json::array();
  Json roots = Json::array();
  for (const PaintedMesh& mesh : meshes) {
    Json attributes = {
        {"POSITION", buffer.add(mesh.vertices, Buffer::kFloat, Buffer::kVertexBuffer, true)}};
    if (!mesh.normals.empty()) {
      attributes["NORMAL"] = buffer.add(mesh.normals, Buffer::kFloat, Buffer::kVertexBuffer, false);
    }
    const int indices = buffer.add(mesh.triangles, Buffer::kUnsigned, Buffer::kIndices, false);
    roots.push_back(nodes.size());
    nodes.push_back({{"name", mesh.name}, {"mesh", gltf_meshes.size()}});
    gltf_meshes.push_back(
        {{"name", mesh.name},
         {"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"material", materials.size()}}}}});
    materials.push_back(material(mesh));
  }
  const Json document = {{"asset", {{"version", "2.0"}, {"generator", "kios_inspect"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", roots}}}},
                         {"nodes", nodes},
                         {"meshes", gltf_meshes},
                         {"materials", materials},
                         {"accessors", buffer.accessors()},
                         {"bufferViews", buffer.views()},
                         {"buffers", {{{"byteLength", buffer.bytes().size()}}}}};
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const std::size_t total = 12 + 8 + text.size() + 8 + buffer.bytes().size();
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw OutputError("a .glb file holds at most 4 GB: choose a lower --level or --detail.");
  }
  std::string out;
  for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(total),
                                   static_cast<std::uint32_t>(text.size()), kJson}) {
    put(out, word);
  }
  out += text;
  put(out, static_cast<std::uint32_t>(buffer.bytes().size()));
  put(out, kBinary);
  return out + buffer.bytes();
}

}  // namespace

void writeFile(const std::filesystem::path& file, const std::string& content) {
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw OutputError(file.string() + ": it can't be written: " + std::strerror(errno) + ".");
  }
}

bool isMeshFile(const std::filesystem::path& file) {
  return file.extension() == ".ply" || file.extension() == ".glb";
}

void writeMeshes(const std::filesystem::path& file, const std::vector<PaintedMesh>& meshes) {
  writeFile(file, file.extension() == ".ply" ? ply(meshes) : glb(meshes));
}

}  // namespace kios::inspect
