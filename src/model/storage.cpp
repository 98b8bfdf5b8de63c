// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model/storage.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "build/mesh_tree.h"
#include "model/lent_volumes.h"
#include "model/prepared.h"

#define XXH_INLINE_ALL  // the library links nothing for it
#include <xxhash.h>

namespace kios {
namespace {

// The file is what memory holds on little-endian machines with these sizes, so that a load copies.
template <typename S>
using Node = fcl::BVNode<kIOS<S>>;
static_assert(sizeof(Node<double>) == 128 && sizeof(Node<float>) == 112);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "Stored models are little-endian."
#endif

constexpr char kMagic[8] = {'k', 'i', 'o', 's', 'm', 'e', 's', 'h'};
constexpr std::uint32_t kVersion = 1;

/// After it lie, each on a multiple of 16 bytes and padded with zeros: the nodes, the primitives
/// in the order of the leaves (uint32), the vertices, the triangles (three uint32 each).
struct Header {
  char magic[8];
  std::uint32_t version, scalar;      ///< sizeof(S)
  std::uint64_t size;                 ///< of all
  std::uint64_t hash_low, hash_high;  ///< XXH3 of all, these two taken as 0
  std::uint32_t num_triangles, num_vertices;
  std::uint32_t num_nodes;  ///< 0 if the mesh has no tree of the ordinary kind
  std::uint32_t unused;
  double cost_density, threshold_occupied, threshold_free;
  std::uint64_t unused_too[2];
};
static_assert(sizeof(Header) == 96);

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("fcl_kios: the stored model " + what);
}

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 15) / 16 * 16; }

/// Where each part begins.
struct Layout {
  std::uint64_t nodes, primitives, vertices, triangles, size;

  template <typename S>
  static Layout of(const Header& h, S /*scalar*/) {
    Layout at{};
    at.nodes = sizeof(Header);
    at.primitives = at.nodes + padded(h.num_nodes * std::uint64_t{sizeof(Node<S>)});
    at.vertices = at.primitives + padded(h.num_nodes == 0 ? 0 : h.num_triangles * std::uint64_t{4});
    at.triangles = at.vertices + padded(h.num_vertices * std::uint64_t{3 * sizeof(S)});
    at.size = at.triangles + padded(h.num_triangles * std::uint64_t{12});
    return at;
  }
};

void setHash(Header& header, const unsigned char* rest) {
  header.hash_low = header.hash_high = 0;
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, &header, sizeof(header));
  XXH3_128bits_update(&state, rest, header.size - sizeof(header));
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  header.hash_low = hash.low64;
  header.hash_high = hash.high64;
}

/// The members one by one: padding has any bytes, and stamps are the process's own.
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
bool hasOrdinaryTree(const Model<S>& model) {
  const engine::TreeCache* const trees = treesOf(model);
  return trees && trees->isBuilt(model.getBV(0).bv.stamp);
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

template <typename S>
std::vector<unsigned char> write(const Model<S>& model, bool with_tree) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.scalar = sizeof(S);
  header.num_triangles = static_cast<std::uint32_t>(model.num_tris);
  header.num_vertices = static_cast<std::uint32_t>(model.num_vertices);
  header.num_nodes = with_tree ? static_cast<std::uint32_t>(model.getNumBVs()) : 0;
  header.cost_density = model.cost_density;
  header.threshold_occupied = model.threshold_occupied;
  header.threshold_free = model.threshold_free;
  const Layout at = Layout::of(header, S());
  header.size = at.size;
  std::vector<unsigned char> bytes(at.size);
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
  setHash(header, &bytes[sizeof(header)]);
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

/// Reads the header of bytes that are whole and unaltered.
template <typename S>
Header readHeader(const unsigned char* bytes, std::size_t size) {
  Header header;
  if (size < sizeof(header) || std::memcmp(bytes, kMagic, sizeof(kMagic)) != 0) {
    refuse(size < sizeof(header) ? "is cut off."
                                 : "is none: it doesn't begin as kios::save() does.");
  }
  std::memcpy(&header, bytes, sizeof(header));
  if (header.version > kVersion) {
    refuse("was written by a newer version of fcl_kios, in format " +
           std::to_string(header.version) + "; this one reads up to " + std::to_string(kVersion) +
           ".");
  }
  if (header.size > size) refuse("is cut off.");
  Header hashed = header;
  if (header.size < sizeof(header) || header.size != size || header.version == 0) {
    refuse("was altered: its size is wrong.");
  }
  setHash(hashed, bytes + sizeof(header));
  if (hashed.hash_low != header.hash_low || hashed.hash_high != header.hash_high) {
    refuse("was altered: its hash is wrong.");
  }
  if (header.scalar != sizeof(S)) {
    refuse(header.scalar == 4 ? "is one of floats: load<float>() reads it."
                              : "is one of doubles: load<double>() reads it.");
  }
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max() / 2;
  const std::uint32_t n = header.num_triangles;
  if (n == 0 || n > kMost || header.num_vertices == 0 || header.num_vertices > kMost ||
      (header.num_nodes != 0 && header.num_nodes != 2 * n - 1) ||
      Layout::of(header, S()).size != size) {
    refuse("was altered: its counts are wrong.");
  }
  return header;
}

/// FCL's recursion numbers the nodes: all but how many triangles go left is known beforehand.
/// Searches hold the way from the root in arrays of kMaxDepth.
template <typename S>
bool isTreeOf(const Node<S>* nodes, const unsigned int* primitives, int n) {
  struct Expected {
    int node, first, count, depth;
  };
  std::vector<bool> met(static_cast<std::size_t>(n));
  std::vector<Expected> stack = {{0, 0, n, 1}};
  int num_nodes = 1;
  while (!stack.empty()) {
    const Expected at = stack.back();
    stack.pop_back();
    const Node<S>& node = nodes[at.node];
    const int k = node.bv.num_spheres;
    const bool known = k == 1 || k == 3 || k == 5;
    if (!known || at.depth > engine::kMaxDepth || node.first_primitive != at.first ||
        node.num_primitives != at.count) {
      return false;
    }
    if (at.count == 1) {
      const unsigned int triangle = primitives[at.first];
      if (triangle >= static_cast<unsigned int>(n) || met[triangle] ||
          node.first_child != -static_cast<int>(triangle) - 1) {
        return false;
      }
      met[triangle] = true;
      continue;
    }
    if (node.first_child != num_nodes) return false;
    num_nodes += 2;
    const int left = nodes[node.first_child].num_primitives;
    if (left < 1 || left >= at.count) return false;
    stack.push_back({node.first_child + 1, at.first + left, at.count - left, at.depth + 1});
    stack.push_back({node.first_child, at.first, left, at.depth + 1});
  }
  return true;
}

/// Lends a stored tree to the build of the one model that it is loaded for.
template <typename S>
class StoredTree {
 public:
  StoredTree(const unsigned char* nodes, const unsigned char* primitives)
      : nodes_(reinterpret_cast<const Node<S>*>(nodes)),
        primitives_(reinterpret_cast<const unsigned int*>(primitives)) {}
  StoredTree(const StoredTree&) = delete;
  ~StoredTree() { withdrawVolumes(nodes_); }

  void lend(const Model<S>& model) const {
    if (!isTreeOf<S>(nodes_, primitives_, model.num_tris)) {
      refuse("was altered: its tree is none of its triangles.");
    }
    lendVolumes(engine::contentHash(viewOf(model)), nodes_, primitives_);
  }

 private:
  const Node<S>* const nodes_;
  const unsigned int* const primitives_;
};

void requireBuilt(int status) {
  if (status == fcl::BVH_ERR_MODEL_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != fcl::BVH_OK) throw std::logic_error("fcl_kios: FCL refused to build a new model.");
}

}  // namespace

template <typename S>
std::vector<unsigned char> save(const Model<S>& model) {
  validate(model);
  if (hasOrdinaryTree(model)) return write(model, true);
  const std::shared_ptr<Model<S>> ordinary = rebuilt(model);
  return write(*ordinary, hasOrdinaryTree(*ordinary));
}

template <typename S>
std::shared_ptr<Model<S>> load(const void* bytes, std::size_t size) {
  const auto* begin = static_cast<const unsigned char*>(bytes);
  std::vector<double> aligned;
  if (reinterpret_cast<std::uintptr_t>(begin) % alignof(double) != 0) {
    aligned.resize(size / sizeof(double) + 1);
    std::memcpy(aligned.data(), bytes, size);
    begin = reinterpret_cast<const unsigned char*>(aligned.data());
  }
  const Header header = readHeader<S>(begin, size);
  const Layout at = Layout::of(header, S());
  auto model = std::make_shared<Model<S>>();
  model->cost_density = header.cost_density;
  model->threshold_occupied = header.threshold_occupied;
  model->threshold_free = header.threshold_free;
  requireBuilt(model->beginModel(static_cast<int>(header.num_triangles),
                                 static_cast<int>(header.num_vertices)));
  std::memcpy(static_cast<void*>(model->vertices), begin + at.vertices,
              header.num_vertices * 3 * sizeof(S));
  model->num_vertices = static_cast<int>(header.num_vertices);
  for (std::size_t v = 0; v < header.num_vertices; ++v) {
    if (!model->vertices[v].allFinite()) refuse("was altered: a vertex is not finite.");
  }
  for (std::size_t t = 0; t < header.num_triangles; ++t) {
    std::uint32_t stored[3];
    std::memcpy(stored, begin + at.triangles + 12 * t, sizeof(stored));
    const std::size_t corners[3] = {stored[0], stored[1], stored[2]};
    if (std::max({stored[0], stored[1], stored[2]}) >= header.num_vertices) {
      refuse("was altered: a triangle refers to a vertex that it doesn't have.");
    }
    static_assert(sizeof(fcl::Triangle) == sizeof(corners));
    std::memcpy(static_cast<void*>(&model->tri_indices[t]), corners, sizeof(corners));
  }
  model->num_tris = static_cast<int>(header.num_triangles);
  if (header.num_nodes == 0) {
    requireBuilt(model->endModel());
    return model;
  }
  const StoredTree<S> tree(begin + at.nodes, begin + at.primitives);
  tree.lend(*model);
  requireBuilt(model->endModel());
  return model;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_INSTANTIATE(S)                                        \
  template std::vector<unsigned char> save(const Model<S>& model); \
  template std::shared_ptr<Model<S>> load<S>(const void* bytes, std::size_t size);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace kios
