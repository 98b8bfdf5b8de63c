// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/storage.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "build/mesh_tree.h"
#include "model/kios_model.h"
#include "model/prepared.h"
#include "model/stored_format.h"

namespace kios {
namespace {

using stored::Header, stored::kMagic, stored::kVersion, stored::Layout, stored::Node,
    stored::refuseStored;

/// The members one by one: padding has any bytes.
template <typename S>
void store(const Node<S>& from, unsigned char* to) {
  Node<S> clean;
  std::memset(static_cast<void*>(&clean), 0, sizeof(clean));
  clean.first_child = from.first_child;
  clean.first_primitive = from.first_primitive;
  clean.num_primitives = from.num_primitives;
  const kIOS<S>& bv = from.bv;
  clean.bv.center0 = bv.center0;
  clean.bv.radius0 = bv.radius0;
  for (int i = 0; i < kIOS<S>::kCaps; ++i) {
    clean.bv.cap_x[i] = bv.cap_x[i];
    clean.bv.cap_y[i] = bv.cap_y[i];
    clean.bv.cap_z[i] = bv.cap_z[i];
    clean.bv.cap_r[i] = bv.cap_r[i];
  }
  clean.bv.reach = bv.reach;
  clean.bv.exponent = bv.exponent;
  clean.bv.num_spheres = bv.num_spheres;
  std::memcpy(to, static_cast<const void*>(&clean), sizeof(clean));
}

template <typename S>
std::shared_ptr<Model<S>> rebuilt(const Model<S>& model) {
  const auto copy = makeModel<S>({model.vertices, model.vertices + model.num_vertices},
                                 {model.tri_indices, model.tri_indices + model.num_tris});
  copy->cost_density = model.cost_density;
  copy->threshold_occupied = model.threshold_occupied;
  copy->threshold_free = model.threshold_free;
  return copy;
}

/// Without its tree where that isn't the ordinary one of its mesh.
template <typename S>
std::vector<unsigned char> write(const Model<S>& model) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.scalar = sizeof(S);
  header.num_triangles = static_cast<std::uint32_t>(model.num_tris);
  header.num_vertices = static_cast<std::uint32_t>(model.num_vertices);
  header.num_nodes = preparedOf(model).ordinary ? static_cast<std::uint32_t>(model.getNumBVs()) : 0;
  header.cost_density = model.cost_density;
  header.threshold_occupied = model.threshold_occupied;
  header.threshold_free = model.threshold_free;
  const Layout at = Layout::of(header, S());
  header.size = at.end;
  std::vector<unsigned char> bytes(at.end);
  for (int i = 0; i < static_cast<int>(header.num_nodes); ++i) {
    const Node<S>& node = model.getBV(i);
    store(node, &bytes[at.nodes + static_cast<std::size_t>(i) * sizeof(node)]);
    if (!node.isLeaf()) continue;
    const auto primitive = static_cast<std::uint32_t>(node.primitiveId());
    std::memcpy(&bytes[at.primitives + 4 * static_cast<std::size_t>(node.first_primitive)],
                &primitive, 4);
  }
  std::memcpy(&bytes[at.vertices], reinterpret_cast<const unsigned char*>(model.vertices),
              header.num_vertices * 3 * sizeof(S));
  for (std::size_t t = 0; t < header.num_triangles; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = static_cast<std::uint32_t>(model.tri_indices[t][corner]);
      std::memcpy(&bytes[at.triangles + 12 * t + 4 * static_cast<std::size_t>(corner)], &vertex, 4);
    }
  }
  const XXH128_hash_t hash =
      stored::hashOf(header, &bytes[sizeof(header)], bytes.size() - sizeof(header));
  header.hash_low = hash.low64;
  header.hash_high = hash.high64;
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

/// In integers, as floats would raise flags: all exponent bits are set where it is not finite.
template <typename Float>
bool isFinite(Float x) {
  using Bits = std::conditional_t<sizeof(x) == 8, std::uint64_t, std::uint32_t>;
  constexpr Bits kExponent = sizeof(x) == 8 ? Bits(0x7FF0000000000000) : Bits(0x7F800000);
  Bits bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return (bits & kExponent) != kExponent;
}

/// Reads the header of bytes whose hash is right, which may be altered all the same.
template <typename S>
Header readHeader(const unsigned char* bytes, std::size_t size) {
  Header header;
  if (size < sizeof(header) || std::memcmp(bytes, kMagic, sizeof(kMagic)) != 0) {
    refuseStored(size < sizeof(header) ? "is cut off."
                                       : "is none: it doesn't begin as kios::save() does.");
  }
  std::memcpy(&header, bytes, sizeof(header));
  if (header.version > kVersion) {
    refuseStored("was written by a newer version of fcl_kios, in format " +
                 std::to_string(header.version) + "; this one reads up to " +
                 std::to_string(kVersion) + ".");
  }
  if (header.size > size) refuseStored("is cut off.");
  if (header.size < sizeof(header) || header.size != size || header.version == 0) {
    refuseStored("was altered: its size is wrong.");
  }
  if (header.scalar != sizeof(S)) {
    if (header.scalar != 4 && header.scalar != 8) refuseStored("was altered: its scalar is none.");
    refuseStored(header.scalar == 4 ? "is one of floats: load<float>() reads it."
                                    : "is one of doubles: load<double>() reads it.");
  }
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max() / 2;
  const std::uint32_t n = header.num_triangles;
  const std::uint64_t end = Layout::of(header, S()).end;
  std::uint32_t older = header.older0;
  for (const std::uint32_t count : header.older) older |= count;
  if (n == 0 || n > kMost || header.num_vertices == 0 || header.num_vertices > kMost ||
      (header.num_nodes != 0 && header.num_nodes != 2 * n - 1) ||
      (header.isOlder() ? end > size : end != size || older != 0)) {
    refuseStored("was altered: its counts are wrong.");
  }
  const XXH128_hash_t hash = stored::hashOf(header, bytes + sizeof(header), size - sizeof(header));
  if (hash.low64 != header.hash_low || hash.high64 != header.hash_high) {
    refuseStored("was altered: its hash is wrong.");
  }
  return header;
}

/// Whether a node's volume is one.
template <typename S>
bool isVolume(const kIOS<S>& v) {
  const int k = v.num_spheres;
  bool finite = isFinite(v.radius0) && isFinite(v.reach);
  for (int c = 0; c < 3; ++c) finite = finite && isFinite(v.center0[c]);
  for (const float* const caps : {v.cap_x, v.cap_y, v.cap_z, v.cap_r}) {
    for (int i = 0; i < kIOS<S>::kCaps; ++i) finite = finite && isFinite(caps[i]);
  }
  return finite && (k == 1 || k == 3 || k == 5);
}

/// Whether nodes are a tree over so many triangles, in the order of FCL's recursion. Writes the
/// triangles of the leaves to `primitives`, in their order.
template <typename S>
bool isTree(const Node<S>* nodes, int num_triangles, unsigned int* primitives) {
  struct Open {
    int node, first, count, depth;
  };
  Open waiting[engine::kMaxDepth + 2] = {{0, 0, num_triangles, 1}};
  int num_waiting = 1, next = 1;
  while (num_waiting > 0) {
    const Open at = waiting[--num_waiting];
    const Node<S>& node = nodes[at.node];
    if (node.first_primitive != at.first || node.num_primitives != at.count || !isVolume(node.bv)) {
      return false;
    }
    if (at.count == 1) {
      const int triangle = ~node.first_child;  // -(it + 1)
      if (triangle < 0 || triangle >= num_triangles) return false;
      primitives[at.first] = static_cast<unsigned int>(triangle);
      continue;
    }
    const int left = nodes[next].num_primitives;
    if (node.first_child != next || left < 1 || left >= at.count || at.depth >= engine::kMaxDepth) {
      return false;
    }
    waiting[num_waiting++] = {next + 1, at.first + left, at.count - left, at.depth + 1};
    waiting[num_waiting++] = {next, at.first, left, at.depth + 1};
    next += 2;
  }
  return true;
}

// The parts of a stored model, whose places were checked, are copied, and what they hold is
// checked.

/// The nodes and primitives of the tree: each triangle is one of these.
template <typename S>
PreparedHandle readTree(const unsigned char* bytes, const Header& header) {
  const Layout at = Layout::of(header, S());
  const std::size_t num_nodes = header.num_nodes, n = header.num_triangles;
  PreparedHandle made = makePrepared<S>(static_cast<int>(num_nodes));
  Node<S>* const nodes = made->template nodes<S>();
  unsigned int* const primitives = made->template primitives<S>();
  std::memcpy(static_cast<void*>(nodes), bytes + at.nodes, num_nodes * sizeof(*nodes));
  std::vector<bool> met(n, false);
  const bool is_tree = isTree(nodes, static_cast<int>(n), primitives) &&
                       std::memcmp(primitives, bytes + at.primitives, n * sizeof(*primitives)) == 0;
  for (std::size_t i = 0; is_tree && i < n; ++i) met[primitives[i]] = true;
  if (std::find(met.begin(), met.end(), false) != met.end()) {
    refuseStored("was altered: its tree is none of its triangles.");
  }
  made->ordinary = true;
  return made;
}

template <typename S>
void readVertices(const unsigned char* bytes, const Header& header, fcl::Vector3<S>* to) {
  const std::size_t n = header.num_vertices;
  std::memcpy(reinterpret_cast<unsigned char*>(to), bytes + Layout::of(header, S()).vertices,
              n * sizeof(*to));
  for (std::size_t i = 0; i < n; ++i) {
    if (isFinite(to[i][0]) && isFinite(to[i][1]) && isFinite(to[i][2])) continue;
    refuseStored("was altered: a vertex is not finite.");
  }
}

void readTriangles(const unsigned char* stored, const Header& header, fcl::Triangle* to) {
  for (std::size_t t = 0; t < header.num_triangles; ++t) {
    std::uint32_t corners[3];
    std::memcpy(corners, stored + sizeof(corners) * t, sizeof(corners));
    if (std::max({corners[0], corners[1], corners[2]}) >= header.num_vertices) {
      refuseStored("was altered: a triangle refers to a vertex that it doesn't have.");
    }
    to[t].set(corners[0], corners[1], corners[2]);
  }
}

}  // namespace

template <typename S>
std::vector<unsigned char> save(const Model<S>& model) {
  validate(model);
  return write(preparedOf(model).ordinary ? model : *rebuilt(model));
}

template std::vector<unsigned char> save(const Modeld&);
template std::vector<unsigned char> save(const Modelf&);

template <typename S>
std::shared_ptr<Model<S>> load(const void* bytes, std::size_t size) {
  const auto* const begin = static_cast<const unsigned char*>(bytes);
  const Header header = readHeader<S>(begin, size);
  const bool has_tree = header.num_nodes != 0 && !header.isOlder();
  PreparedHandle tree = has_tree ? readTree<S>(begin, header) : nullptr;
  auto model = std::make_shared<Model<S>>();
  model->cost_density = roundedTo<S>(header.cost_density);
  model->threshold_occupied = roundedTo<S>(header.threshold_occupied);
  model->threshold_free = roundedTo<S>(header.threshold_free);
  requireBuilt(model->beginModel(static_cast<int>(header.num_triangles),
                                 static_cast<int>(header.num_vertices)));
  readVertices(begin, header, model->vertices);
  readTriangles(begin + Layout::of(header, S()).triangles, header, model->tri_indices);
  model->num_vertices = static_cast<int>(header.num_vertices);
  model->num_tris = static_cast<int>(header.num_triangles);
  if (tree) {  // endModel() finds it, or an equal one
    const engine::ContentHash content = engine::contentHash(viewOf(*model));
    if (PreparedHandle equal = findPrepared(content)) {
      tree = std::move(equal);
    } else {
      prepareTree(*model, *tree.get());
      list(tree, content);
    }
  }
  requireBuilt(model->endModel());
  return model;
}

template std::shared_ptr<Modeld> load<double>(const void* bytes, std::size_t size);
template std::shared_ptr<Modelf> load<float>(const void* bytes, std::size_t size);

}  // namespace kios
