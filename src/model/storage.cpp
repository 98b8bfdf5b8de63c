// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model/storage.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "model/prepared.h"
#include "model/stored_format.h"

namespace kios {
namespace {

using stored::Hash, stored::Header, stored::kMagic, stored::kVersion, stored::Layout, stored::Node,
    stored::PreparedValues;

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

void countPrepared(const engine::Tree& tree, Header& header) {
  header.num_leaves = static_cast<std::uint32_t>(tree.leaves.size());
  header.num_blocks = static_cast<std::uint32_t>(tree.children.size());
  header.num_lanes = static_cast<std::uint32_t>(tree.lanes.size());
  header.num_features = static_cast<std::uint32_t>(tree.features.size());
  header.parts =
      (tree.boxes.empty() ? 0 : Header::kBoxes) | (tree.corners.empty() ? 0 : Header::kCorners);
}

void store(const engine::Tree& tree, const Layout& at, unsigned char* bytes) {
  PreparedValues values{};
  std::copy_n(tree.origin, 3, values.origin);
  values.cost = tree.cost;
  values.reach = tree.reach;
  values.mean_leaf = tree.mean_leaf;
  values.widest_leaf = tree.widest_leaf;
  values.root_box = tree.root_box;
  std::memcpy(bytes + at.prepared, &values, sizeof(values));
  const auto put = [bytes](const auto& array, std::uint64_t place) {
    if (array.empty()) return;
    std::memcpy(bytes + place, static_cast<const void*>(array.data()),
                array.size() * sizeof(array[0]));
  };
  put(tree.nodes, at.prepared_nodes);
  put(tree.boxes, at.boxes);
  put(tree.children, at.children);
  put(tree.leaves, at.leaves);
  put(tree.lanes, at.lanes);
  put(tree.features, at.features);
  put(tree.corners, at.corners);
}

/// `prepared` may be nullptr.
template <typename S>
std::vector<unsigned char> write(const Model<S>& model, bool with_tree,
                                 const engine::Tree* prepared) {
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
  if (prepared) countPrepared(*prepared, header);
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
  if (prepared) store(*prepared, at, bytes.data());
  Hash hash(header);
  hash.add(&bytes[sizeof(header)], bytes.size() - sizeof(header));
  hash.writeTo(header);
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

}  // namespace

template <typename S>
std::vector<unsigned char> save(const Model<S>& model) {
  validate(model);
  if (hasOrdinaryTree(model)) return write(model, true, purelyPreparedTree(model).get());
  const std::shared_ptr<Model<S>> ordinary = rebuilt(model);
  return write(*ordinary, hasOrdinaryTree(*ordinary), purelyPreparedTree(*ordinary).get());
}

template std::vector<unsigned char> save(const Modeld&);
template std::vector<unsigned char> save(const Modelf&);

}  // namespace kios
