// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: host PLUGIN ARGUMENTS
// A program without FCL that opens a plug-in which has it, for itself alone.
#include <cstdio>

#include <dlfcn.h>

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  void* const plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  void* const run = plugin ? dlsym(plugin, "_Z19preload_plugin_mainiPPc") : nullptr;
  if (!run) {
    std::fprintf(stderr, "%s\n", dlerror());
    return 2;
  }
  return reinterpret_cast<int (*)(int, char**)>(run)(argc - 1, argv + 1);
}
