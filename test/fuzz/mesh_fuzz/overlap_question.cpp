// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Local depths against signed distances of samples, each of which is a lower bound; findClashes()
// against queries of every pair.

#include <fcl/narrowphase/collision.h>
#include "fcl_kios/distance.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/points.h"
#include "fcl_kios/scene.h"
#include "fcl_kios/solids.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

struct Placed {
  std::shared_ptr<Modeld> model;
  Transform3d X;
};

/// Null, too, for what is too small to have a depth.
std::shared_ptr<Modeld> marked(const Mesh& mesh, bool foreign) {
  auto model = modelOf<double>(mesh, foreign);
  if (!(model->getBV(0).bv.radius0 > 1e-80)) return nullptr;
  return markIfSolid(*model) ? model : nullptr;
}

/// Returns the mesh as a solid, or tetrahedra on its first triangles, which may cross; null if
/// these enclose nothing.
std::shared_ptr<Modeld> solidOf(const Mesh& mesh, bool foreign, Random& random) {
  if (auto model = marked(mesh, foreign)) return model;
  Mesh solid;
  const auto most = static_cast<std::size_t>(scenes::integer(random, 1, 6));
  for (std::size_t t = 0; t < std::min(mesh.triangles.size(), most); ++t) {
    const fcl::Triangle& ids = mesh.triangles[t];
    const Vector3d &p = mesh.vertices[ids[0]], &q = mesh.vertices[ids[1]],
                   &r = mesh.vertices[ids[2]];
    Vector3d n = (q - p).cross(r - p);
    if (!(n.stableNorm() > 0)) continue;
    n.stableNormalize();
    const std::size_t v = solid.vertices.size();
    const double height = (q - p).norm() * power(random, -6, 0);
    solid.vertices.insert(solid.vertices.end(), {p, q, r, p + height * n});
    for (const fcl::Triangle& side : {fcl::Triangle(v, v + 2, v + 1),
                                      {v, v + 1, v + 3},
                                      {v + 1, v + 2, v + 3},
                                      {v + 2, v, v + 3}}) {
      solid.triangles.push_back(side);
    }
  }
  return solid.triangles.empty() ? nullptr : marked(solid, foreign);
}

/// Bounds what rounding of coordinates and poses does to depths and distances (solids.h), by
/// `of_skew` times the errors of rotations.
double toleranceOf(const Placed& a, const Placed& b, double of_skew = 400) {
  double most = 0, skew = 0;
  for (const Placed* part : {&a, &b}) {
    for (int i = 0; i < part->model->num_vertices; ++i) {
      most = std::max(most, part->model->vertices[i].stableNorm());
    }
    most = std::max(most, part->X.translation().stableNorm());
    skew += skewOf(part->X);
  }
  return (2e-11 + of_skew * skew) * most + 1e-300;
}

/// Negative inside. Walls within a union count, so that no depth is too large.
double signedDistanceTo(const Placed& solid, const Vector3d& p) {
  PointRequest request;
  request.X_WM = solid.X;
  return signedDistance(*solid.model, p, request);
}

/// Returns how deep a sample of a's surface lies in b, or a ball near it in both; 0 for a sample of
/// a wall within a, but for 4 tolerances.
double depthOfSample(const Placed& a, const Placed& b, double reach, double tolerance,
                     Random& random) {
  const fcl::Triangle& t = a.model->tri_indices[below(random, a.model->num_tris)];
  const Vector3d &p = a.model->vertices[t[0]], &q = a.model->vertices[t[1]],
                 &r = a.model->vertices[t[2]];
  double u = chance(random, 0.3) ? below(random, 2) : random.unit();
  double v = chance(random, 0.3) ? 0 : random.unit();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Vector3d x = a.X * Vector3d((1 - u - v) * p + u * q + v * r);
  if (chance(random, 0.3)) {
    const Vector3d middle = x + reach * random.uniform(0, 2) * scenes::direction(random);
    return -std::max(signedDistanceTo(a, middle), signedDistanceTo(b, middle));
  }
  Vector3d n = (q - p).cross(r - p);
  if (!(n.stableNorm() > 0)) return 0;  // it may belong to no solid
  n = 4 * tolerance * (a.X.linear() * n.stableNormalized()).eval();
  const bool wall =
      contains(*a.model, a.X, Vector3d(x + n)) && contains(*a.model, a.X, Vector3d(x - n));
  return wall ? 0 : -signedDistanceTo(b, x);
}

Verdict faultOfDepth(const LocalDepthResult& found, const LocalDepthRequest& request,
                     const Placed& a, const Placed& b, const std::string& call, Random& random) {
  const double tolerance = toleranceOf(a, b);
  const bool told = request.threshold >= 0 && (found.lower > request.threshold ||
                                               found.upper <= request.threshold + tolerance);
  const bool narrow =
      found.upper - found.lower <= request.rel_err * found.upper + toleranceOf(a, b, 2000);
  if (!(found.lower >= 0 && found.lower <= found.upper) || (found.complete && !told && !narrow)) {
    return failure(
        Words() << found.lower << " to " << found.upper << ", complete " << found.complete, call);
  }
  for (int k = 0; k < 600; ++k) {
    const double depth = k % 2 == 0 ? depthOfSample(a, b, found.upper, tolerance, random)
                                    : depthOfSample(b, a, found.upper, tolerance, random);
    if (depth <= found.upper + 5 * tolerance) continue;
    return failure(Words() << "a point is " << depth << " deep, the bound " << found.upper, call);
  }
  if (!(found.lower > tolerance)) return std::nullopt;
  const Eigen::Map<const Vector3d> p(found.point), q(found.nearest);
  if (!(std::abs((p - q).norm() - found.lower) <= 4 * tolerance)) {
    return failure(Words() << "points are " << (p - q).norm() << " apart, not " << found.lower,
                   call);
  }
  for (const int i : {1, 2}) {
    const double d = signedDistanceTo(i == 1 ? a : b, p);
    if (found.surface_of == i ? std::abs(d) <= tolerance : -d >= found.lower - tolerance) continue;
    return failure(Words() << "the point of " << found.lower << ", of surface " << found.surface_of
                           << ", is " << d << " from solid " << i,
                   call);
  }
  return std::nullopt;
}

/// Returns what is wrong with the answer, or the lack of one, for two parts.
std::string faultOfPair(const Placed& a, const Placed& b, const ClashRequest& request,
                        const ClashResult* clash) {
  const double tolerance = toleranceOf(a, b), touch = request.touch;
  const double reach = std::max(touch, request.clearance);
  const auto apart = distanceBracket(*a.model, a.X, *b.model, b.X);
  const auto collide = [&](const Transform3d& X_WB) {
    fcl::CollisionResultd result;
    return fcl::collide(a.model.get(), a.X, b.model.get(), X_WB, {}, result) > 0;
  };
  const bool solids = isSolid(*a.model) && isSolid(*b.model), far = apart.lower_bound > tolerance;
  const bool contained = solids && far && collide(b.X);
  LocalDepthRequest brief;
  brief.rel_err = 0.1;
  brief.max_pieces = 500;
  const auto depth = solids ? localDepth(*a.model, a.X, *b.model, b.X, brief) : LocalDepthResult();
  if (!clash)
    return apart.upper_bound < reach - tolerance || contained ? "the pair is missing" : "";
  if (!(clash->lower >= 0 && clash->lower <= clash->upper)) return "a bracket of nothing";
  if (clash->status == ClashStatus::kDuplicate) {
    if (a.model->num_vertices != b.model->num_vertices) return "unlike parts";
    for (int v = 0; v < a.model->num_vertices; ++v) {
      const Vector3d between = a.X * a.model->vertices[v] - b.X * b.model->vertices[v];
      if (!(between.stableNorm() <= touch + tolerance)) return "parts at two places";
    }
    return "";
  }
  const double lower = !clash->deep ? apart.lower_bound : depth.lower,
               upper = !clash->deep ? apart.upper_bound
                       : solids     ? depth.upper
                                    : clash->upper;
  if (!(clash->lower <= upper + tolerance && clash->upper >= lower - tolerance)) {
    return "the bracket isn't that of the pair";
  }
  const Eigen::Map<const Vector3d> way(clash->way_out);
  // Rotations to a few digits turn the way itself.
  if (way.norm() > 1e9 * tolerance && collide(Eigen::Translation3d(way) * b.X)) return "no way out";
  const bool deep = depth.lower > touch + tolerance;
  switch (clash->status) {
    case ClashStatus::kInside:
      return apart.upper_bound == 0 || (solids && far && !contained) ? "it isn't inside" : "";
    case ClashStatus::kOverlap:
      return solids && clash->decided && depth.upper < touch - tolerance ? "it isn't deep" : "";
    case ClashStatus::kTouch:
      return deep || (clash->decided && !contained && apart.lower_bound > touch + tolerance)
                 ? "it doesn't touch"
                 : "";
    default:
      return deep || contained || apart.upper_bound < touch - tolerance ||
                     apart.lower_bound > reach + tolerance
                 ? "clearance isn't what it lacks"
                 : "";
  }
}

}  // namespace

Verdict askDepth(const Case& c) {
  Random random(c.draw);
  const Placed a = {solidOf(c.meshes[0], c.foreign, random), c.pose(0)},
               b = {solidOf(c.meshes[1], c.foreign, random), c.pose(1)};
  if (!a.model || !b.model) return std::nullopt;
  LocalDepthRequest request;
  request.rel_err = chance(random, 0.3) ? 0 : power(random, -4, -0.3);
  request.max_pieces = chance(random, 0.3) ? below(random, 30) : 1000;
  std::string call = "localDepth with rel_err " + literal(request.rel_err) + ", max_pieces " +
                     std::to_string(request.max_pieces);
  const auto found = localDepth(*a.model, a.X, *b.model, b.X, request),
             reversed = localDepth(*b.model, b.X, *a.model, a.X, request);
  if (found.lower != reversed.lower || found.upper != reversed.upper ||
      found.surface_of != (3 - reversed.surface_of) % 3 ||
      !std::equal(found.point, found.point + 3, reversed.point)) {
    return failure(Words() << found.lower << " to " << found.upper << ", reversed "
                           << reversed.lower << " to " << reversed.upper,
                   call);
  }
  if (auto wrong = faultOfDepth(found, request, a, b, call, random)) return wrong;
  request.threshold = chance(random, 0.3) ? 0 : found.upper * random.uniform(0, 1.5);
  call += ", threshold " + literal(request.threshold);
  return faultOfDepth(localDepth(*a.model, a.X, *b.model, b.X, request), request, a, b, call,
                      random);
}

Verdict askClashes(const Case& c) {
  Random random(c.draw);
  std::vector<ClashPart> parts;
  std::vector<Placed> placed;
  double size = 0;
  for (std::size_t i = 0; i < c.meshes.size(); ++i) {
    Placed of = {solidOf(c.meshes[i], c.foreign, random), c.pose(i)};
    if (!of.model || chance(random, 0.3)) of.model = modelOf<double>(c.meshes[i], c.foreign);
    ClashPart& part = parts.emplace_back();
    part.geometry = of.model;
    part.X_WP = of.X;
    part.name = std::to_string(i);
    size = std::max(size, double{of.model->getBV(0).bv.radius0});
    placed.push_back(std::move(of));
  }
  ClashRequest request;
  request.touch = chance(random, 0.2) ? 0 : size * power(random, -12, 0);
  if (chance(random, 0.6)) request.clearance = request.touch * power(random, 0, 6);
  request.max_pieces = 1000;
  const std::string call = "findClashes with touch " + literal(request.touch) + ", clearance " +
                           literal(request.clearance);
  const std::vector<ClashResult> found = findClashes(parts, request);
  std::size_t at = 0;
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      const bool listed = at < found.size() && found[at].a == a && found[at].b == b;
      const ClashResult* const clash = listed ? &found[at] : nullptr;
      const std::string fault = faultOfPair(placed[a], placed[b], request, clash);
      if (!fault.empty()) {
        return failure(Words() << "parts " << a << " and " << b << ": " << fault, call);
      }
      at += listed ? 1 : 0;
    }
  }
  if (at < found.size()) return failure(Words() << "a pair too many, or out of order", call);
  return std::nullopt;
}

}  // namespace kios::fuzz
