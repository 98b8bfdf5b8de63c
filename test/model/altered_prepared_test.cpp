// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Altered files as in altered_storage_test.cpp, in what they hold of the prepared tree.

#include <cstddef>
#include <type_traits>

#include "model/altered_files.h"

namespace kios::testing {
namespace {

using stored::Header;
using stored::Layout;

/// A mesh whose tree has every part: boxes, as flat parts have, and welded corners, as soups have.
class AlteredPrepared : public AlteredFiles {
 protected:
  AlteredPrepared()
      : AlteredFiles(scenes::soup(scenes::boredBlock({1.2, 0.8, 0.03}, 0.1, 0.01, 0.2, 24))) {}

  void SetUp() override {
    ASSERT_GT(header_.num_leaves, 8U);
    ASSERT_GT(header_.num_blocks, 1U);
    ASSERT_EQ(header_.parts, Header::kBoxes | Header::kCorners);
  }

  /// Alters an item of an array in some way that shows.
  template <typename T, typename Alter>
  bool alter(File& file, std::uint64_t begin, std::uint64_t count, const Alter& alter) {
    const std::uint64_t place = begin + any(count) * sizeof(T);
    auto item = file.get<T>(place);
    alter(item);
    file.put(place, item);
    return file.bytes != saved_.bytes;
  }

  float oddFloat() {
    const float odd[] = {0,      -0.0F,   -1,      1e-40F, 3e38F,
                         -3e38F, 0x1p63F, 0x1p40F, 1e-7F,  static_cast<float>(any(1000))};
    return odd[any(std::size(odd))];
  }
  float notFinite() {
    const float odd[] = {std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN()};
    return odd[any(std::size(odd))];
  }
  /// The place of a float of the tree.
  std::uint64_t anyFloat() {
    const Layout& at = saved_.at;
    switch (any(5)) {
      case 0:
        return at.prepared_nodes + any(num_nodes_) * sizeof(engine::Node) + 4 * any(20);
      case 1:
        return at.leaves + any(header_.num_leaves) * sizeof(engine::Leaf) + 12 + 4 * any(8);
      case 2:
        return at.lanes + 4 * any(8 * header_.num_lanes);
      case 3:
        return at.boxes + 4 * any(16 * num_nodes_);
      default:
        return at.prepared + offsetof(stored::PreparedValues, reach) + 4 * any(3);
    }
  }

  const Header& header_ = saved_.header;
  const std::uint64_t num_nodes_ = header_.preparedNodes();
};

TEST_F(AlteredPrepared, WhoseTreeIsNoneIsRefused) {
  using engine::Children, engine::Corners3, engine::FeatureId, engine::Leaf;
  const Layout& at = saved_.at;
  const std::uint32_t n = header_.num_triangles;
  const auto another = [&](auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(
        oddInteger(static_cast<std::uint32_t>(value)));
  };
  const std::function<bool(File&)> alterations[] = {
      [&](File& file) {
        return alter<engine::Node>(file, at.prepared_nodes, num_nodes_, [&](engine::Node& node) {
          switch (any(4)) {
            case 0:
              another(node.child);
              break;
            case 1:
              if (!node.isLeaf()) node.first_child = oddInteger(node.first_child) & 0x7FFFFFFF;
              break;
            case 2:
              if (node.child != 0) node.flat = 1 - node.flat;  // the root's has no other witness
              break;
            default:
              node.size = -node.size;
          }
        });
      },
      [&](File& file) {
        return alter<Children>(file, at.children, header_.num_blocks, [&](Children& children) {
          std::uint8_t* const members[] = {&children.count, &children.flat, &children.leaves};
          another(*members[any(3)]);
        });
      },
      [&](File& file) {
        return alter<Leaf>(file, at.leaves, header_.num_leaves, [&](Leaf& leaf) {
          if (oneIn(2)) return another(oneIn(2) ? leaf.offset : leaf.feature_offset);
          std::uint8_t* const members[] = {&leaf.num_faces, &leaf.num_edges, &leaf.num_owned,
                                           &leaf.num_vertices};
          std::uint8_t& member = *members[any(4)];
          // Fewer vertices by the last may be another leaf that fits.
          do another(member);
          while (&member == &leaf.num_vertices && member < 24);
        });
      },
      [&](File& file) {
        return alter<Leaf>(file, at.leaves, header_.num_leaves, [&](Leaf& leaf) {
          const auto beyond =
              static_cast<std::uint8_t>(leaf.num_vertices + any(256 - leaf.num_vertices));
          if (oneIn(2)) {
            leaf.corners[any(std::size(leaf.corners))] = beyond;
          } else {
            leaf.ends[any(std::size(leaf.ends))] =
                static_cast<std::uint16_t>(oneIn(2) ? beyond : beyond << 8);
          }
        });
      },
      [&](File& file) {
        return alter<FeatureId>(file, at.features, header_.num_features, [&](FeatureId& id) {
          id.packed = oneIn(2) ? id.packed | 3U : std::max(oddInteger(id.packed), n << 2);
        });
      },
      [&](File& file) {  // a face twice
        const auto leaf = file.get<Leaf>(at.leaves + any(header_.num_leaves) * sizeof(Leaf));
        file.put(at.features + 4 * (leaf.feature_offset + any(leaf.num_faces)),
                 FeatureId{static_cast<std::uint32_t>(any(n)) << 2});
        return file.bytes != saved_.bytes;
      },
      [&](File& file) {
        return alter<Corners3>(file, at.corners, n, [&](Corners3& corners) {
          corners[any(3)] = std::max(oddInteger(n), header_.num_vertices);
        });
      },
      [&](File& file) {  // two items of an array swapped
        const std::uint64_t one = at.prepared_nodes + any(num_nodes_) * sizeof(engine::Node),
                            two = at.prepared_nodes + any(num_nodes_) * sizeof(engine::Node);
        const auto a = file.get<engine::Node>(one), b = file.get<engine::Node>(two);
        file.put(one, b);
        file.put(two, a);
        return a.child != b.child;
      }};
  for (const auto& alteration : alterations) {
    SCOPED_TRACE(&alteration - alterations);
    EXPECT_EQ(0, alterAndLoad(400, true, alteration));
  }
}

TEST_F(AlteredPrepared, OfFloatsThatAreNotFiniteIsRefused) {
  EXPECT_EQ(0, alterAndLoad(1000, true, [&](File& file) {
              file.put(anyFloat(), notFinite());
              return true;
            }));
  const std::uint64_t origin = saved_.at.prepared;  // and the cost
  EXPECT_EQ(0, alterAndLoad(50, true, [&](File& file) {
              file.put(origin + 8 * any(4), static_cast<double>(notFinite()));
              return true;
            }));
}

TEST_F(AlteredPrepared, OfOtherFloatsMakesNoQueryCrash) {
  EXPECT_GT(alterAndLoad(2000, true,
                         [&](File& file) {
                           for (std::uint64_t k = 1 + any(oneIn(3) ? 200 : 5); k > 0; --k) {
                             file.put(anyFloat(), oddFloat());
                           }
                           return true;
                         }),
            1900);
  EXPECT_GT(alterAndLoad(1500, true,
                         [&](File& file) {
                           const std::uint64_t size = saved_.at.size - saved_.at.prepared;
                           for (std::uint64_t k = 1 + any(3); k > 0; --k) {
                             file.bytes[saved_.at.prepared + any(size)] =
                                 static_cast<unsigned char>(oneIn(4) ? 255 : random_());
                           }
                           return true;
                         }),
            300);
}

}  // namespace
}  // namespace kios::testing
