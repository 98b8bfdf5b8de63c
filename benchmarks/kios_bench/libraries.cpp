// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>

#include "library.h"

namespace kios::bench {
namespace {

const Library* before = nullptr;
const Library* now = &kios_bench_library;

/// It stays loaded: its models may outlive whoever asked.
const Library* load(const std::filesystem::path& file) {
  void* const object = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* const makers = object ? dlsym(object, "kios_bench_library") : nullptr;
  if (!makers) throw std::runtime_error(dlerror());
  return static_cast<const Library*>(makers);
}

}  // namespace

void loadLibraries(const std::filesystem::path& before_file,
                   const std::filesystem::path& now_file) {
  before = load(before_file);
  now = load(now_file);
}

bool isBefore(const std::string& bv) {
  const std::size_t size = sizeof kBefore - 1;
  return bv.size() > size && bv.compare(bv.size() - size, size, kBefore) == 0;
}

bool isOurs(const std::string& bv) { return bv == kOurs || bv == std::string(kOurs) + kBefore; }

const Library& libraryOf(const std::string& bv) {
  if (!isBefore(bv)) return *now;
  if (!before) throw std::invalid_argument(bv + " needs --compare");
  return *before;
}

std::vector<std::string> compared(const std::vector<std::string>& names) {
  if (!before) return names;
  std::vector<std::string> both;
  for (const std::string& name : names) {
    const bool known = name == kOurs || name == kOurTree;
    const bool other = name.rfind("kios", 0) == 0 || name.rfind("sampled_", 0) == 0;
    if (known || !other) both.push_back(name);
    if (known) both.push_back(name + kBefore);
  }
  return both;
}

int roundsOf(const std::string& bv, double us_of_pass) {
  constexpr double kUs = 4000;  // a hundred times what the clock and the first misses cost
  constexpr int kLeast = 3, kMost = 100;
  if (!before || bv.rfind(kOurs, 0) != 0) return 1;
  return static_cast<int>(std::clamp(kUs / us_of_pass, double{kLeast}, double{kMost}));
}

}  // namespace kios::bench
