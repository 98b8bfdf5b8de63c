// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace kios::preload {

/// What calls lead to, by their places in the code, which return addresses give. Needed where no
/// FCL is in the global scope: plug-ins may each have one of their own. A place may call several
/// functions, as a return address is that of a chain of tail calls. Any thread may call anything
/// here, and a fork finds nothing locked. The files of places stay loaded, as findDefinition()
/// opens them.
class Sites {
 public:
  /// Returns nullptr if nothing was kept.
  const void* find(const void* caller, const char* name) const {
    for (std::size_t i = 0; i < kTried; ++i) {
      const Site* const site = sites_[placeOf(caller, name, i)].load(std::memory_order_acquire);
      if (!site) break;
      if (site->caller == caller && site->name == name) return site->target;
    }
    return nullptr;
  }

  /// Where no place is left the target has to be found at each call.
  void keep(const void* caller, const char* name, const void* target) {
    auto* const site = static_cast<Site*>(std::malloc(sizeof(Site)));
    if (!site) std::abort();
    *site = {caller, name, target};
    for (std::size_t i = 0; i < kTried; ++i) {
      Site* empty = nullptr;
      if (sites_[placeOf(caller, name, i)].compare_exchange_strong(empty, site,
                                                                   std::memory_order_release)) {
        return;
      }
    }
    std::free(site);
  }

 private:
  struct Site {
    const void* caller;
    const char* name;
    const void* target;
  };
  static constexpr std::size_t kPlaces = 1 << 10, kTried = 8;

  static std::size_t placeOf(const void* caller, const char* name, std::size_t i) {
    const auto key =
        reinterpret_cast<std::uintptr_t>(caller) ^ reinterpret_cast<std::uintptr_t>(name) << 20;
    return ((key * 0x9E3779B97F4A7C15U >> 40) + i) % kPlaces;
  }

  std::atomic<Site*> sites_[kPlaces] = {};
};

}  // namespace kios::preload
