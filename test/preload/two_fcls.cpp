// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: two_fcls PLUGIN...
// A program without FCL whose plug-ins have one each, asked in this order.
#include <cstdio>

#include <dlfcn.h>

int main(int argc, char** argv) {
  for (int round = 0; round < 2; ++round) {
    for (int i = 1; i < argc; ++i) {
      void* const plugin = dlopen(argv[i], RTLD_NOW | RTLD_LOCAL);
      void* const ask = plugin ? dlsym(plugin, "ask") : nullptr;
      if (!ask) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 1;
      }
      if (reinterpret_cast<int (*)()>(ask)() != 0) {
        std::fprintf(stderr, "%s: another FCL's answer\n", argv[i]);
        return 1;
      }
    }
  }
  return 0;
}
