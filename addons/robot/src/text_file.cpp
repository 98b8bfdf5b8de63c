// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "files/read_mesh.h"

namespace kios::robot {
namespace {

// A linkage keeps rotations that are orthonormal to twice this, and so has what is kept here.
fcl::Transform3d normalized(const fcl::Transform3d& X) {
  constexpr double kRounded = 8 * 0x1p-53;
  const Eigen::Matrix3d R = X.linear();
  fcl::Transform3d result = fcl::Transform3d::Identity();
  const bool keep = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() <= kRounded;
  result.linear() = keep ? R : Eigen::Quaterniond(R).normalized().toRotationMatrix();
  result.translation() = X.translation();
  return result;
}

}  // namespace

void refuse(const std::string& what) {
  std::string message = "fcl_kios: " + what;  // of one line, whatever a file holds
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
  throw std::invalid_argument(message);
}

void refuseAt(const std::string& file, int line, const std::string& what) {
  refuse(file + (line > 0 ? ":" + std::to_string(line) : std::string()) + ": " + what);
}

std::string contentOf(const std::string& file, std::size_t most) {
  try {
    return files::contentOf(file, most);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

bool parseNumbers(const std::string& text, int count, double* numbers) {
  const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  const char *at = text.data(), *const end = at + text.size();
  for (int i = 0; i <= count; ++i) {
    while (at != end && isSpace(*at)) ++at;
    if (i == count) break;
    if (at != end && *at == '+') ++at;
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc() || !std::isfinite(numbers[i])) return false;
    if (next != end && !isSpace(*next)) return false;
    at = next;
  }
  return at == end;
}

fcl::Transform3d rigid(const fcl::Transform3d& X, const std::string& what) {
  const Eigen::Matrix3d R = X.linear();
  constexpr double kNonRigid = 1e-4, kFarthest = 0x1p300;
  if (!X.matrix().allFinite() || !(X.translation().lpNorm<1>() <= kFarthest)) {
    refuse("the pose of " + what + " is NaN, infinite or too large.");
  }
  if (!((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() <= kNonRigid) ||
      !(R.determinant() > 0)) {
    refuse("the pose of " + what + " isn't rigid: its rotation must be one.");
  }
  return normalized(X);
}

fcl::Transform3d rigidProduct(const fcl::Transform3d& X, const fcl::Transform3d& Y) {
  return normalized(X * Y);
}

}  // namespace kios::robot
