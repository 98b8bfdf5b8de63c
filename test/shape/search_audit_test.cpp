// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every bound that the SIMD search for triangles near a solid computes is at most the distance of
// what it bounds, by the kernel of one triangle; what it proves to touch touches; and nothing
// nearer than what is asked for is left out. Without the pads that fails.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl/mesh_cases.h"
#include "model/prepared.h"
#include "not_finite.h"
#include "query/float_solid.h"
#include "query/mesh_contacts.h"
#include "scenes/cad_shapes.h"
#include "search/prepared_pair.h"
#include "search/search.h"
#include "shape/convex_faces.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"

namespace kios::testing {
namespace {

/// Holds a search that evaluates nothing: what matters doesn't change.
class Listener final : public engine::SolidEvaluator, public engine::SolidAudit {
 public:
  bool evaluate(std::uint32_t triangle, bool) override {
    evaluated.push_back(triangle);
    return false;
  }
  void boundNode(std::uint32_t node, float bound) override { nodes.push_back({node, bound}); }
  void boundTriangle(std::uint32_t triangle, float bound, bool meets) override {
    triangles.push_back({triangle, bound});
    if (meets) meeting.push_back(triangle);
  }

  struct Bound {
    std::uint32_t id;
    float bound;
  };
  std::vector<Bound> nodes, triangles;
  std::vector<std::uint32_t> evaluated, meeting;
};

/// Says what was counted over many searches.
struct Audited {
  int bounds = 0, wrong = 0, missed = 0, searches = 0, meeting = 0, apart = 0;
};

/// Shares of the pads.
struct Pads {
  float of_points = 1, of_boxes = 1;
};

template <typename S>
class Auditor {
 public:
  explicit Auditor(const Mesh& mesh)
      : model_(scenes::buildModel<kIOS<S>>(mesh)),
        tree_(treeOf(*model_)),
        below_(contents(tree_)) {}

  /// The search is left a share of the pads. False if floats can't serve the pair.
  bool search(const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3d& X_WM,
              const fcl::Transform3d& X_WS, Pads pads, Audited& out) {
    const PosedSolid posed(toSolid(geometry), X_WM.cast<S>(), X_WS.cast<S>(), meshOf(*model_));
    const bool by_faces = ++calls_ % 2 == 0;  // every other time of a convex shape
    const auto of_faces = shape::ConvexFaces(posed.solid()).slabs();
    engine::FloatSolid solid;
    if (!makeFloatSolid(tree_, posed, by_faces, solid)) return false;
    solid.pad *= pads.of_points;
    solid.box_pad *= pads.of_boxes;
    distances_.clear();
    std::size_t nearest = 0;
    std::vector<engine::FloatSlab> slabs;
    for (const auto& face : of_faces) {
      if (by_faces) slabs.push_back(slabInTree(tree_, posed, face.normal, face.offset));
    }
    double reach = posed.solid().reach();
    for (int i = 0; i < model_->num_tris; ++i) {
      const shape::Triangle t = posed.place(cornersInDouble(*model_, i));
      const auto d = shape::distance(posed.solid(), t, kInfinity);
      distances_.push_back(d.distance);
      reach = std::max(reach, shape::sizeOf(t));
      if (distances_.back() < distances_[nearest]) nearest = distances_.size() - 1;
      const shape::Vec way = d.on_triangle - d.on_shape;
      if (i % 7 == 0 && d.distance > 0 && posed.solid().bounded()) {
        const shape::Vec n = way.normalized();
        slabs.push_back(slabInTree(tree_, posed, n, shape::extentAlong(posed.solid(), n)));
      }
    }
    error_ = 0x1p-43 * reach;
    std::vector<double> sorted = distances_;
    std::sort(sorted.begin(), sorted.end());
    for (const double limit :
         {kInfinity, 0.0, sorted[0], sorted[sorted.size() / 9], sorted[sorted.size() / 2]}) {
      Listener listener;
      listener.cull_distance = static_cast<float>(limit);
      if (limit < kInfinity && limit > 0) {
        listener.cull_distance = std::nextafter(listener.cull_distance, 2 * listener.cull_distance);
      }
      if (limit > 0 && !slabs.empty()) listener.slab = slabs.back();
      if (by_faces) {
        listener.setSlabs(slabs);
      } else {
        for (const engine::FloatSlab& slab : slabs) listener.addSlab(slab);
      }
      SearchCounts counts;
      const float asked = listener.cull_distance;
      engine::kernels().solid({tree_, solid, listener, counts, &listener});
      judge(listener, asked, out);
    }
    return true;
  }

 private:
  void judge(const Listener& heard, double asked, Audited& out) {
    const auto check = [&](double distance, float bound) {
      ++out.bounds;
      out.apart += bound > 0;
      out.wrong += double{bound} > distance + error_;
    };
    for (const auto& node : heard.nodes) {
      double least = kInfinity;
      for (const std::uint32_t t : below_[node.id]) least = std::min(least, distances_[t]);
      check(least, node.bound);
    }
    for (const auto& t : heard.triangles) check(distances_[t.id], t.bound);
    for (const std::uint32_t t : heard.meeting) {
      ++out.meeting;
      out.wrong += distances_[t] > 0;
    }
    // An offered vertex may lower what matters to the least distance and the pad: not below.
    const double least = *std::min_element(distances_.begin(), distances_.end());
    const double matters = std::min(asked, least > 0 ? std::nextafter(least, kInfinity) : 1e-300);
    std::vector<char> seen(distances_.size());
    for (const std::uint32_t t : heard.evaluated) seen[t] = 1;
    for (std::size_t t = 0; t < seen.size(); ++t) {
      const bool must = asked == 0 ? distances_[t] == 0 : distances_[t] < matters;
      out.missed += must && !seen[t];
    }
    ++out.searches;
  }

  const std::shared_ptr<fcl::BVHModel<kIOS<S>>> model_;
  const engine::Tree& tree_;
  const std::vector<std::vector<std::uint32_t>> below_;
  std::vector<double> distances_;
  double error_ = 0;
  int calls_ = 0;
};

struct Where {
  double scale = 1, spread = 1.5, shape_scale = 1, stretch = 0, world = 0;
  Vector3d model = Vector3d::Zero();  ///< offset of the mesh in its own frame
  bool zero = false;                  ///< some sizes are 0
};

template <typename S>
void audit(Shape kind, const Mesh& mesh, const Where& where, int poses, Pads pads, Audited& out) {
  Auditor<S> auditor(transformed(mesh, where.scale, where.model));
  scenes::Random random(5);
  for (const Frame& frame : randomFrames(poses, where.spread * where.scale, 31)) {
    ShapeSpec spec = randomShape(kind, random);
    spec.size *= kind < Shape::kHalfspace ? where.scale * where.shape_scale : 1;
    spec.offset *= where.scale * where.shape_scale;
    for (auto& p : spec.hull.vertices) p *= where.scale * where.shape_scale;
    if (where.zero && kind < Shape::kConvex) spec.size[random.unit() < 0.5 ? 0 : 1] = 0;
    const auto geometry = makeShape<S>(spec);
    fcl::Transform3d X_WM = frame.X_WA, X_WS = frame.X_WB;
    X_WM.linear() *= 1 + where.stretch;
    X_WM.translation() -= X_WM.linear() * where.model;
    X_WM.translation().array() += where.world;
    X_WS.translation().array() += where.world;
    EXPECT_TRUE(auditor.search(*geometry, X_WM, X_WS, pads, out));
  }
}

void expectRight(const Audited& audited) {
  EXPECT_EQ(audited.wrong, 0) << "of " << audited.bounds;
  EXPECT_EQ(audited.missed, 0) << "in " << audited.searches;
}

class SearchAudit : public ::testing::TestWithParam<Shape> {
 protected:
  template <typename S>
  static void all(Pads pads, Audited& out) {
    constexpr bool kDouble = sizeof(S) == sizeof(double);
    const Shape kind = GetParam();
    const int n = kind == Shape::kEllipsoid || kind == Shape::kConvex ? 12 : 24;
    const Mesh torus = scenes::bumpyTorus(400), points = heaps(30, 3);
    audit<S>(kind, torus, {}, n, pads, out);
    audit<S>(kind, scenes::randomSoup(90, 1, 1e-3, 1, 3), {}, n, pads, out);
    audit<S>(kind, scenes::stripCylinder(30, 0.8, 0.004), {}, n, pads, out);
    for (const Mesh* mesh : {&torus, &points}) {
      for (const double scale : {1e-9, 1.0, 1e9}) {
        Where where;
        where.scale = scale;
        audit<S>(kind, *mesh, where, n, pads, out);
      }
      for (const double e : {-2.8e-5, 2.8e-5}) {
        Where where;
        where.stretch = e;
        audit<S>(kind, *mesh, where, n, pads, out);
      }
      Where where;
      where.zero = true;
      audit<S>(kind, *mesh, where, n, pads, out);
      where = {};
      where.world = kDouble ? 0x1p30 : 0x1p8;
      audit<S>(kind, *mesh, where, n, pads, out);
      where = {};
      where.model = (kDouble ? 1e6 : 1e2) * Vector3d(1, -0.3, 0.7);
      audit<S>(kind, *mesh, where, n, pads, out);
      where = {};
      where.shape_scale = 1e3;
      where.spread = 600;
      if (kind == Shape::kBox) audit<S>(kind, *mesh, where, n, pads, out);
    }
  }
};

TEST_P(SearchAudit, BoundsHoldInDouble) {
  Audited audited;
  all<double>({}, audited);
  expectRight(audited);
  EXPECT_GT(audited.apart, 1000);
  EXPECT_TRUE(GetParam() == Shape::kConvex || audited.meeting > 10);
}

TEST_P(SearchAudit, BoundsHoldInFloat) {
  Audited audited;
  all<float>({}, audited);
  expectRight(audited);
}

TEST_P(SearchAudit, PadsAreNeeded) {
  Audited of_points, of_boxes;
  all<double>({0, 1}, of_points);
  all<double>({1, 0}, of_boxes);
  EXPECT_GT(of_points.wrong, 0);
  EXPECT_GT(of_boxes.wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SearchAudit, ::testing::ValuesIn(kShapes), NameOfShape());

}  // namespace
}  // namespace kios::testing
