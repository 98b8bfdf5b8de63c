// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The search for near pairs of a robot: none may be lost, at any scale, and few found in vain.

#include "linkage/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkage/robot_cases.h"
#include "not_finite.h"
#include "volume/float_lanes.h"

namespace kios::testing {
namespace {

using articulated::ObstacleBox;
using articulated::ObstacleTree;

long double distanceTo(const Vector3d& p, const ObstacleBox& box) {
  long double square = 0;
  for (int i = 0; i < 3; ++i) {
    const long double x = p[i];
    const long double off = std::max({box.low[i] - x, x - box.high[i], 0.0L});
    square += off * off;
  }
  return std::sqrt(square);
}

ObstacleBox boxWithin(Random& random, double scale, int body) {
  ObstacleBox box = {{}, {}, body, random.unit() * scale};
  const Vector3d low = pointWithin(random, scale),
                 size = pointWithin(random, 0.2 * scale).cwiseAbs();
  const bool unbounded = random.unit() < 0.01;
  for (int c = 0; c < 3; ++c) {
    box.low[c] = unbounded ? -kInfinity : low[c];
    box.high[c] = unbounded ? kInfinity : low[c] + size[c];
  }
  return box;
}

/// Moves, removes and adds boxes; at times in a row, by which the tree becomes deep.
void changeAtRandom(Random& random, double scale, ObstacleTree& tree,
                    std::vector<ObstacleBox>& boxes) {
  int next = 100000;
  double far = scale;
  for (int k = static_cast<int>(random.uniform(0, 2.0 * static_cast<double>(boxes.size())));
       k > 0 && !boxes.empty(); --k) {
    const auto i = static_cast<std::size_t>(random.unit() * static_cast<double>(boxes.size() - 1));
    if (random.unit() < 0.2) {
      far *= 0.5;
      boxes.push_back(boxWithin(random, far, next++));
      tree.insert(boxes.back());
      continue;
    }
    EXPECT_TRUE(tree.remove(boxes[i].body));
    if (random.unit() < 0.3) {
      boxes[i] = boxes.back();
      boxes.pop_back();
      continue;
    }
    boxes[i] = boxWithin(random, scale, boxes[i].body);
    tree.insert(boxes[i]);
  }
}

TEST(ObstacleTree, FindsAllThatIsNear) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double scale = kFloatScales[i % 8];
    const int count = i % 7 == 0 ? static_cast<int>(random.uniform(0, 6))
                                 : static_cast<int>(std::pow(300, random.unit()));
    std::vector<ObstacleBox> boxes;
    for (int k = 0; k < count; ++k) {
      boxes.push_back(boxWithin(random, scale, 3 * k + 1));
    }
    ObstacleTree tree(boxes);
    changeAtRandom(random, scale, tree, boxes);
    double farthest = 0;
    for (const ObstacleBox& box : boxes) farthest = std::max(farthest, box.length);
    EXPECT_EQ(tree.size(), static_cast<long long>(boxes.size()));
    EXPECT_EQ(tree.farthest(), farthest);
    EXPECT_FALSE(tree.remove(3 * count + 1));
    Vector3d p = pointWithin(random, 1.3 * scale);
    if (!boxes.empty() && i % 9 == 0 && boxes[0].high[0] < kInfinity) {  // beside a face
      p = {boxes[0].low[0] * (1 + 1e-9), boxes[0].low[1], boxes[0].high[2]};
    }
    double far = scale * std::pow(10, random.uniform(-4, 0.3));
    // Just near enough, where rounding could lose it.
    if (!boxes.empty() && i % 3 == 0) far = static_cast<double>(distanceTo(p, boxes[0]));
    std::vector<int> found;
    tree.forNear(p, far, [&](int body) {
      found.push_back(body);
      return false;
    });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::unique(found.begin(), found.end()), found.end()) << "found twice";
    for (const ObstacleBox& box : boxes) {
      const bool is_found = std::binary_search(found.begin(), found.end(), box.body);
      const long double distance = distanceTo(p, box);
      if (distance <= far) {
        EXPECT_TRUE(is_found) << i;
      }
      if (scale > 1e-17 && scale < 1e17 && distance > far + kVain * (scale + far)) {
        EXPECT_FALSE(is_found) << i;
      }
    }
  }
}

// Obstacles that come after a path was asked about, and pairs that are allowed, in any order.
// A half-space or a room holds the boxes of all others; boxes may be equal, or one in another.
TEST(ObstacleTree, HoldsThousandsThatComeAndGo) {
  Random random(11);
  const int count = 5000;
  for (int kind = 0; kind < 5; ++kind) {
    SCOPED_TRACE(kind);
    ObstacleTree tree;
    const auto add = [&](int body) {
      const double side = kind == 4 ? std::pow(0.99, body) : 0.1;
      ObstacleBox box = {{0, 0, 0}, {side, side, side}, body, 1};
      const bool first = body % count == 0;
      for (int c = 0; c < 3 && kind < 2; ++c) {
        box.low[c] = random.uniform(-5, 5);
        box.high[c] = box.low[c] + 0.1;
        if (first) box.low[c] = kind == 0 ? -kInfinity : -10;
        if (first) box.high[c] = kind == 0 ? kInfinity : 10;
      }
      for (int c = 0; c < 3 && kind == 2; ++c) {
        box.low[c] = -kInfinity;
        box.high[c] = kInfinity;
      }
      tree.insert(box);
    };
    for (int body = 0; body < count; ++body) add(body);
    for (int body = 0; body < count; ++body) {  // one goes, one comes
      EXPECT_TRUE(tree.remove(body));
      add(body + count);
    }
    int found = 0;
    tree.forNear(Vector3d(0, 0, 0), 100, [&](int body) {
      found += body >= count ? 1 : 0;
      return false;
    });
    EXPECT_EQ(found, count);
  }
}

}  // namespace
}  // namespace kios::testing
