// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/reach.h"

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include "preload/names.h"

namespace kios::preload {
namespace {

constexpr const char* kLibfcl = "libfcl.so.0.7";

/// Returns the place of the object that an address lies in; nullptr if it is in none.
const void* baseOf(const void* address) {
  Dl_info info;
  return address && dladdr(address, &info) ? info.dli_fbase : nullptr;
}

/// Returns the name of that object's file.
const char* fileOf(const void* address) {
  Dl_info info;
  return address && dladdr(address, &info) && info.dli_fname ? info.dli_fname : "?";
}

const void* here() { return reinterpret_cast<const void*>(&fileOf); }

/// What the library that an address lies in is called in its own words; "" if nothing.
const char* sonameOf(const void* address) {
  Dl_info info;
  void* map = nullptr;
  if (!dladdr1(address, &info, &map, RTLD_DL_LINKMAP) || !map) return "";
  const char* strings = nullptr;
  std::size_t soname = 0;
  for (const ElfW(Dyn)* entry = static_cast<const link_map*>(map)->l_ld;
       entry && entry->d_tag != DT_NULL; ++entry) {
    if (entry->d_tag == DT_STRTAB) strings = reinterpret_cast<const char*>(entry->d_un.d_ptr);
    if (entry->d_tag == DT_SONAME) soname = entry->d_un.d_val;
  }
  return strings && soname != 0 ? strings + soname : "";
}

/// Whether a file or library is called as tools that bundle libraries call a copy of libfcl.so.0.7:
/// libfcl-<hash>.so.0.7, or with more after a point.
bool isNameOfCopy(const char* path) {
  constexpr const char* kBefore = "libfcl-";
  constexpr const char* kAfter = ".so.0.7";
  const char* const slash = std::strrchr(path, '/');
  const char* name = slash ? slash + 1 : path;
  if (std::strncmp(name, kBefore, std::strlen(kBefore)) != 0) return false;
  name += std::strlen(kBefore);
  const std::size_t hash = std::strspn(name, "0123456789abcdef");
  name += hash;
  if (hash < 6 || std::strncmp(name, kAfter, std::strlen(kAfter)) != 0) return false;
  name += std::strlen(kAfter);
  return *name == '\0' || *name == '.';
}

void* find(const char* library, const char* name) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  return handle ? dlsym(handle, name) : nullptr;
}

}  // namespace

void say(const char* words, const char* more, const char* end, const char* last) {
  std::fprintf(stderr, "fcl_kios_preload: %s%s%s%s\n", words, more, end, last);
}

bool isGlobal(const char* name) { return dlsym(RTLD_NEXT, name) != nullptr; }

void* findDefinition(const char* name, const void* caller) {
  if (void* const next = dlsym(RTLD_NEXT, name)) return next;
  if (void* const own = find(fileOf(caller), name)) {
    if (baseOf(own) != baseOf(here())) return own;
  }
  return find(kLibfcl, name);
}

void* nextDefinition(const char* name, const void* caller) {
  if (void* const found = findDefinition(name, caller)) return found;
  say("there is no other definition of ", name, ".");
  std::abort();
}

bool isOfLibfcl(const void* definition) {
  const void* const in_libfcl = find(kLibfcl, KIOS_COLLIDE);
  if (in_libfcl && baseOf(definition) == baseOf(in_libfcl)) return true;
  return isNameOfCopy(fileOf(definition)) && isNameOfCopy(sonameOf(definition));
}

bool isOfLibfcl(const Calls& calls) {
  const void* const base = baseOf(reinterpret_cast<const void*>(calls.collide));
  for (const void* const definition : {reinterpret_cast<const void*>(calls.collide_objects),
                                       reinterpret_cast<const void*>(calls.collide),
                                       reinterpret_cast<const void*>(calls.distance_objects),
                                       reinterpret_cast<const void*>(calls.distance)}) {
    if (baseOf(definition) != base || !isOfLibfcl(definition)) return false;
  }
  return true;
}

void reportReach(Mode mode) {
  const void* const first = dlsym(RTLD_DEFAULT, KIOS_COLLIDE);
  if (first && baseOf(first) != baseOf(here())) {
    say("nothing is done: fcl::collide is defined by ", fileOf(first),
        ", before this library (FCL is linked statically?).");
    return;
  }
  const void* const next = dlsym(RTLD_NEXT, KIOS_COLLIDE);
  if (!next) {
    // Python and shells bring it later or never: only who asks what is done is told.
    if (mode != Mode::kVerify && mode != Mode::kStats) return;
    say("libfcl.so.0.7 isn't loaded yet: queries are answered once a plug-in or module brings it "
        "(FCL that is linked statically can't be reached).");
  } else if (!isOfLibfcl(next)) {
    say("nothing is done: fcl::collide is defined by ", fileOf(next),
        ", and this library stands in for libfcl.so.0.7 only.");
  }
}

Mode modeOfEnvironment() {
  const char* const word = std::getenv("FCL_KIOS_PRELOAD");
  if (!word || *word == '\0') return Mode::kOn;
  constexpr struct {
    const char* word;
    Mode mode;
  } kModes[] = {{"off", Mode::kOff},
                {"on", Mode::kOn},
                {"trust", Mode::kTrust},
                {"verify", Mode::kVerify},
                {"stats", Mode::kStats}};
  for (const auto& mode : kModes) {
    if (std::strcmp(word, mode.word) == 0) return mode.mode;
  }
  say("FCL_KIOS_PRELOAD is \"", word,
      "\", but must be off, on, trust, verify or stats: nothing is done.");
  return Mode::kOff;
}

Opened openImplementation(const Start& start) {
  // Beside this library: fcl_kios/libfcl_kios_preload_implementation.so.
  char path[PATH_MAX + 64];
  if (!realpath(fileOf(here()), path)) {
    say("nothing is done: this library's own place is not known.");
    return {};
  }
  char* const slash = std::strrchr(path, '/');
  std::strcpy(slash ? slash + 1 : path, "fcl_kios/libfcl_kios_preload_implementation.so");
  void* const library = dlopen(path, RTLD_LAZY | RTLD_LOCAL);  // half the time of RTLD_NOW
  void* const open = library ? dlsym(library, kOpenName) : nullptr;
  if (!open) {
    const char* const why = dlerror();
    say("nothing is done: ", why ? why : path);
    return {};
  }
  const Opened opened = reinterpret_cast<Open>(open)(&start);
  if (opened.difference) {
    say("nothing is done: ", fileOf(reinterpret_cast<const void*>(start.fcl.collide)),
        " is no copy of libfcl.so.0.7 as it is built here; they differ in ", opened.difference);
  }
  return opened;
}

}  // namespace kios::preload
