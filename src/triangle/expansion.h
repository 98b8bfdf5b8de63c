// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

// Exact arithmetic with floating-point expansions (Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates", 1997): a number is a sum of doubles that do
// not overlap, by increasing magnitude. Exact as long as no product under- or overflows.

namespace kios {

template <int N>
struct Expansion {
  double terms[N];
  int size = 0;

  void append(double v) {
    if (v != 0) terms[size++] = v;
  }
};

/// a + b = sum + error, exactly.
inline void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bb = sum - a;
  error = (a - (sum - bb)) + (b - bb);
}

/// a b = product + error, exactly (Dekker).
inline void twoProduct(double a, double b, double& product, double& error) {
  constexpr double kSplit = 0x1p27 + 1;
  const double ca = kSplit * a, cb = kSplit * b;
  const double a1 = ca - (ca - a), a0 = a - a1, b1 = cb - (cb - b), b0 = b - b1;
  product = a * b;
  error = a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0);
}

/// high + low, not normalised: |low| is a few u (2^-53) times the numbers it was made from. Twice
/// the digits of a double for a few times the cost.
struct Twofold {
  double high, low;
};

/// a - b, exactly.
inline Twofold twofoldDifference(double a, double b) {
  Twofold d;
  twoSum(a, -b, d.high, d.low);
  return d;
}

inline Twofold operator+(const Twofold& a, const Twofold& b) {
  Twofold s;
  twoSum(a.high, b.high, s.high, s.low);
  s.low += a.low + b.low;
  return s;
}

inline Twofold operator-(const Twofold& a, const Twofold& b) {
  return a + Twofold{-b.high, -b.low};
}

inline Twofold operator*(const Twofold& a, const Twofold& b) {
  Twofold p;
  twoProduct(a.high, b.high, p.high, p.low);
  p.low += a.high * b.low + a.low * b.high;
  return p;
}

/// a d - b c with nearly all its digits, however much cancels.
inline double accurateMinor(const Twofold& a, const Twofold& b, const Twofold& c,
                            const Twofold& d) {
  const Twofold minor = a * d - b * c;
  return minor.high + minor.low;
}

inline Expansion<2> difference(double a, double b) {
  double high, low;
  twoSum(a, -b, high, low);
  Expansion<2> e;
  e.append(low);
  e.append(high);
  return e;
}

template <int N>
Expansion<N> negated(Expansion<N> e) {
  for (int i = 0; i < e.size; ++i) e.terms[i] = -e.terms[i];
  return e;
}

/// Merge by magnitude, then one pass of sums: fast-expansion-sum with zeros dropped. Exact for
/// strongly nonoverlapping expansions and round-to-even; all of this file's results are such.
template <int N, int M>
Expansion<N + M> sum(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> h;
  int i = 0, j = 0;
  const auto next = [&] {
    const bool from_e = j == f.size || (i < e.size && std::abs(e.terms[i]) < std::abs(f.terms[j]));
    return from_e ? e.terms[i++] : f.terms[j++];
  };
  if (e.size + f.size == 0) return h;
  double q = next();
  while (i < e.size || j < f.size) {
    double high, low;
    twoSum(q, next(), high, low);
    h.append(low);
    q = high;
  }
  h.append(q);
  return h;
}

template <int N>
Expansion<2 * N> scaled(const Expansion<N>& e, double b) {
  Expansion<2 * N> h;
  if (e.size == 0 || b == 0) return h;
  double q, low;
  twoProduct(e.terms[0], b, q, low);
  h.append(low);
  for (int i = 1; i < e.size; ++i) {
    double product, error, middle;
    twoProduct(e.terms[i], b, product, error);
    twoSum(q, error, middle, low);
    h.append(low);
    twoSum(product, middle, q, low);
    h.append(low);
  }
  h.append(q);
  return h;
}

inline Expansion<2> product(double a, double b) {
  double high, low;
  twoProduct(a, b, high, low);
  Expansion<2> e;
  e.append(low);
  e.append(high);
  return e;
}

/// e times a number of at most two terms.
template <int N>
Expansion<4 * N> product(const Expansion<N>& e, const Expansion<2>& f) {
  Expansion<4 * N> h;
  if (f.size == 0) return h;
  const Expansion<2 * N> first = scaled(e, f.terms[0]);
  return sum(first, f.size == 2 ? scaled(e, f.terms[1]) : Expansion<2 * N>());
}

}  // namespace kios
