// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Altered files. Those whose hash is wrong are refused; of those whose hash was computed anew, all
// whose structure is wrong are refused, and the others make no query crash. To be run under
// AddressSanitizer, which sees a byte read past the end: the stage asan does.

#include <cfenv>
#include <cmath>

#include "model/altered_files.h"

namespace kios::testing {
namespace {

using Bytes = std::vector<unsigned char>;
using stored::Header;
using stored::Layout;
using Node = stored::Node<double>;

class AlteredStorage : public AlteredFiles {
 protected:
  AlteredStorage() : AlteredFiles(scenes::icosphere(0.5, 1)) {}  // 80 triangles
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
    EXPECT_EQ(0, alterAndLoad(500, false, [&](File& file) {
                file.bytes.resize(oneIn(4) ? any(sizeof(Header) + 200) : any(file.bytes.size()));
                if (file.bytes.size() < sizeof(Header)) return true;
                if (repair) file.put<std::uint64_t>(offsetof(Header, size), file.bytes.size());
                if (repair) file.repairHash();
                return true;
              }));
    EXPECT_EQ(0, alterAndLoad(500, false, [&](File& file) {
                file.bytes.resize(file.bytes.size() + 1 + any(oneIn(2) ? 16 : 5000), 0);
                if (repair) file.put<std::uint64_t>(offsetof(Header, size), file.bytes.size());
                if (repair) file.repairHash();
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
                           const std::uint64_t place = file.node(oneIn(3) ? 0 : any(n));
                           auto node = file.get<Node>(place);
                           switch (any(5)) {
                             case 0:
                               node.bv.center0[static_cast<int>(any(3))] = oddNumber();
                               break;
                             case 1:
                               node.bv.radius0 = oddNumber();
                               break;
                             case 2:
                               (oneIn(2) ? node.bv.cap_x : node.bv.cap_r)[any(4)] =
                                   float(oddNumber());
                               break;
                             case 3:
                               node.bv.exponent = static_cast<std::int16_t>(random_());
                               break;
                             default:
                               node.bv.reach = float(oddNumber());
                           }
                           file.put(place, node);
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
