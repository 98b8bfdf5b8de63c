// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include "fcl/shape_solid.h"
#include "motion_report.h"
#include "scenario.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "shape/triangle_shape.h"
#include "shape_competitor.h"
#include "timing.h"

namespace kios::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

constexpr struct {
  ShapeQuery query;
  const char* name;
} kQueries[] = {{ShapeQuery::kDistance, "distance"},
                {ShapeQuery::kFirstContact, "collide"},
                {ShapeQuery::kAllContacts, "contacts"}};

Geometry convexOf(const scenes::Mesh& hull) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (const fcl::Triangle& t : hull.triangles) {
    faces->push_back(3);
    for (int corner = 0; corner < 3; ++corner) faces->push_back(static_cast<int>(t[corner]));
  }
  return std::make_shared<fcl::Convexd>(std::make_shared<std::vector<fcl::Vector3d>>(hull.vertices),
                                        static_cast<int>(hull.triangles.size()), faces);
}

/// Occupied cells of 0.05 about the surface of a sphere of radius 0.4.
Geometry shellOctree() {
  auto tree = std::make_shared<octomap::OcTree>(0.05);
  for (const fcl::Vector3d& p : scenes::icosphere(0.4, 4).vertices) {
    tree->updateNode(octomap::point3d(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                      static_cast<float>(p[2])),
                     true);
  }
  tree->updateInnerOccupancy();
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

/// Answers by testing every triangle with the shape, or with every occupied cell of an octree, by
/// the kernel of one triangle and one shape, which the tests compare with an oracle of their own.
class BruteForce {
 public:
  BruteForce(const scenes::Mesh& mesh, const fcl::CollisionGeometryd& geometry) : mesh_(mesh) {
    if (geometry.getObjectType() != fcl::OT_OCTREE) {
      solids_.push_back({toSolid(geometry), fcl::Vector3d::Zero(), 0});
      return;
    }
    for (const auto& [x, y, z, size, occupancy, threshold] :
         static_cast<const fcl::OcTreed&>(geometry).toBoxes()) {
      solids_.push_back({toSolid<double>(fcl::Boxd(size, size, size)), {x, y, z}, 0.87 * size});
    }
  }

  double operator()(ShapeQuery query, const scenes::Frame& frame) const {
    const fcl::Matrix3d R = frame.X_WB.linear().transpose() * frame.X_WA.linear();
    const fcl::Vector3d t =
        frame.X_WB.linear().transpose() * (frame.X_WA.translation() - frame.X_WB.translation());
    double nearest = std::numeric_limits<double>::infinity(), contacts = 0;
    for (const fcl::Triangle& ids : mesh_.triangles) {
      shape::Triangle triangle;
      for (int c = 0; c < 3; ++c) triangle[c] = R * mesh_.vertices[ids[c]] + t;
      const double reach =
          std::max((triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[0]).norm());
      for (const PlacedSolid& placed : solids_) {
        const double enough = query == ShapeQuery::kDistance ? nearest : 0;
        if (placed.radius > 0 &&
            (triangle[0] - placed.center).norm() - reach - placed.radius > enough) {
          continue;
        }
        shape::Triangle local = triangle;
        for (shape::Vec& corner : local) corner -= placed.center;
        if (query == ShapeQuery::kDistance) {
          nearest = std::min(nearest, shape::distance(placed.solid, local, nearest).distance);
        } else if (shape::intersects(placed.solid, local)) {
          contacts += 1;
        }
      }
    }
    if (query == ShapeQuery::kDistance) return nearest;
    return query == ShapeQuery::kFirstContact ? std::min(contacts, 1.0) : contacts;
  }

 private:
  struct PlacedSolid {
    shape::Solid solid;
    fcl::Vector3d center;
    double radius;  ///< of a sphere about it, 0 if not known
  };

  const scenes::Mesh& mesh_;
  std::vector<PlacedSolid> solids_;
};

/// The frames of each query: apart for distances, touching or near for contacts.
std::vector<scenes::Frame> framesOf(ShapeQuery query, int count, std::uint64_t seed) {
  if (query == ShapeQuery::kDistance) return scenes::farMotion(count, 2.1, 4, seed);
  return scenes::farMotion(count, 0.4, 1.9, seed + 1);
}

/// Sets errors and wrong verdicts of the row from a few frames.
void judge(const scenes::Mesh& mesh, const Geometry& geometry, ShapeQuery query,
           const std::vector<scenes::Frame>& frames, const std::vector<double>& answers, int count,
           Row& row) {
  const BruteForce exact(mesh, *geometry);
  row.wrong_verdicts = 0;
  const auto wanted = std::min(frames.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t at = i * frames.size() / wanted;
    const double truth = exact(query, frames[at]);
    if (query != ShapeQuery::kDistance) {
      *row.wrong_verdicts += answers[at] == truth ? 0 : 1;
      continue;
    }
    *row.wrong_verdicts += (answers[at] > 0) == (truth > 0) ? 0 : 1;
    const double error = std::isfinite(answers[at]) ? std::abs(answers[at] - truth)
                                                    : std::numeric_limits<double>::infinity();
    row.max_abs_error = std::max(row.max_abs_error.value_or(0), error);
  }
}

struct Lane {
  std::unique_ptr<ShapeCompetitor> competitor;
  std::vector<double> answers, repeat_us;
};

void reportGeometry(const std::string& scenario, const scenes::Mesh& mesh, const Geometry& geometry,
                    int frame_count, const Options& options, Report& report) {
  std::vector<Lane> lanes(2);
  lanes[0].competitor = makeKiosShapeCompetitor();
  lanes[1].competitor = makeObbrssShapeCompetitor();
  for (Lane& lane : lanes) lane.competitor->load(mesh, geometry);
  std::vector<Row> rows;
  for (const auto& [query, query_name] : kQueries) {
    const auto frames = framesOf(query, frame_count, options.seed);
    for (Lane& lane : lanes) {
      lane.answers.assign(frames.size(), 0);
      lane.repeat_us.clear();
      lane.competitor->answer(query, frames, 0, frames.size(), lane.answers);  // warms up
    }
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + static_cast<std::size_t>(repeat)) % lanes.size()];
        const double start = nowMicroseconds();
        lane.competitor->answer(query, frames, 0, frames.size(), lane.answers);
        lane.repeat_us.push_back((nowMicroseconds() - start) / static_cast<double>(frames.size()));
      }
    }
    for (const Lane& lane : lanes) {
      Row row;
      row.scenario = scenario;
      row.query = query_name;
      row.bv = lane.competitor->name();
      row.triangles = mesh.triangles.size();
      row.frames = frames.size();
      row.median_us = median(lane.repeat_us);
      row.min_us = *std::min_element(lane.repeat_us.begin(), lane.repeat_us.end());
      row.ratio_to_fcl_obbrss = median(lanes[1].repeat_us) / row.median_us;
      row.seed = options.seed;
      row.extent = scenes::extent(mesh);
      judge(mesh, geometry, query, frames, lane.answers, options.quick ? 5 : 20, row);
      rows.push_back(row);
    }
  }
  report.add(rows);
}

int frameCount(const Options& options) {
  constexpr int kFrames = 60;  // FCL takes up to 4 ms for one
  return options.frames > 0 ? options.frames : (options.quick ? 5 : kFrames);
}

scenes::Mesh torusOf(const Options& options) {
  return scenes::bumpyTorus(options.quick ? 2000 : 20000);
}

}  // namespace

void runShapes(const Options& options, Report& report) {
  const scenes::Mesh mesh = torusOf(options);
  const std::pair<const char*, Geometry> shapes[] = {
      {"sphere", std::make_shared<fcl::Sphered>(0.4)},
      {"box", std::make_shared<fcl::Boxd>(0.6, 0.5, 0.8)},
      {"cone", std::make_shared<fcl::Coned>(0.4, 0.8)},
      {"cylinder", std::make_shared<fcl::Cylinderd>(0.3, 0.8)},
      {"capsule", std::make_shared<fcl::Capsuled>(0.25, 0.6)},
      {"ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.3, 0.4, 0.5)},
      {"convex", convexOf(scenes::icosphere(0.4, 1))}};
  for (const auto& [shape, geometry] : shapes) {
    reportGeometry(std::string("shapes/") + shape, mesh, geometry, frameCount(options), options,
                   report);
  }
}

void runOctrees(const Options& options, Report& report) {
  reportGeometry("octrees/shell", torusOf(options), shellOctree(), frameCount(options), options,
                 report);
}

}  // namespace kios::bench
