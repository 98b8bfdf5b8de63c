// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A process whose threads are in the middle of queries forks, with the library linked before
// libfcl: its child changes models and asks on, and nothing that those threads held is in its way.
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include "preload/fcl_meshes.h"

namespace {

using fcl::Transform3d;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

void resize(Model& model, const Soup& soup) {
  model.beginUpdateModel();
  model.updateSubModel(soup.vertices);
  model.endUpdateModel(true, false);
}

/// Does the child's work: as often as it takes to have a copy of the changed model.
bool answersAreRight(Model& a, const Model& b, unsigned seed) {
  const Soup smaller = torus(24, 16, 0.8);
  resize(a, smaller);
  const auto like_a = build<fcl::OBBRSSd>(smaller);
  std::mt19937 random(seed);
  for (int i = 0; i < 150; ++i) {
    const Transform3d X_WB = randomPose(random, 2.2, 3.4);
    if (std::abs(distanceOf(a, b, X_WB) - distanceOf(*like_a, b, X_WB)) > 1e-12) return false;
  }
  return true;
}

/// Its status, or -1 if it doesn't end; then it is killed.
int waitFor(pid_t child) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(60);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

TEST(Fork, TheChildAsksOn) {
  const auto a = build<fcl::OBBRSSd>(torus(24, 16)), b = build<fcl::OBBRSSd>(torus(20, 15));
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      while (!stop) {
        // Copies that are being made as well.
        const auto own = build<fcl::OBBRSSd>(torus(12, 9));
        for (int i = 0; i < 100 && !stop; ++i) {
          distanceOf(*a, *b, randomPose(random, 2.2, 3.4));
          distanceOf(*a, *own, randomPose(random, 2.2, 3.4));
        }
      }
    });
  }
  int status = 0;
  for (unsigned i = 0; i < 20 && status == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + i));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) _exit(answersAreRight(*a, *b, i) ? 0 : 2);
    status = waitFor(child);
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(status, 0);
}

}  // namespace
