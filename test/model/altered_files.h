// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl/mesh_cases.h"
#include "model/deform.h"
#include "model/stored_file.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {

/// Alters stored models, and asks those that are taken. Random, but the same each time.
class AlteredFiles : public ::testing::Test {
 protected:
  using File = StoredFile<>;

  explicit AlteredFiles(const Mesh& mesh) : mesh_(mesh), saved_(save(*kiosModel(mesh))) {}

  /// Alters a file so often, each time from the one that was saved. False from `alter` if it
  /// changed nothing. Asks the models of those that are taken. Returns how many were.
  int alterAndLoad(int times, bool repair, const std::function<bool(File&)>& alter) {
    int taken = 0;
    for (int i = 0; i < times; ++i) {
      File file = saved_;
      if (!alter(file)) continue;
      if (repair) file.repairHash();
      const StoredFile<>::Bytes exact(file.bytes.begin(),
                                      file.bytes.end());  // no room after the last byte
      try {
        ask(*load(exact.data(), exact.size()));
        ++taken;
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("stored model"), std::string::npos);
      }
    }
    return taken;
  }

  void ask(Modeld& model) {
    askOnce(model);
    // A refit moves the tree, whatever it holds.
    replace(model, moved_, true, false);
    askOnce(model);
  }

  void askOnce(const Modeld& model) const {
    for (const Frame& frame : frames_) {
      distanceBracket(model, frame.X_WA, *partner_, frame.X_WB);
      DistanceBracketRequestd options;
      options.rel_err = 0.1;
      options.max_expansions = 20;
      distanceBracket(*plate_, frame.X_WA, model, frame.X_WB, options);
      closerThan(model, frame.X_WA, model, frame.X_WB, 0.1);
      fcl::CollisionResultd contacts;
      fcl::collide(&model, frame.X_WA, partner_.get(), frame.X_WB, fcl::CollisionRequestd(9),
                   contacts);
      fcl::collide(&model, frame.X_WA, plate_.get(), frame.X_WB, fcl::CollisionRequestd(1),
                   contacts);
      for (const fcl::CollisionGeometryd* shape : shapes_) {
        fcl::DistanceResultd result;
        fcl::distance(&model, frame.X_WA, shape, frame.X_WB, fcl::DistanceRequestd(), result);
        fcl::CollisionResultd touching;
        fcl::collide(&model, frame.X_WA, shape, frame.X_WB, fcl::CollisionRequestd(9), touching);
      }
      allHits(model, frame.X_WA, Rayd{frame.X_WB.translation(), Vector3d(1, 2, 3)}, 9);
    }
    save(model);
  }

  std::uint64_t any(std::uint64_t end) { return random_() % end; }
  bool oneIn(std::uint64_t n) { return any(n) == 0; }

  /// A count or an index such as programs stumble over.
  std::uint32_t oddInteger(std::uint32_t value) {
    const std::uint32_t odd[] = {
        0,         1,          value + 1,  value - 1,  ~value,
        value * 2, 0x7fffffff, 0x80000000, 0xffffffff, static_cast<std::uint32_t>(random_())};
    return odd[any(std::size(odd))];
  }
  double oddNumber() {
    const double odd[] = {0,
                          -1,
                          1e-310,
                          1e300,
                          -1e300,
                          std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()};
    return odd[any(std::size(odd))];
  }

  std::mt19937_64 random_{7};
  const std::shared_ptr<Modeld> partner_ = kiosModel(scenes::bumpyTorus(300));
  const std::shared_ptr<Modeld> plate_ =
      kiosModel(scenes::boredBlock({0.4, 0.25, 0.03}, 0.03, 0.004, 0.05, 32));
  const fcl::Sphered sphere_{0.3};
  const fcl::Cylinderd cylinder_{0.2, 0.9};
  const fcl::Halfspaced halfspace_{Vector3d(0, 0, 1), 0};
  const fcl::CollisionGeometryd* const shapes_[3] = {&sphere_, &cylinder_, &halfspace_};
  const std::vector<Frame> frames_ = randomFrames(2, 1.0, 17);
  const Mesh mesh_;
  const File saved_;
  const std::vector<Vector3d> moved_ = swayed(mesh_, 1);
};

}  // namespace kios::testing
