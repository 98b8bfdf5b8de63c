// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace {

std::atomic<bool> counting{false};
std::atomic<long long> held_bytes{0}, peak_bytes{0};

#ifdef __GLIBC__
long long sizeOf(void* block) { return static_cast<long long>(malloc_usable_size(block)); }
#else
long long sizeOf(void* /*block*/) { return 0; }
#endif

void* entered(void* block) {
  if (!block) throw std::bad_alloc();
  if (!counting.load(std::memory_order_relaxed)) return block;
  const long long held = held_bytes += sizeOf(block);
  long long peak = peak_bytes;
  while (held > peak && !peak_bytes.compare_exchange_weak(peak, held)) {
  }
  return block;
}

void release(void* block) {
  if (block && counting.load(std::memory_order_relaxed)) held_bytes -= sizeOf(block);
  std::free(block);
}

void* aligned(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return std::aligned_alloc(unit, (size + unit - 1) / unit * unit);
}

}  // namespace

void* operator new(std::size_t n) { return entered(std::malloc(n > 0 ? n : 1)); }
void* operator new(std::size_t n, std::align_val_t a) { return entered(aligned(n, a)); }
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace kios::bench {

Allocations::Allocations() {
  held_bytes = peak_bytes = 0;
  counting = true;
}

Allocations::~Allocations() { counting = false; }

long long Allocations::held() const { return held_bytes; }
long long Allocations::peak() const { return peak_bytes; }
void Allocations::resetPeak() { peak_bytes = held_bytes.load(); }

}  // namespace kios::bench
