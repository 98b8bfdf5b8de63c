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

#include "mesh_set.h"
#include "query/shape_solid.h"
#include "scenario.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "solid/triangle_shape.h"

namespace kios::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

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

  double operator()(Query query, const scenes::Frame& frame) const {
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
        const double enough = query == Query::kDistance ? nearest : 0;
        if (placed.radius > 0 &&
            (triangle[0] - placed.center).norm() - reach - placed.radius > enough) {
          continue;
        }
        shape::Triangle local = triangle;
        for (shape::Vec& corner : local) corner -= placed.center;
        if (query == Query::kDistance) {
          nearest = std::min(nearest, shape::distance(placed.solid, local, nearest).distance);
        } else if (shape::intersects(placed.solid, local)) {
          contacts += 1;
        }
      }
    }
    if (query == Query::kDistance) return nearest;
    return query == Query::kCollide ? std::min(contacts, 1.0) : contacts;
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

/// The mesh and the geometry at the frames of a query: apart for distances, touching or near for
/// contacts.
std::vector<Question> questionsOf(Query query, int count, std::uint64_t seed) {
  std::vector<Question> questions;
  for (const scenes::Frame& frame : query == Query::kDistance
                                        ? scenes::farMotion(count, 2.1, 4, seed)
                                        : scenes::farMotion(count, 0.4, 1.9, seed + 1)) {
    questions.push_back({0, 1, frame});
  }
  return questions;
}

/// Errors and wrong verdicts of a few answers.
Errors judge(const BruteForce& exact, Query query, const std::vector<Question>& questions,
             const std::vector<double>& answers, std::size_t count) {
  Errors errors;
  errors.wrong = 0;
  count = std::min(questions.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * questions.size() / count;
    const double truth = exact(query, questions[at].poses);
    if (query != Query::kDistance) {
      *errors.wrong += answers[at] == truth ? 0 : 1;
      continue;
    }
    *errors.wrong += (answers[at] > 0) == (truth > 0) ? 0 : 1;
    const double error = std::isfinite(answers[at]) ? std::abs(answers[at] - truth)
                                                    : std::numeric_limits<double>::infinity();
    errors.max_abs = std::max(errors.max_abs.value_or(0), error);
  }
  return errors;
}

void reportGeometry(const std::string& scenario, const scenes::Mesh& mesh, const Geometry& geometry,
                    int frames, const Options& options, Report& report) {
  const char* const volumes[] = {"kios", "fcl_obbrss"};
  std::vector<std::unique_ptr<MeshSet>> sets;
  for (const char* bv : volumes) {
    sets.push_back(makeMeshSet(bv));
    sets.back()->load({mesh});
    sets.back()->add(geometry);
  }
  const BruteForce exact(mesh, *geometry);
  Row base;
  base.scenario = scenario;
  base.triangles = mesh.triangles.size();
  base.frames = static_cast<std::size_t>(frames);
  base.seed = options.seed;
  base.extent = scenes::extent(mesh);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide, Query::kContacts}) {
    const std::vector<Question> questions = questionsOf(query, frames, options.seed);
    std::vector<std::vector<double>> answers(2, std::vector<double>(questions.size()));
    std::vector<Competitor> competitors;
    for (std::size_t i = 0; i < 2; ++i) {
      competitors.push_back({volumes[i], [&, i](std::size_t begin, std::size_t end) {
                               sets[i]->answer(query, questions, begin, end, answers[i]);
                             }});
    }
    Race{questions.size(), options.repeats, Race::kAll, Race::kAll, true}.run(competitors);
    base.query = name(query);
    for (std::size_t i = 0; i < 2; ++i) {
      rows.push_back(base.of(competitors[i], &competitors[1]));
      rows.back().errors = judge(exact, query, questions, answers[i], options.quick ? 5 : 20);
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
