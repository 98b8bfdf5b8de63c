// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Altered files. Those whose hash is wrong are refused; of those whose hash was computed anew, all
// whose structure is wrong are refused, and the others make no query crash. To be run under
// AddressSanitizer, which sees a byte read past the end: the stage asan does.

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl/mesh_cases.h"
#include "model/deform.h"
#include "model/stored_file.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

using stored::Header;
using Node = stored::Node<double>;

/// Alters stored models, and asks those that are taken. Random, but the same each time.
class AlteredStorage : public ::testing::Test {
 protected:
  using File = StoredFile<>;

  /// Alters a file so often, each time from the one that was saved. False from `alter` if it
  /// changed nothing. Asks the models of those that are taken. Returns how many were.
  int alterAndLoad(int times, bool repair, const std::function<bool(File&)>& alter) {
    int taken = 0;
    for (int i = 0; i < times; ++i) {
      File file = saved_;
      if (!alter(file)) continue;
      if (repair) file.repairHash();
      const StoredFile<>::Bytes exact(file.bytes.begin(),
                                      file.bytes.end());  // no room after the last byte
      try {
        ask(*load(exact.data(), exact.size()));
        ++taken;
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("stored model"), std::string::npos);
      }
    }
    return taken;
  }

  void ask(Modeld& model) {
    askOnce(model);
    // A refit moves the tree, whatever it holds.
    replace(model, moved_, true, false);
    askOnce(model);
  }

  void askOnce(const Modeld& model) const {
    for (const Frame& frame : frames_) {
      distanceBracket(model, frame.X_WA, *partner_, frame.X_WB);
      DistanceBracketRequestd options;
      options.rel_err = 0.1;
      options.max_expansions = 20;
      distanceBracket(*plate_, frame.X_WA, model, frame.X_WB, options);
      closerThan(model, frame.X_WA, model, frame.X_WB, 0.1);
      fcl::CollisionResultd contacts;
      fcl::collide(&model, frame.X_WA, partner_.get(), frame.X_WB, fcl::CollisionRequestd(9),
                   contacts);
      fcl::collide(&model, frame.X_WA, plate_.get(), frame.X_WB, fcl::CollisionRequestd(1),
                   contacts);
      for (const fcl::CollisionGeometryd* shape : shapes_) {
        fcl::DistanceResultd result;
        fcl::distance(&model, frame.X_WA, shape, frame.X_WB, fcl::DistanceRequestd(), result);
        fcl::CollisionResultd touching;
        fcl::collide(&model, frame.X_WA, shape, frame.X_WB, fcl::CollisionRequestd(9), touching);
      }
      allHits(model, frame.X_WA, Rayd{frame.X_WB.translation(), Vector3d(1, 2, 3)}, 9);
    }
    save(model);
  }

  std::uint64_t any(std::uint64_t end) { return random_() % end; }
  bool oneIn(std::uint64_t n) { return any(n) == 0; }

  /// A count or an index such as programs stumble over.
  std::uint32_t oddInteger(std::uint32_t value) {
    const std::uint32_t odd[] = {
        0,         1,          value + 1,  value - 1,  ~value,
        value * 2, 0x7fffffff, 0x80000000, 0xffffffff, static_cast<std::uint32_t>(random_())};
    return odd[any(std::size(odd))];
  }
  double oddNumber() {
    const double odd[] = {0,
                          -1,
                          1e-310,
                          1e300,
                          -1e300,
                          std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()};
    return odd[any(std::size(odd))];
  }

  std::mt19937_64 random_{7};
  const std::shared_ptr<Modeld> partner_ = kiosModel(scenes::bumpyTorus(300));
  const std::shared_ptr<Modeld> plate_ =
      kiosModel(scenes::boredBlock({0.4, 0.25, 0.03}, 0.03, 0.004, 0.05, 32));
  const fcl::Sphered sphere_{0.3};
  const fcl::Cylinderd cylinder_{0.2, 0.9};
  const fcl::Halfspaced halfspace_{Vector3d(0, 0, 1), 0};
  const fcl::CollisionGeometryd* const shapes_[3] = {&sphere_, &cylinder_, &halfspace_};
  const std::vector<Frame> frames_ = randomFrames(2, 1.0, 17);
  const Mesh mesh_ = scenes::icosphere(0.5, 1);  // 80 triangles
  const File saved_{save(*kiosModel(mesh_))};
  const std::vector<Vector3d> moved_ = swayed(mesh_, 1);
};

TEST_F(AlteredStorage, WithAWrongHashIsRefused) {
  // Each bit of the header, then any byte.
  std::size_t bit = 0;
  EXPECT_EQ(0, alterAndLoad(8 * sizeof(Header), false, [&](File& file) {
              file.bytes[bit / 8] =
                  static_cast<unsigned char>(file.bytes[bit / 8] ^ (1U << (bit % 8)));
              ++bit;
              return true;
            }));
  EXPECT_EQ(0, alterAndLoad(2200, false, [&](File& file) {
              for (std::uint64_t k = 1 + any(4); k > 0; --k) {
                unsigned char& byte = file.bytes[any(file.bytes.size())];
                byte = static_cast<unsigned char>(byte ^ (1 + any(255)));
              }
              return file.bytes != saved_.bytes;
            }));
}

TEST_F(AlteredStorage, CutOffOrLongerIsRefused) {
  for (const bool repair : {false, true}) {
    EXPECT_EQ(0, alterAndLoad(1000, false, [&](File& file) {
                const std::size_t size = file.bytes.size();
                const bool longer = oneIn(2), head = oneIn(4);
                file.bytes.resize(longer ? size + 1 + any(oneIn(2) ? 16 : 5000)
                                         : any(head ? sizeof(Header) + 200 : size));
                if (!repair || file.bytes.size() < sizeof(Header)) return true;
                file.put<std::uint64_t>(offsetof(Header, size), file.bytes.size());
                file.repairHash();
                return true;
              }));
  }
}

TEST_F(AlteredStorage, WithOtherCountsIsRefused) {
  const std::size_t places[] = {offsetof(Header, version),      offsetof(Header, scalar),
                                offsetof(Header, size),         offsetof(Header, num_triangles),
                                offsetof(Header, num_vertices), offsetof(Header, num_nodes),
                                offsetof(Header, older0),       offsetof(Header, older)};
  EXPECT_EQ(0, alterAndLoad(1500, true, [&](File& file) {
              for (std::uint64_t k = 1 + any(2); k > 0; --k) {
                const std::size_t place = places[any(std::size(places))];
                file.put(place, oddInteger(file.get<std::uint32_t>(place)));
              }
              return std::memcmp(file.bytes.data(), saved_.bytes.data(), sizeof(Header)) != 0;
            }));
}

TEST_F(AlteredStorage, WhoseTreeIsNoneIsRefused) {
  const std::uint64_t n = saved_.header.num_nodes;
  EXPECT_EQ(0, alterAndLoad(2000, true, [&](File& file) {
              const std::uint64_t place = file.node(any(n)), other = file.node(any(n));
              auto node = file.get<Node>(place);
              switch (any(6)) {
                case 0:
                  node.first_child =
                      static_cast<int>(oddInteger(static_cast<unsigned>(node.first_child)));
                  break;
                case 1:
                  node.first_primitive =
                      static_cast<int>(oddInteger(static_cast<unsigned>(node.first_primitive)));
                  break;
                case 2:
                  node.num_primitives =
                      static_cast<int>(oddInteger(static_cast<unsigned>(node.num_primitives)));
                  break;
                case 3:
                  node.bv.num_spheres = static_cast<std::uint8_t>(2 * any(128));
                  break;
                case 4:
                  node = file.get<Node>(other);
                  file.put(other, file.get<Node>(place));
                  break;
                default:  // a leaf twice, in both of its places
                  if (node.num_primitives != 1) return false;
                  node.first_child = file.get<Node>(other).first_child;
                  if (node.first_child >= 0) return false;
                  file.put(
                      file.at.primitives + 4 * static_cast<std::uint64_t>(node.first_primitive),
                      ~node.first_child);
              }
              file.put(place, node);
              return file.bytes != saved_.bytes;
            }));
  EXPECT_EQ(0, alterAndLoad(200, true, [&](File& file) {
              const std::uint64_t place = file.at.primitives + 4 * any(file.header.num_triangles);
              file.put(place, oddInteger(file.get<std::uint32_t>(place)));
              return file.bytes != saved_.bytes;
            }));
}

TEST_F(AlteredStorage, WithOtherGeometryAnswersOrIsRefused) {
  const std::uint64_t n = 3 * saved_.header.num_vertices;
  EXPECT_GT(alterAndLoad(700, true,
                         [&](File& file) {
                           const double value = oddNumber();
                           file.put(file.at.vertices + 8 * any(n), value);
                           return std::isfinite(value);
                         }),
            200);
  EXPECT_EQ(0, alterAndLoad(100, true, [&](File& file) {
              file.put(file.at.vertices + 8 * any(n), any(2) ? NAN : -HUGE_VAL);
              return true;
            }));
  // Integers tell a signalling NaN, so that programs that trap floating-point errors don't.
  const std::uint64_t kBits[] = {0x7FF0000000000001, 0xFFF4000000000000, 0x7FF8000000000000,
                                 0x7FF0000000000000, 0xFFF0000000000000};
  std::feclearexcept(FE_ALL_EXCEPT);
  for (const std::uint64_t bits : kBits) {
    File file = saved_;
    file.put(file.at.vertices + 8 * any(n), bits);
    file.repairHash();
    EXPECT_THROW(load(file.bytes.data(), file.bytes.size()), std::invalid_argument);
    EXPECT_EQ(std::fetestexcept(FE_INVALID | FE_OVERFLOW), 0) << bits;
  }
  EXPECT_GT(alterAndLoad(500, true,
                         [&](File& file) {
                           const std::uint64_t place =
                               file.at.triangles + 4 * any(3 * file.header.num_triangles);
                           file.put(place,
                                    static_cast<std::uint32_t>(any(file.header.num_vertices)));
                           return true;
                         }),
            400);
  EXPECT_EQ(0, alterAndLoad(300, true, [&](File& file) {
              const std::uint64_t place =
                  file.at.triangles + 4 * any(3 * file.header.num_triangles);
              const std::uint32_t odd = oddInteger(file.get<std::uint32_t>(place));
              file.put(place, odd);
              return odd >= file.header.num_vertices;
            }));
}

TEST_F(AlteredStorage, WithOtherVolumesMakesNoQueryCrash) {
  const std::uint64_t n = saved_.header.num_nodes;
  EXPECT_GT(alterAndLoad(1000, true,
                         [&](File& file) {
                           const std::uint64_t node = file.node(oneIn(3) ? 0 : any(n));
                           if (oneIn(2)) {
                             file.put(node + 8 * any(sizeof(Node) / 8), oddNumber());
                           } else {
                             file.put(node + 4 * any(sizeof(Node) / 4), float(oddNumber()));
                           }
                           return true;
                         }),
            500);
  EXPECT_GT(alterAndLoad(1500, true,
                         [&](File& file) {
                           for (std::uint64_t k = 1 + any(3); k > 0; --k) {
                             const std::uint64_t place =
                                 oneIn(2) ? any(file.bytes.size()) : any(file.node(n));
                             file.bytes[place] =
                                 static_cast<unsigned char>(oneIn(4) ? 255 : random_());
                           }
                           return true;
                         }),
            300);
}

}  // namespace
}  // namespace kios::testing
