// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// FCL's own queries know no kIOS: they warn, and find no contact and no distance. A model that they
// ask for its type tells that a file called them, and not our overloads.
#include <cstdint>
#include <cstring>

#include "fcl_kios/model.h"
#include "volume/errors.h"

#if defined(__linux__)
#include <dlfcn.h>
#include <link.h>
#endif

namespace kios {
namespace {

#if defined(__linux__)

/// Where a shared libfcl lies in memory; empty if there is none.
struct Range {
  std::uintptr_t begin = 0, end = 0;
  bool holds(const void* address) const {
    return reinterpret_cast<std::uintptr_t>(address) - begin < end - begin;
  }
};

/// Adds the part of an object that holds its code, if the object is libfcl (libfcl.so.0.7, or
/// libfcl-<hash>.so.0.7 as wheels rename it).
int addCode(dl_phdr_info* info, std::size_t, void* range) {
  const char* const slash = std::strrchr(info->dlpi_name, '/');
  const char* const name = slash ? slash + 1 : info->dlpi_name;
  if (std::strncmp(name, "libfcl.so", 9) != 0 && std::strncmp(name, "libfcl-", 7) != 0) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
    *static_cast<Range*>(range) = {begin, begin + part.p_memsz};
    return 1;
  }
  return 0;
}

/// Whether a place in libfcl is in the getObjectType() of a collision object, by which anybody may
/// ask.
bool isForwarded(const void* place) {
  Dl_info info;
  return dladdr(place, &info) != 0 && info.dli_sname &&
         std::strstr(info.dli_sname, "getObjectType") != nullptr;
}

bool isQueryOfFcl(const void* caller) {
  static const Range libfcl = [] {
    Range range;
    dl_iterate_phdr(&addCode, &range);
    return range;
  }();
  return libfcl.holds(caller) && !isForwarded(caller);
}

#define KIOS_CALLER __builtin_return_address(0)

#else

bool isQueryOfFcl(const void*) { return false; }
#define KIOS_CALLER nullptr

#endif

[[noreturn]] void refuseQueryOfFcl() {
  refuse(
      "FCL's own fcl::collide, fcl::distance or fcl::continuousCollide was asked about a "
      "mesh over kios::kIOS, which it doesn't know. The file that asked was compiled without "
      "fcl_kios/overloads.h: link the CMake target fcl_kios::force_include to it, or compile it "
      "with "
      "-include fcl_kios/overloads.h. Or it names template arguments: write fcl::collide(...), not "
      "fcl::collide<double>(...).");
}

}  // namespace
}  // namespace kios

namespace fcl {

template <>
OBJECT_TYPE BVHModel<kios::kIOS<double>>::getObjectType() const {
  if (kios::isQueryOfFcl(KIOS_CALLER)) kios::refuseQueryOfFcl();
  return OT_BVH;
}
template <>
OBJECT_TYPE BVHModel<kios::kIOS<float>>::getObjectType() const {
  if (kios::isQueryOfFcl(KIOS_CALLER)) kios::refuseQueryOfFcl();
  return OT_BVH;
}

}  // namespace fcl
