// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/memory_to_fill.h"

#include <cstdint>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace kios {

void* memoryToFill(std::size_t bytes) {
  void* const memory = ::operator new[](bytes);
#if defined(MADV_HUGEPAGE)
  // A fault costs as much as copying its 4 KiB. Only whole pages of 2 MiB, which the array fills
  // anyway, are asked for; a system that has none to give ignores it.
  constexpr std::uintptr_t kHugePage = 1U << 21;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kHugePage - 1) & ~(kHugePage - 1);
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(kHugePage - 1);
  if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
  return memory;
}

}  // namespace kios
