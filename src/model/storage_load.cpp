// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Loading stored models: each byte is read once, and hashed, checked and copied while it is in the
// cache.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "build/mesh_tree.h"
#include "fcl_kios/model/storage.h"
#include "model/kios_model.h"
#include "model/prepared.h"
#include "model/stored_format.h"
#include "model/stored_tree.h"
#include "tree/adopt.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace kios {
namespace {

using stored::Hash, stored::Header, stored::kMagic, stored::kVersion, stored::Layout, stored::Node,
    stored::PreparedValues, stored::refuseStored;

constexpr std::size_t kBlock = 16384;  ///< bytes that are hashed, then copied

/// Reads the header of bytes that are whole, and may be altered.
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
  const bool may_be_prepared = header.version > 1 && header.num_nodes != 0;
  const bool counts_prepared = (header.num_leaves | header.num_blocks | header.num_lanes |
                                header.num_features | header.parts) != 0;
  if (n == 0 || n > kMost || header.num_vertices == 0 || header.num_vertices > kMost ||
      (header.num_nodes != 0 && header.num_nodes != 2 * n - 1) ||
      (counts_prepared && !(may_be_prepared && header.hasPrepared())) ||
      header.parts > (Header::kBoxes | Header::kCorners) || Layout::of(header, S()).size != size) {
    refuseStored("was altered: its counts are wrong.");
  }
  return header;
}

/// Checks nodes that come in their order, in which FCL's recursion numbers them: all but how many
/// triangles go left is known beforehand. Searches hold the way from the root in arrays of
/// kMaxDepth.
template <typename S>
class NodeCheck {
 public:
  /// The triangles of the leaves are written to `primitives`, in their order.
  NodeCheck(int num_triangles, unsigned int* primitives)
      : num_triangles_(num_triangles), primitives_(primitives) {}

  bool takeRoot(const Node<S>& root) {
    if (root.first_primitive != 0 || root.num_primitives != num_triangles_ || !isVolume(root)) {
      return false;
    }
    return take(root, 1);
  }

  /// Takes the two children that come next.
  bool takeChildren(const Node<S>* pair) {
    if (open_ == 0) return false;
    const Open parent = stack_[--open_];
    const Node<S>&left = pair[0], &right = pair[1];
    const int left_count = left.num_primitives;
    if (parent.first_child != next_ || parent.depth >= engine::kMaxDepth || left_count < 1 ||
        left_count >= parent.count || left.first_primitive != parent.first ||
        right.first_primitive != parent.first + left_count ||
        right.num_primitives != parent.count - left_count || !(isVolume(left) && isVolume(right))) {
      return false;
    }
    next_ += 2;
    const bool right_is_sound = take(right, parent.depth + 1);
    return take(left, parent.depth + 1) && right_is_sound;
  }

  bool isWhole() const { return open_ == 0; }

 private:
  /// A node whose children come later.
  struct Open {
    int first_child, first, count, depth;
  };

  static bool isVolume(const Node<S>& node) {
    const int k = node.bv.num_spheres;
    return k == 1 || k == 3 || k == 5;
  }

  /// Takes a node whose range is known to be sound. What isn't a leaf writes a primitive that its
  /// first leaf overwrites, as no branch could be foreseen here.
  bool take(const Node<S>& node, int depth) {
    const bool is_leaf = node.num_primitives == 1;
    const int triangle = ~node.first_child;  // -(it + 1)
    primitives_[node.first_primitive] = static_cast<unsigned int>(triangle);
    stack_[open_] = {node.first_child, node.first_primitive, node.num_primitives, depth};
    open_ += is_leaf ? 0 : 1;
    return !is_leaf || (triangle >= 0 && triangle < num_triangles_);
  }

  const int num_triangles_;
  unsigned int* const primitives_;
  int next_ = 1;  ///< the next pair's place
  int open_ = 0;
  Open stack_[engine::kMaxDepth + 2];
};

/// Returns memory for nodes, which have any bytes until they are written: large trees take longer
/// to clear than to copy.
template <typename S>
std::unique_ptr<Node<S>[]> nodesToFill(std::size_t n) {
  // As `delete[]` frees what `new[]` made of a type without a destructor.
  static_assert(std::is_trivially_destructible<Node<S>>::value &&
                alignof(Node<S>) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  void* const memory = ::operator new[](n * sizeof(Node<S>));
#if defined(MADV_HUGEPAGE)
  // A fault costs as much as copying its 4 KiB. Only whole pages of 2 MiB, which the array fills
  // anyway, are asked for; a system that has none to give ignores it.
  constexpr std::uintptr_t kHugePage = 1U << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto first = (begin + kHugePage - 1) & ~(kHugePage - 1),
             end = (begin + n * sizeof(Node<S>)) & ~(kHugePage - 1);
  if (end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
  return std::unique_ptr<Node<S>[]>(static_cast<Node<S>*>(memory));
}

/// Copies the parts of a stored model, whose places were checked, in their order.
template <typename S>
class Reader {
 public:
  Reader(const unsigned char* bytes, const Header& header)
      : bytes_(bytes), header_(header), at_(Layout::of(header, S())), hash_(header) {}

  std::shared_ptr<StoredTree<S>> tree() {
    auto tree = std::make_shared<StoredTree<S>>();
    const auto n = static_cast<int>(header_.num_triangles);
    const std::size_t num_nodes = header_.num_nodes;
    tree->nodes = nodesToFill<S>(num_nodes);
    tree->primitives.reset(new unsigned int[header_.num_triangles]);
    NodeCheck<S> check(n, tree->primitives.get());
    constexpr std::size_t kPairs = kBlock / (2 * sizeof(Node<S>));
    copyNodes(tree->nodes.get(), 0, 1);
    bool sound = check.takeRoot(tree->nodes[0]);
    for (std::size_t i = 1; sound && i < num_nodes; i += 2 * kPairs) {
      const std::size_t count = std::min(2 * kPairs, num_nodes - i);
      copyNodes(tree->nodes.get(), i, count);
      for (std::size_t k = 0; sound && k < count; k += 2) {
        sound = check.takeChildren(&tree->nodes[i + k]);
      }
    }
    if (!sound || !check.isWhole() || !hasAll(tree->primitives.get())) {
      refuseStored("was altered: its tree is none of its triangles.");
    }
    hash_.add(bytes_ + at_.nodes + num_nodes * sizeof(Node<S>),
              at_.vertices - at_.nodes - num_nodes * sizeof(Node<S>));
    return tree;
  }

  void vertices(fcl::Vector3<S>* to) {
    const std::size_t size = header_.num_vertices * sizeof(*to);
    auto* const copied = reinterpret_cast<unsigned char*>(to);
    // In integers, as floats would raise flags. All exponent bits are set where it is not finite.
    using Bits = std::conditional_t<sizeof(S) == 8, std::uint64_t, std::uint32_t>;
    constexpr Bits kExponent = sizeof(S) == 8 ? Bits(0x7FF0000000000000) : Bits(0x7F800000);
    bool finite = true;
    for (std::size_t i = 0; i < size; i += kBlock) {
      const std::size_t count = std::min(kBlock, size - i);
      hash_.add(bytes_ + at_.vertices + i, count);
      std::memcpy(copied + i, bytes_ + at_.vertices + i, count);
      Bits coordinates[kBlock / sizeof(S)];
      std::memcpy(coordinates, copied + i, count);
      for (std::size_t k = 0; k < count / sizeof(S); ++k) {
        finite &= (coordinates[k] & kExponent) != kExponent;
      }
    }
    if (!finite) refuseStored("was altered: a vertex is not finite.");
    hash_.add(bytes_ + at_.vertices + size, at_.triangles - at_.vertices - size);
  }

  void triangles(fcl::Triangle* to) {
    constexpr std::size_t kTriangles = kBlock / 12;
    static_assert(sizeof(*to) == 3 * sizeof(std::size_t));
    std::uint32_t largest = 0;
    for (std::size_t t = 0; t < header_.num_triangles; t += kTriangles) {
      const std::size_t count = std::min(kTriangles, header_.num_triangles - t);
      const unsigned char* const from = bytes_ + at_.triangles + 12 * t;
      hash_.add(from, 12 * count);
      std::uint32_t corners[3 * kTriangles];
      std::size_t widened[3 * kTriangles];
      std::memcpy(corners, from, 12 * count);
      for (std::size_t i = 0; i < 3 * count; ++i) {
        largest = std::max(largest, corners[i]);
        widened[i] = corners[i];
      }
      std::memcpy(static_cast<void*>(to + t), widened, count * sizeof(*to));
    }
    if (largest >= header_.num_vertices) {
      refuseStored("was altered: a triangle refers to a vertex that it doesn't have.");
    }
    const std::uint64_t end = at_.triangles + header_.num_triangles * std::uint64_t{12};
    hash_.add(bytes_ + end, at_.prepared - end);
  }

  /// The prepared tree as it is stored, not checked.
  std::unique_ptr<engine::Tree> prepared() {
    auto tree = std::make_unique<engine::Tree>();
    PreparedValues values;
    std::memcpy(&values, bytes_ + at_.prepared, sizeof(values));
    hash_.add(&values, sizeof(values));
    std::copy_n(values.origin, 3, tree->origin);
    tree->cost = values.cost;
    tree->reach = values.reach;
    tree->mean_leaf = values.mean_leaf;
    tree->widest_leaf = values.widest_leaf;
    tree->root_box = values.root_box;
    const std::uint64_t num_nodes = header_.preparedNodes();
    copy(at_.prepared_nodes, num_nodes, at_.boxes, tree->nodes);
    copy(at_.boxes, header_.parts & Header::kBoxes ? num_nodes : 0, at_.children, tree->boxes);
    copy(at_.children, header_.num_blocks, at_.leaves, tree->children);
    copy(at_.leaves, header_.num_leaves, at_.lanes, tree->leaves);
    copy(at_.lanes, header_.num_lanes, at_.features, tree->lanes);
    copy(at_.features, header_.num_features, at_.corners, tree->features);
    copy(at_.corners, header_.parts & Header::kCorners ? header_.num_triangles : 0, at_.size,
         tree->corners);
    return tree;
  }

  /// To be called after all parts were read.
  void requireHash() const {
    if (!hash_.isOf(header_)) refuseStored("was altered: its hash is wrong.");
  }

 private:
  /// Items of an array that lies anywhere, to be copied: a vector that is filled by them isn't
  /// cleared first.
  template <typename T>
  struct Stored {
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = T;

    T operator*() const {
      T item;
      std::memcpy(static_cast<void*>(&item), at, sizeof(item));
      return item;
    }
    Stored& operator++() {
      at += sizeof(T);
      return *this;
    }
    Stored operator++(int) { return {std::exchange(at, at + sizeof(T))}; }
    bool operator==(const Stored& o) const { return at == o.at; }
    bool operator!=(const Stored& o) const { return at != o.at; }

    const unsigned char* at;
  };

  /// An array, with what pads it up to `end`.
  template <typename Array>
  void copy(std::uint64_t begin, std::uint64_t count, std::uint64_t end, Array& to) {
    using T = typename Array::value_type;
    to.reserve(count);
    constexpr std::size_t kItems = kBlock / sizeof(T);
    for (std::uint64_t i = 0; i < count; i += kItems) {
      const std::uint64_t n = std::min<std::uint64_t>(kItems, count - i);
      const unsigned char* const from = bytes_ + begin + i * sizeof(T);
      hash_.add(from, n * sizeof(T));
      to.insert(to.end(), Stored<T>{from}, Stored<T>{from + n * sizeof(T)});
    }
    hash_.add(bytes_ + begin + count * sizeof(T), end - begin - count * sizeof(T));
  }

  void copyNodes(Node<S>* nodes, std::size_t first, std::size_t count) {
    const unsigned char* const from = bytes_ + at_.nodes + first * sizeof(Node<S>);
    hash_.add(from, count * sizeof(Node<S>));
    std::memcpy(static_cast<void*>(nodes + first), from, count * sizeof(Node<S>));
  }

  /// Whether these primitives are those stored, and each triangle is one of them.
  bool hasAll(const unsigned int* primitives) const {
    const std::size_t n = header_.num_triangles;
    if (std::memcmp(primitives, bytes_ + at_.primitives, n * sizeof(*primitives)) != 0) {
      return false;
    }
    std::vector<std::uint64_t> met((n + 63) / 64, 0);
    for (std::size_t i = 0; i < n; ++i) {
      met[primitives[i] / 64] |= std::uint64_t{1} << primitives[i] % 64;
    }
    for (std::size_t i = 0; i < n / 64; ++i) {
      if (~met[i] != 0) return false;
    }
    return n % 64 == 0 || met.back() == (std::uint64_t{1} << n % 64) - 1;
  }

  const unsigned char* const bytes_;
  const Header header_;
  const Layout at_;
  Hash hash_;
};

}  // namespace

template <typename S>
std::shared_ptr<Model<S>> load(const void* bytes, std::size_t size) {
  const auto* const begin = static_cast<const unsigned char*>(bytes);
  const Header header = readHeader<S>(begin, size);
  Reader<S> reader(begin, header);
  const std::shared_ptr<StoredTree<S>> tree = header.num_nodes == 0 ? nullptr : reader.tree();
  auto model = std::make_shared<Model<S>>();
  model->cost_density = header.cost_density;
  model->threshold_occupied = header.threshold_occupied;
  model->threshold_free = header.threshold_free;
  requireBuilt(model->beginModel(static_cast<int>(header.num_triangles),
                                 static_cast<int>(header.num_vertices)));
  reader.vertices(model->vertices);
  reader.triangles(model->tri_indices);
  model->num_vertices = static_cast<int>(header.num_vertices);
  model->num_tris = static_cast<int>(header.num_triangles);
  std::unique_ptr<engine::Tree> prepared;
  if (header.hasPrepared()) {
    prepared = reader.prepared();
    if (!engine::adopt(viewOf(*model), *prepared)) {
      refuseStored("was altered: its prepared tree is none of its mesh.");
    }
  }
  reader.requireHash();
  if (!tree) {
    requireBuilt(model->endModel());
    return model;
  }
  const std::shared_ptr<fcl::detail::BVFitterBase<kIOS<S>>> fitter = model->bv_fitter;
  model->bv_fitter = tree;
  requireBuilt(model->endModel());
  model->bv_fitter = fitter;
  treesOf(*model)->noteBuilt(model->getBV(0).bv.stamp);
  if (prepared) takePrepared(*model, std::move(prepared));
  return model;
}

template std::shared_ptr<Modeld> load<double>(const void* bytes, std::size_t size);
template std::shared_ptr<Modelf> load<float>(const void* bytes, std::size_t size);

}  // namespace kios
