// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fcl_kios/distance.h"
#include "fcl_kios/points.h"
#include "fcl_kios/repair.h"
#include "fcl_kios/scene.h"
#include "fcl_kios/solids.h"
#include "model/shape_values.h"
#include "query/threads.h"
#include "scene/box.h"
#include "scene/part_mesh.h"
#include "shape/shape_solid.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using scene::Box;
using scene::meshOfPart;

/// Bounds the rounding of R x + T, whose terms are at most `length` in all, by 16 eps of that,
/// which is more than frameError(); of what maps it into another part's frame (points.h), by 2^-48
/// of it; and 16 eps for the distance there.
double roundingAt(double length) { return 0x1p-47 * length; }

void set(double (&to)[3], const fcl::Vector3d& p) { std::copy_n(p.data(), 3, to); }

/// Ends a search for a depth whose status is settled: inner walls may keep its bracket open.
constexpr long long kMostPieces = 10000;

/// Squares of tiny coordinates vanish.
double lengthOf(const fcl::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  const fcl::Vector3d unit = largest > 0 ? fcl::Vector3d(v / largest) : v;
  return largest * std::sqrt(detail::dot<double>(unit, unit));
}

struct PlacedPart {
  PlacedPart(std::shared_ptr<const Modeld> of, const fcl::Transform3d& pose)
      : owned(std::move(of)), model(*owned), X_W(pose), solid(markOf(model) != nullptr) {
    if (solid) markOf(model)->check();
    std::fill_n(box.lower, 3, kInfinity);
    std::fill_n(box.upper, 3, -kInfinity);
    for (int i = 0; i < model.num_vertices; ++i) {
      const fcl::Vector3d p = vertex(i);
      length = std::max(length, model.vertices[i].lpNorm<1>());
      for (int c = 0; c < 3; ++c) {
        box.lower[c] = std::min(box.lower[c], p[c]);
        box.upper[c] = std::max(box.upper[c], p[c]);
      }
    }
    length = 2 * length + X_W.translation().lpNorm<1>();
    for (int c = 0; c < 3; ++c) {
      box.lower[c] -= roundingAt(length);
      box.upper[c] += roundingAt(length);
    }
  }

  fcl::Vector3d vertex(int i) const { return detail::transform<double>(X_W, model.vertices[i]); }

  /// Places the corners of triangles, once.
  void placeCorners() {
    if (!corners.empty()) return;
    std::vector<bool> used(static_cast<std::size_t>(model.num_vertices));
    for (int t = 0; t < model.num_tris; ++t) {
      for (int c = 0; c < 3; ++c) used[model.tri_indices[t][c]] = true;
    }
    for (int i = 0; i < model.num_vertices; ++i) {
      if (used[static_cast<std::size_t>(i)]) corners.push_back(vertex(i));
    }
  }

  const std::shared_ptr<const Modeld> owned;
  const Modeld& model;
  const fcl::Transform3d X_W;
  const bool solid;
  std::vector<fcl::Vector3d> corners;  ///< in the world, of surfaces that come near a solid
  Box box;                             ///< around all vertices, in the world
  double length = 0;                   ///< of what is added up where a vertex is placed
};

class ClashSearch {
 public:
  ClashSearch(const std::vector<PlacedPart>& parts, const ClashRequest& request)
      : parts_(parts), request_(request), reach_(std::max(request.touch, request.clearance)) {}

  bool boxesNear(std::size_t a, std::size_t b) const {
    return !(scene::squaredGap(parts_[a].box, parts_[b].box) > scene::squaredLimit(reach_));
  }

  std::optional<ClashResult> judge(std::size_t i, std::size_t j) const {
    const PlacedPart &a = parts_[i], &b = parts_[j];
    ClashResult clash;
    clash.a = i;
    clash.b = j;
    if (areDuplicates(a, b, clash)) return clash;
    DistanceBracketRequestd request;
    request.far_enough = std::nextafter(reach_, kInfinity);
    const DistanceBracketResultd near = distanceBracket(a.model, a.X_W, b.model, b.X_W, request);
    const bool far = near.stop == DistanceStop::kFar;
    if (!far) {
      set(clash.point_a, near.point_a);
      set(clash.point_b, near.point_b);
    }
    const bool meet = near.distance == 0;
    if (meet || scene::squaredGap(a.box, b.box) == 0) {
      if (a.solid && b.solid ? judgeSolids(a, b, meet, clash)
                             : judgeSurfaces(a, b, near.lower_bound, meet, clash)) {
        return clash;
      }
    }
    if (far) return std::nullopt;
    clash.lower = near.lower_bound;
    clash.upper = near.upper_bound;
    // The worse one, where rounding leaves it open.
    const bool touch = meet || clash.upper <= request_.touch ||
                       (request_.clearance == 0 && clash.lower <= request_.touch);
    clash.status = touch ? ClashStatus::kTouch : ClashStatus::kClearance;
    clash.decided = meet || (touch ? clash.upper <= request_.touch
                                   : clash.lower > request_.touch && clash.upper <= reach_);
    return clash;
  }

 private:
  bool areDuplicates(const PlacedPart& a, const PlacedPart& b, ClashResult& clash) const {
    const Modeld &p = a.model, &q = b.model;
    if (p.num_vertices != q.num_vertices || p.num_tris != q.num_tris) return false;
    double apart = 0;
    int farthest = 0;
    bool same = a.X_W.matrix() == b.X_W.matrix();
    for (int i = 0; i < p.num_vertices; ++i) {
      const fcl::Vector3d between = a.vertex(i) - b.vertex(i);
      const double d = lengthOf(between);
      if (!(d <= request_.touch)) return false;
      if (d > apart) farthest = i;
      apart = std::max(apart, d);
      same = same && p.vertices[i] == q.vertices[i];
    }
    for (int t = 0; t < p.num_tris; ++t) {
      for (int c = 0; c < 3; ++c) {
        if (p.tri_indices[t][c] != q.tri_indices[t][c]) return false;
      }
    }
    const double rounding = same ? 0 : roundingAt(a.length + b.length);
    clash.status = ClashStatus::kDuplicate;
    clash.lower = std::max(0.0, apart - rounding);
    clash.upper = apart + rounding;
    clash.decided = clash.upper <= request_.touch;
    set(clash.point_a, a.vertex(farthest));
    set(clash.point_b, b.vertex(farthest));
    return true;
  }

  /// Returns true if a solid has no cavity in another, all of whose surface lies in it. Around that
  /// surface the solid winds once at least, and within it as often and as its components there do:
  /// not less often where none winds inwards and none cuts itself.
  static bool fills(const PlacedPart& solid, const Contained& there) {
    return !there.some || (!there.inwards && selfIntersections(solid.model, 1).empty());
  }

  /// Judges solids whose surfaces meet, or of which one may lie in the other. Returns false if the
  /// distance is what counts.
  bool judgeSolids(const PlacedPart& a, const PlacedPart& b, bool meet, ClashResult& clash) const {
    bool inside = false;
    if (!meet) {
      const MeshPair frame(meshOf(a.model), a.X_W, meshOf(b.model), b.X_W);
      if (frame.rootBound(0) > 0) return false;
      const auto [of_a, of_b] = containedComponents(frame);
      if (!of_a.some && !of_b.some) return false;
      inside = (of_a.all && fills(b, of_b)) || (of_b.all && fills(a, of_a));
    }
    clash.deep = true;
    const double size = meshOf(a.model).radius() + meshOf(b.model).radius();
    if (!(size >= 0x1p-300 && size <= 0x1p300)) {  // penetration() has no answer
      clash.status = inside ? ClashStatus::kInside : ClashStatus::kOverlap;
      clash.upper = kInfinity;
      clash.decided = inside;
      return true;
    }
    // What moves one out of the other moves each point and ball that is in both, and so is as long
    // as they are deep: that settles nearly all touches, and is quick.
    const PenetrationResult exit = penetration(a.model, a.X_W, b.model, b.X_W);
    const double most = exit.upper + roundingAt(a.length + b.length);
    if (!inside && (most <= request_.touch || exit.upper == 0)) {
      clash.upper = most;
      clash.status = ClashStatus::kTouch;
      return true;
    }
    LocalDepthRequest request;
    request.threshold = request_.touch;
    request.max_pieces = request_.max_pieces;
    LocalDepthResult depth = localDepth(a.model, a.X_W, b.model, b.X_W, request);
    const bool overlap = depth.lower > request_.touch;
    clash.lower = depth.lower;
    clash.upper = std::min(depth.upper, most);
    if (inside || overlap) {
      request.threshold = -1;
      request.max_pieces = std::min(kMostPieces, request_.max_pieces);
      depth = localDepth(a.model, a.X_W, b.model, b.X_W, request);
      clash.lower = std::max(clash.lower, depth.lower);
      clash.upper = std::min(clash.upper, depth.upper);
    }
    clash.decided = inside || overlap || clash.upper <= request_.touch;
    clash.status = inside                      ? ClashStatus::kInside
                   : overlap || !clash.decided ? ClashStatus::kOverlap
                                               : ClashStatus::kTouch;
    if (!meet) {
      set(clash.point_a, exit.point);
      set(clash.point_b, exit.point);
    }
    if (depth.lower > 0) {
      const bool of_b = depth.surface_of == 2;
      std::copy_n(of_b ? depth.nearest : depth.point, 3, clash.point_a);
      std::copy_n(of_b ? depth.point : depth.nearest, 3, clash.point_b);
    }
    if (clash.status != ClashStatus::kTouch) set(clash.way_out, exit.translation);
    return true;
  }

  /// Does so where one has no inside, at least. The surface of such a one goes on as far as its
  /// corners tell, and perhaps farther.
  bool judgeSurfaces(const PlacedPart& a, const PlacedPart& b, double apart, bool meet,
                     ClashResult& clash) const {
    std::size_t within = 0, without = 0, unclear = 0;
    double deepest = 0;
    if (a.solid != b.solid) {
      const PlacedPart &solid = a.solid ? a : b, &open = a.solid ? b : a;
      const double error = roundingAt(a.length + b.length);
      PointRequest request;
      request.X_WM = solid.X_W;
      std::vector<fcl::Vector3d> corners;  // that may lie in the solid
      std::copy_if(open.corners.begin(), open.corners.end(), std::back_inserter(corners),
                   [&box = solid.box](const fcl::Vector3d& p) {
                     const Eigen::Map<const fcl::Vector3d> low(box.lower), high(box.upper);
                     return (low.array() <= p.array()).all() && (p.array() <= high.array()).all();
                   });
      without = open.corners.size() - corners.size();
      const Eigen::Map<const Eigen::Matrix3Xd> points(corners.empty() ? nullptr : corners[0].data(),
                                                      3, static_cast<Eigen::Index>(corners.size()));
      Eigen::VectorXd distances(points.cols());
      signedDistances(solid.model, points, distances, request);
      Eigen::Index at = 0;
      if (points.cols() > 0) deepest = std::max(0.0, -distances.minCoeff(&at) - error);
      for (const double d : distances) ++(d < -error ? within : d > error ? without : unclear);
      if (!meet && within == 0 && unclear == 0) return false;
      if (points.cols() > 0 && (deepest > 0 || !meet)) {
        Eigen::VectorXd distance(1);
        Eigen::Matrix3Xd nearest(3, 1);
        Eigen::VectorXi triangle(1);
        nearestPoints(solid.model, points.col(at), distance, nearest, triangle, request);
        set(a.solid ? clash.point_b : clash.point_a, points.col(at));
        set(a.solid ? clash.point_a : clash.point_b, nearest);
      }
    }
    if (!meet && a.solid == b.solid) return false;
    clash.deep = true;
    clash.lower = deepest;
    clash.upper = kInfinity;
    const bool inside = !meet && without == 0;
    clash.status = inside ? ClashStatus::kInside : ClashStatus::kOverlap;
    clash.decided = inside ? apart > 0 && unclear == 0 : deepest > request_.touch;
    return true;
  }

  const std::vector<PlacedPart>& parts_;
  const ClashRequest& request_;
  const double reach_;
};

/// Calls what(), and names the parts in what it throws.
template <typename Call>
auto naming(const std::string& parts, const Call& call) {
  try {
    return call();
  } catch (const std::invalid_argument& error) {
    const std::string said = error.what(), ours = "fcl_kios: ";
    refuse(parts, ": ", said.rfind(ours, 0) == 0 ? said.substr(ours.size()) : said);
  }
}

std::string quotedName(const ClashPart& part) { return "'" + part.name + "'"; }

void requireLengths(const ClashRequest& request) {
  const auto isLength = [](double x) { return x >= 0 && x < kInfinity; };
  require(isLength(request.touch), "ClashRequest::touch", request.touch, "finite and >= 0");
  require(isLength(request.clearance), "ClashRequest::clearance", request.clearance,
          "finite and >= 0");
  require(request.max_pieces >= 0, "ClashRequest::max_pieces", request.max_pieces, ">= 0");
  if (request.clearance > 0 && request.touch > request.clearance) {
    refuse("ClashRequest::touch is ", request.touch, ", more than the clearance, ",
           request.clearance, ".");
  }
}

}  // namespace

// The scene finds the pairs whose boxes are near, by its tree; the filter notes them, and spares
// the scene's own search.
std::vector<ClashResult> findClashes(const std::vector<ClashPart>& parts,
                                     const ClashRequest& request) {
  requireLengths(request);
  const std::size_t threads = threadsFor(request.threads);
  SceneDistanced scene;
  std::vector<PlacedPart> placed;
  placed.reserve(parts.size());
  std::unordered_map<std::string, int> ids;
  // Equal shapes share a mesh: 64,000 boxes took 5 s without, 0.5 s as one.
  std::map<std::pair<fcl::NODE_TYPE, std::vector<double>>, std::shared_ptr<const Modeld>> shapes;
  for (const ClashPart& part : parts) {
    naming("part " + quotedName(part), [&] {
      std::shared_ptr<const Modeld> own;
      const auto* const g = part.geometry.get();
      const bool is_shape = g && isShape(*g);
      if (is_shape) toSolid(*g);  // refuses sizes that are none: NaN is no key
      auto& mesh = is_shape ? shapes[{g->getNodeType(), shapeValues(*g)}] : own;
      if (!mesh) mesh = meshOfPart(part.geometry);
      const int id = scene.add(mesh, fcl::Transform3d(part.X_WP));
      if (!ids.emplace(part.name, id).second) refuse("another part has this name.");
      placed.emplace_back(mesh, fcl::Transform3d(part.X_WP));
    });
  }
  for (const auto& pair : request.ignored) {
    const std::string &a = pair.first, &b = pair.second;
    for (const std::string& name : {a, b}) {
      if (ids.count(name) == 0) refuse("'", name, "', to be ignored, is no part.");
    }
    naming("'" + a + "'", [&] { scene.ignorePair(ids.at(a), ids.at(b)); });
  }

  const ClashSearch search(placed, request);
  std::vector<std::pair<int, int>> pairs;
  scene.setFilter([&](int a, int b) {
    if (request.between_groups && parts[a].group == parts[b].group) return false;
    if (!search.boxesNear(a, b)) return false;
    if (pairs.size() >= request.max_pairs) {
      refuse("more than ", request.max_pairs, " pairs of parts come near each other, the last ",
             quotedName(parts[a]), " and ", quotedName(parts[b]), "; see ClashRequest::max_pairs.");
    }
    pairs.emplace_back(a, b);
    return false;
  });
  scene.pairsWithin(std::max(request.touch, request.clearance));
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [a, b] : pairs) {
    if (placed[a].solid != placed[b].solid) placed[placed[a].solid ? b : a].placeCorners();
  }

  constexpr std::size_t kShare = 64;
  std::vector<std::vector<ClashResult>> found((pairs.size() + kShare - 1) / kShare);
  inThreads(found.size(), threads, [&](std::size_t share) {
    const std::size_t end = std::min((share + 1) * kShare, pairs.size());
    for (std::size_t i = share * kShare; i < end; ++i) {
      const auto [a, b] = pairs[i];
      const auto clash = naming("parts " + quotedName(parts[a]) + " and " + quotedName(parts[b]),
                                [&, a = a, b = b] { return search.judge(a, b); });
      if (clash) found[share].push_back(*clash);
    }
  });
  std::vector<ClashResult> clashes;
  for (const auto& share : found) clashes.insert(clashes.end(), share.begin(), share.end());
  return clashes;
}

}  // namespace kios
