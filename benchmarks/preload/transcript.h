// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

/// The answers of a program, written by one run and compared by another: values in the same order,
/// each within a tolerance; 0 asks for the same bits, but for NaN.
class Transcript {
 public:
  /// `write FILE`, `check FILE`, or nothing: the answers are only made.
  Transcript(int argc, char** argv) {
    if (argc != 3) return;
    path_ = argv[2];
    writes_ = std::strcmp(argv[1], "write") == 0;
    if (writes_) return;
    std::ifstream file(path_);
    std::string what, value;
    while (file >> what >> value) wanted_.push_back({what, std::strtod(value.c_str(), nullptr)});
    if (wanted_.empty()) fail("there is nothing to compare with in " + path_);
  }

  void add(const std::string& what, double value, double tolerance = 0) {
    if (writes_) {
      written_.push_back({what, value});
    } else if (!path_.empty()) {
      compare(what, value, tolerance);
    }
    ++count_;
  }

  /// Returns the status of the program.
  int end() {
    if (writes_) {
      std::ofstream file(path_);
      file.precision(17);
      for (const Line& line : written_) file << line.what << ' ' << line.value << '\n';
    } else if (!path_.empty() && count_ != wanted_.size()) {
      fail("there are " + std::to_string(count_) + " answers, not " +
           std::to_string(wanted_.size()));
    }
    std::printf("%zu answers, %d of them wrong\n", count_, failures_);
    return failures_ > 0 ? 1 : 0;
  }

  void fail(const std::string& why) {
    if (++failures_ <= 20) std::printf("%s\n", why.c_str());
  }

 private:
  struct Line {
    std::string what;
    double value;
  };

  void compare(const std::string& what, double value, double tolerance) {
    if (count_ >= wanted_.size()) return;
    const Line& wanted = wanted_[count_];
    const bool same = value == wanted.value || (std::isnan(value) && std::isnan(wanted.value)) ||
                      std::abs(value - wanted.value) <= tolerance;
    if (wanted.what == what && same) return;
    char line[200];
    std::snprintf(line, sizeof(line), "%s: %.17g, but %s was %.17g", what.c_str(), value,
                  wanted.what.c_str(), wanted.value);
    fail(line);
  }

  std::string path_;
  bool writes_ = false;
  std::vector<Line> wanted_, written_;
  std::size_t count_ = 0;
  int failures_ = 0;
};
