// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/octree_search.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cmath>

#include "model/walk.h"
#include "search/pair_query.h"
#include "search/root_body.h"
#include "search/search.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using shape::Vec;

Vec originOf(const engine::Tree& tree) { return Eigen::Map<const Vec>(tree.origin); }

double reachOf(const Mesh& mesh) {
  return std::ldexp(double{mesh.tree().reach}, mesh.tree().exponent);
}

/// Bounds the rounding of the mesh's points as the exact stage poses them, and of its tests; cells
/// that matter are no farther than `cells`.
double pointError(const Mesh& mesh, const PosedSolid& posed, double cells) {
  const double lengths = originOf(mesh.tree()).lpNorm<1>() + 2 * reachOf(mesh);
  return error_bounds::solidError(posed.toUnits(2 * lengths) + posed.T().lpNorm<1>() + cells);
}

}  // namespace

// Content is as far from the stored vertices as these are rounded, up to kStored of its norm 1 from
// the tree's origin.
OctreePair::OctreePair(PosedSolid posed, const Mesh& mesh, const CellTree::Node* root, bool unknown,
                       CellTree::Matters matters, SearchCounts& counts)
    : mesh_(mesh),
      posed_(std::move(posed)),
      cells_(root, posed_.solid().half.x(), unknown, std::move(matters)),
      counts_(counts),
      tree_{mesh_.tree(), posed_.R(), posed_.place(originOf(mesh_.tree())),
            std::ldexp(posed_.toUnits(1), mesh_.tree().exponent)} {
  cube_.kind = shape::Kind::kBox;
  const double reach = posed_.toUnits(reachOf(mesh_));
  pad_ = pointError(mesh_, posed_, posed_.reach()) +
         (posed_.stretch() + 1.8 * engine::kStored) * reach;
}

void OctreePair::placeSpheres(std::uint32_t node, Ball (&spheres)[engine::kSphereRows]) const {
  const engine::Node& at = tree_.node(node);
  const auto set = [&](Ball& ball, const Vec& center, double r) {
    ball = {center[0], center[1], center[2], r * tree_.unit + pad_};
  };
  set(spheres[0], tree_.center(node), at.r[engine::kCentral]);
  for (const int row : {int{engine::kMiddle2}, int{engine::kMiddle1}}) {
    const Vec middle = tree_.rotated(node, row) + tree_.t, half = tree_.rotated(node, row + 1);
    set(spheres[row], middle + half, double{at.r[row]} + at.r[row + 1]);
    set(spheres[row + 1], middle - half, double{at.r[row]} - at.r[row + 1]);
  }
}

OctreePair::CellAndNode OctreePair::bounded(const Cell& cell, std::uint32_t node,
                                            const Ball (&spheres)[engine::kSphereRows]) const {
  ++counts_.volume_tests;
  const Vec center = cells_.centerOf(cell);
  const double half = cells_.halfOf(cell);
  double best = -kInfinity;
  for (const Ball& ball : spheres) {
    const double x = std::abs(ball.x - center.x()) - half, y = std::abs(ball.y - center.y()) - half,
                 z = std::abs(ball.z - center.z()) - half;
    const double most = std::max({x, y, z});
    const auto square = [](double v) { return v > 0 ? v * v : 0; };
    const double apart = most > 0 ? std::sqrt(square(x) + square(y) + square(z)) : most;
    best = std::max(best, apart - ball.r);
  }
  return {best, cell, node};
}

// The larger of a pair is divided, unless only the other can be.
template <typename Skip, typename Test>
void OctreePair::walk(const Skip& skip, const Test& test) {
  if (!cells_.rootMatters()) return;
  Ball spheres[engine::kSphereRows];
  const auto visit = [&](const CellAndNode& pair, const auto& add) {
    const Cell& cell = pair.cell;
    const bool leaf = tree_.isLeaf(pair.node);
    if (cell.leaf != 0 && leaf) {
      return tree_.anyTriangle(pair.node, [&](std::uint32_t t) { return test(cell, t); });
    }
    constexpr double kRadius = 1.75;  // of a cube, in halves
    if (cell.leaf == 0 && (leaf || kRadius * cells_.halfOf(cell) > tree_.radius(pair.node))) {
      const void* children[8];
      std::uint32_t leaves;
      const std::uint32_t mattering = cells_.open(cell.node, 0xFF, children, leaves);
      placeSpheres(pair.node, spheres);
      for (std::uint32_t i = 0; i < 8; ++i) {
        if ((mattering >> i & 1U) == 0) continue;
        const Cell child = cell.child(i, children[i], (leaves >> i & 1U) != 0);
        add(bounded(child, pair.node, spheres));
      }
    } else {
      tree_.forChildren(pair.node, [&](std::uint32_t child) {
        placeSpheres(child, spheres);
        add(bounded(cell, child, spheres));
      });
    }
    return false;
  };
  placeSpheres(0, spheres);
  walkNearestFirst(
      bounded(cells_.root(), 0, spheres), [&](const CellAndNode& pair) { return skip(pair.bound); },
      visit);
}

const shape::Solid& OctreePair::cubeOf(const Cell& cell) {
  cube_.half.setConstant(cells_.halfOf(cell));
  return cube_;
}

shape::Triangle OctreePair::triangleFrom(const Cell& cell, std::uint32_t triangle) const {
  const Vec center = cells_.centerOf(cell);
  const TriangleVerticesd t = posed_.place(mesh_.triangle(triangle));
  return {t[0] - center, t[1] - center, t[2] - center};
}

const std::vector<OctreeContacts::Found>& OctreeContacts::run(std::size_t limit) {
  limit_ = limit;
  Ball spheres[engine::kSphereRows];
  placeSpheres(0, spheres);
  ++counts_.volume_tests;
  if (!cells_.startNear(spheres, engine::kSphereRows)) return found_;
  const Cell root = cells_.root();
  engine::CellFrame frame;
  if (makeFrame(frame)) {
    engine::kernels().cells({mesh_.tree(), frame, *this, counts_, &root, 1});
  } else {
    walk([](double bound) { return bound > 0; },
         [&](const Cell& cell, std::uint32_t t) { return evaluate(cell, t, false); });
  }
  if (found_.size() < limit_) {
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      if (a.triangle != b.triangle) return a.triangle < b.triangle;
      if (a.cell.x != b.cell.x) return a.cell.x < b.cell.x;
      return a.cell.y != b.cell.y ? a.cell.y < b.cell.y : a.cell.z < b.cell.z;
    });
  }
  return found_;
}

bool OctreeContacts::evaluate(const Cell& cell, std::uint32_t triangle, bool sure) {
  ++counts_.leaf_kernels;
  if (!sure && !shape::intersects(cubeOf(cell), triangleFrom(cell, triangle))) return false;
  found_.push_back({cell, triangle});
  return found_.size() >= limit_;
}

shape::TriangleShapeContact OctreeContacts::contactOf(const Found& found) {
  auto contact = shape::contact(cubeOf(found.cell), triangleFrom(found.cell, found.triangle));
  contact.position = posed_.toWorld(contact.position + cells_.centerOf(found.cell));
  contact.normal = posed_.directionToWorld(contact.normal);
  return contact;
}

// False if floats don't serve.
bool OctreeContacts::makeFrame(engine::CellFrame& frame) const {
  const engine::Tree& tree = mesh_.tree();
  const Vec origin = cells_.origin();
  const Vec t = posed_.R() * originOf(tree) + (posed_.T() - origin);
  const double reach = tree.reach, scale = reach + t.lpNorm<1>();
  if (tree.exponent != 0 || !posed_.hasUnit1() || !(scale <= engine::CellFrame::kLargestReach) ||
      !(posed_.solid().half.x() <= engine::CellFrame::kLargestRoot)) {
    return false;
  }
  const double more =
      posed_.stretch() * scale +
      pointError(mesh_, posed_,
                 std::min(posed_.solid().half.x(), 4 * (scale + origin.lpNorm<1>())));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.from_mesh.R[i][j] = roundedTo<float>(posed_.R()(i, j));
    frame.from_mesh.t[i] = roundedTo<float>(t[i]);
  }
  frame.unit = roundedTo<float>(cells_.unit());
  frame.pad = roundUpFloat(0x1p-18 * scale + more);
  frame.box_pad = roundUpFloat(0x1p-17 * scale + more);
  return true;
}

void OctreeDistance::run(double rel_err, double abs_err, double far_enough) {
  double cull_distance = 0;
  const auto lowerTo = [&](double distance) {
    best_ = distance;
    cull_distance = engine::cullDistance(distance, rel_err, abs_err);
  };
  lowerTo(far_enough);
  if (!(best_ > 0)) return;
  const auto skip = [&](double bound) { return !(std::max(bound, 0.0) < cull_distance); };
  walk(skip, [&](const Cell& cell, std::uint32_t id) {
    const shape::Triangle t = triangleFrom(cell, id);
    const double half = cells_.halfOf(cell);
    const Vec low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    const double boxes = (low.cwiseMax(-high).array() - half).matrix().cwiseMax(0.0).norm();
    if (boxes >= cull_distance) return false;
    ++counts_.leaf_kernels;
    const auto d = shape::distance(cubeOf(cell), t, cull_distance);
    if (!(d.distance < best_)) return false;
    lowerTo(d.distance);
    triangle_ = static_cast<int>(id);
    cell_ = cell;
    on_cell_ = d.on_shape + cells_.centerOf(cell);
    on_triangle_ = d.on_triangle + cells_.centerOf(cell);
    return !(best_ > 0);
  });
}

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
