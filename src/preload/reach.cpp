// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/reach.h"

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

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

void* find(const char* library, const char* name) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  return handle ? dlsym(handle, name) : nullptr;
}

}  // namespace

void say(const char* words, const char* more, const char* end) {
  std::fprintf(stderr, "fcl_kios_preload: %s%s%s\n", words, more, end);
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
  return in_libfcl && baseOf(definition) == baseOf(in_libfcl);
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

Opened openBack(const Start& start) {
  // Beside this library: fcl_kios/libfcl_kios_preload_back.so.
  char path[PATH_MAX + 64];
  if (!realpath(fileOf(here()), path)) {
    say("nothing is done: this library's own place is not known.");
    return {};
  }
  char* const slash = std::strrchr(path, '/');
  std::strcpy(slash ? slash + 1 : path, "fcl_kios/libfcl_kios_preload_back.so");
  void* const back = dlopen(path, RTLD_LAZY | RTLD_LOCAL);  // half the time of RTLD_NOW
  void* const open = back ? dlsym(back, kOpenName) : nullptr;
  if (!open) {
    const char* const why = dlerror();
    say("nothing is done: ", why ? why : path);
    return {};
  }
  return reinterpret_cast<Open>(open)(&start);
}

}  // namespace kios::preload
