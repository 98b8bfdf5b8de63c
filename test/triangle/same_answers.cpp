// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Prints a hash of all answers of the triangle kernels over all classes. same_answers.sh builds
// this with several compilers and flags: the hashes must be equal.

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "fcl_kios/triangle.h"
#include "scenes/triangle_classes.h"

namespace {

class Hash {
 public:
  void add(double v) {
    std::uint64_t bits;
    std::memcpy(&bits, &v, sizeof(bits));
    value_ = (value_ ^ bits) * 0x100000001b3U;  // FNV-1a, by words
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

int main() {
  Hash hash;
  const std::size_t classes = kios::scenes::triangleClasses().size();
  for (std::size_t i = 0; i < classes; ++i) {
    for (const auto& pair : kios::scenes::trianglePairs(i, 300, 7)) {
      const auto nearest = kios::triangleDistance<double>(pair.a, pair.b);
      hash.add(nearest.distance);
      for (int c = 0; c < 3; ++c) {
        hash.add(nearest.point_a[c]);
        hash.add(nearest.point_b[c]);
      }
      hash.add(kios::trianglesIntersect<double>(pair.a, pair.b));
    }
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
}
