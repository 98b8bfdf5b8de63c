// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "triangle/contract.h"

// libFuzzer target: two triangles from bytes, checked against the exact oracle. A broken promise
// aborts with the pair in hex floats. Run by fuzz/run.sh.

namespace kios::testing {
namespace {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  /// 0 at the end.
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }

  /// Returns a double of any bits.
  double raw() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double v = 0;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// Returns coordinates at most 1e300, the range of the contract.
double inRange(double v) {
  if (!std::isfinite(v)) return 0;
  return std::abs(v) <= 1e300 ? v : std::ldexp(v, -40);
}

/// Triangles from bytes. A coordinate is any double, a small integer times a power of two, or one
/// that was there before, exactly or an ulp off: repetition is what makes triangles touch. Three
/// quarters of the inputs keep to moderate exponents, where most code is and answers are fast.
class Decoder {
 public:
  explicit Decoder(Bytes bytes) : bytes_(bytes), moderate_(bytes_.byte() % 4 != 0) {
    for (count_ = 0; count_ < 18; ++count_) v_[count_] = coordinate();
  }

  TrianglePair pair() const {
    TrianglePair pair;
    for (int i = 0; i < 3; ++i) {
      pair.a[i] = {v_[3 * i], v_[3 * i + 1], v_[3 * i + 2]};
      pair.b[i] = {v_[9 + 3 * i], v_[10 + 3 * i], v_[11 + 3 * i]};
    }
    return pair;
  }

 private:
  double coordinate() {
    const std::uint8_t code = bytes_.byte();
    switch (code % 8) {
      case 0:
        return anyDouble();
      case 1: {
        const int e = moderate_ ? bytes_.byte() % 64 - 32 : 8 * (bytes_.byte() - 128);
        return inRange(std::ldexp(small(), e));
      }
      case 2:
      case 3:
        return earlier(code / 8);
      case 4:
        return inRange(std::nextafter(earlier(code / 8), code < 128 ? -1e300 : 1e300));
      case 5:
        return earlier(code / 8) / 2 + earlier(bytes_.byte()) / 2;
      case 6:
        return count_ > 0 ? -v_[code / 8 % count_] : 1;
      default:
        return small();
    }
  }

  double anyDouble() {
    const double v = inRange(bytes_.raw());
    if (!moderate_) return v;
    int e = 0;
    return std::ldexp(std::frexp(v, &e), e % 32);
  }

  double small() { return static_cast<std::int8_t>(bytes_.byte()); }

  /// Returns that coordinate of an earlier vertex.
  double earlier(int choice) const {
    return count_ < 3 ? 0 : v_[count_ % 3 + 3 * (choice % (count_ / 3))];
  }

  Bytes bytes_;
  bool moderate_;
  double v_[18];
  int count_;
};

template <typename S>
void check(const RoundedPair<S>& pair, int order) {
  const ContractResult result = contractOf(pair);
  const char* broken = result.broken.empty() ? nullptr : result.broken.c_str();
  if (broken == nullptr &&
      !sameForOrder(pair, kVertexOrders[order / 6], kVertexOrders[order % 6])) {
    broken = "the order of arguments matters";
  }
  if (broken == nullptr) return;
  std::fprintf(stderr, "%s: %s\n%s\n", sizeof(S) == 4 ? "float" : "double", broken,
               text(pair.exact).c_str());
  std::abort();
}

}  // namespace
}  // namespace kios::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kios::testing;
  const int order = size > 0 ? data[size - 1] % 36 : 0;
  const TrianglePair pair = Decoder(Bytes(data, size)).pair();
  check(RoundedPair<double>(pair), order);
  const RoundedPair<float> rounded(pair);
  if (rounded.finite && magnitude(rounded.exact) <= 1e38) check(rounded, order);
  return 0;
}
