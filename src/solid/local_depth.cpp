// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fcl_kios/solids.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/convex_piece.h"
#include "solid/depth_in_solid.h"
#include "solid/solid_pair.h"
#include "solid/tuning.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

void requireValid(const LocalDepthRequest& request) {
  require(request.tolerance >= 0, "LocalDepthRequest::tolerance", request.tolerance, ">= 0");
  require(request.rel_err >= 0 && request.rel_err < 1, "LocalDepthRequest::rel_err",
          request.rel_err, "in [0, 1)");
  require(request.max_pieces >= 0, "LocalDepthRequest::max_pieces", request.max_pieces, ">= 0");
  require(!std::isnan(request.threshold), "LocalDepthRequest::threshold", request.threshold,
          "a number");
}

/// A part of a's surface, of b's, or of space, and how deep what counts of it is at most.
struct Piece {
  enum Kind { kOfA = 0, kOfB = 1, kSpace = 2 };
  double bound;
  Kind kind;
  int node;  ///< of the surface's tree, in the shape if it has one; -1: it is the shape
  ConvexPiece shape;
  std::array<Vec, 2> out;  ///< of a and of b, from its centre
  int cuts = 0;            ///< that made it
  bool halved = true;      ///< by the last of them

  bool operator<(const Piece& o) const { return bound < o.bound; }
};

/// Bounds the errors of points in the common frame and in either solid's, of kMostCuts cuts, and of
/// the distances there.
double roundingOf(const SolidPair& pair) {
  const Mesh &a = pair.a(), &b = pair.b();
  const RelativePose<double>& X = pair.frame().X_AB;
  const double norm1 = a.center().lpNorm<1>() + 2 * a.radius() + b.center().lpNorm<1>() +
                       2 * b.radius() + detail::boundsOf(X).T_norm1;
  return 2 * inverseError(X, norm1) + 2 * pair.rounding() + 0x1p-45 * norm1;
}

constexpr int kMostCuts = 64;  ///< of a piece

/// Such triangles belong to no solid.
bool isPoint(const TriangleVerticesd& t) { return t[0] == t[1] && t[1] == t[2]; }

/// Best first over pieces: what may be deepest is cut.
class DepthSearch {
 public:
  DepthSearch(SolidPair& pair, double rounding, const LocalDepthRequest& request)
      : pair_(pair),
        request_(request),
        rounding_(rounding),
        solids_{DepthInSolid(pair.a(), {Eigen::Matrix3d::Identity(), Vec::Zero()}, rounding_),
                DepthInSolid(pair.b(), pair.frame().X_AB, rounding_)} {}

  /// In the common frame, from triangles that meet on.
  LocalDepthResult run(const std::vector<engine::TrianglePairIds>& contacts) {
    for (const engine::TrianglePairIds& ids : contacts) {
      const TriangleVerticesd of_a = solids_[0].triangle(ids.a), of_b = solids_[1].triangle(ids.b);
      if (isPoint(of_a) || isPoint(of_b)) continue;
      for (const Vec& p : of_a) look(Piece::kOfA, p);
      for (const Vec& p : of_b) look(Piece::kOfB, p);
    }
    addNode(Piece::kOfA, 0);
    addNode(Piece::kOfB, 0);
    addCommonBox();
    // Depths to walls don't bound from above, so that few brackets close.
    const bool walls = solids_[0].hasWalls() || solids_[1].hasWalls();
    const long long most =
        walls ? std::min(tuning::kMostWithWalls, request_.max_pieces) : request_.max_pieces;
    long long looks = 0, try_at = 0;
    while (!waiting_.empty() && waiting_.front().bound > enough() && !exceedsThreshold()) {
      const long long spent = looks + visits_ / tuning::kVisitsPerPiece;
      if (spent >= most) break;
      if (spent >= try_at) {
        if (areApartSoon()) {
          waiting_.clear();
          break;
        }
        try_at = tuning::kTryLater * (spent + 1);
      }
      ++looks;
      std::pop_heap(waiting_.begin(), waiting_.end());
      const Piece piece = std::move(waiting_.back());
      waiting_.pop_back();
      open(piece);
    }
    result_.upper = std::max(result_.lower, left_out_);
    if (!waiting_.empty()) result_.upper = std::max(result_.upper, waiting_.front().bound);
    result_.complete = result_.upper <= enough() || exceedsThreshold();
    return result_;
  }

 private:
  /// An upper bound that the request is content with.
  double enough() const {
    const double lower = result_.lower;
    return std::max({lower + request_.tolerance, lower / (1 - request_.rel_err),
                     lower + 16 * rounding_, request_.threshold});
  }
  bool exceedsThreshold() const {
    return request_.threshold >= 0 && result_.lower > request_.threshold;
  }

  const DepthInSolid& own(Piece::Kind kind) const { return solids_[kind]; }
  const DepthInSolid& other(Piece::Kind kind) const { return solids_[1 - kind]; }

  void leaveOut(double bound) { left_out_ = std::max(left_out_, bound); }
  void add(Piece piece) {
    if (piece.bound <= enough()) return leaveOut(piece.bound);
    waiting_.push_back(std::move(piece));
    std::push_heap(waiting_.begin(), waiting_.end());
  }

  void addNode(Piece::Kind kind, std::uint32_t node) {
    const PosedTree& tree = own(kind).tree();
    const double radius = tree.radius(node) + own(kind).treeError();
    const Depth depth = other(kind).depthOf(tree.center(node));
    add({depth.upper + radius,
         kind,
         static_cast<int>(node),
         own(kind).boxOf(node),
         {depth.out, depth.out}});
  }

  void addCommonBox() {
    const Mesh &a = pair_.a(), &b = pair_.b();
    const Vec center_b = pair_.frame().X_AB * b.center();
    const double radius_a = a.radius() + solids_[0].treeError(),
                 radius_b = b.radius() + solids_[1].treeError();
    const Vec low = (a.center().array() - radius_a).max(center_b.array() - radius_b),
              high = (a.center().array() + radius_a).min(center_b.array() + radius_b);
    const Vec half = 0.5 * (high - low);
    if (!(half.minCoeff() >= 0)) return;  // nothing is common
    Piece piece = {0, Piece::kSpace, -1, {low + half, fcl::Matrix3d::Identity(), half}, {}};
    addShape(std::move(piece));
  }

  /// Sets the bound of a piece that is its shape, by the depth of its centre.
  void addShape(Piece piece) {
    const Vec& c = piece.shape.center();
    double upper = 0;
    if (piece.kind == Piece::kSpace) {
      const Depth a = solids_[0].depthOf(c), b = solids_[1].depthOf(c);
      const Depth& least = a.lower < b.lower ? a : b;
      raiseLower(piece.kind, c, least.lower, least.nearest);
      upper = std::min(a.upper, b.upper);
      piece.out = {a.out, b.out};
    } else {
      const Depth depth = look(piece.kind, c);
      upper = depth.upper;
      piece.out = {depth.out, depth.out};
    }
    piece.bound = upper + piece.shape.radius() + rounding_;
    add(std::move(piece));
  }

  void open(const Piece& piece) {
    std::optional<Cut> plane;
    if (!piece.shape.isEmpty() && isDone(piece, plane)) return;
    if (piece.node >= 0) return openNode(piece);
    if (piece.cuts == kMostCuts) return leaveOut(piece.bound);
    // What is much larger than deep is cut where it meets the other; else its bound follows from
    // its size. Never along planes alone, of which many may cut off little.
    const bool along = plane && piece.halved && piece.shape.radius() > tuning::kLarge * enough();
    auto parts = along ? piece.shape.cut(plane->n, plane->offset) : piece.shape.halves();
    for (ConvexPiece* const part : {&parts.first, &parts.second}) {
      if (part->isEmpty()) continue;
      addShape({0, piece.kind, -1, std::move(*part), {}, piece.cuts + 1, !along});
    }
  }

  void openNode(const Piece& piece) {
    const PosedTree& tree = own(piece.kind).tree();
    const auto node = static_cast<std::uint32_t>(piece.node);
    if (!tree.isLeaf(node)) {
      tree.forChildren(node, [&](std::uint32_t child) { addNode(piece.kind, child); });
      return;
    }
    tree.anyTriangle(node, [&](std::uint32_t t) {
      const TriangleVerticesd triangle = own(piece.kind).triangle(static_cast<int>(t));
      if (!isPoint(triangle)) addShape({0, piece.kind, -1, ConvexPiece(triangle), {}});
      return false;
    });
  }

  /// Returns true if a move by no more than enough, as the deepest point leaves, parts the solids:
  /// no point is deeper then. It is rounded as poses in the world are.
  bool areApartSoon() {
    if (!(result_.lower > 0) || result_.surface_of == 0) return false;
    const Vec way = Eigen::Map<const Vec>(result_.nearest) - Eigen::Map<const Vec>(result_.point);
    const double length = enough() - 5 * rounding_, norm = way.norm();
    if (!(norm > 16 * rounding_)) return false;
    const double share = (result_.surface_of == 1 ? -length : length) / norm;
    const Separation after = pair_.test(pair_.inWorld(share * way), 0);
    const double bound = after.moved + 4 * rounding_;
    if (!after.apart || !(bound <= enough())) return false;
    leaveOut(bound);
    return true;
  }

  /// Returns true if nothing of a piece is deeper than enough: moved by no more than that it is
  /// out of the other solid, or of one if it is space. The way of each point that was inside leads
  /// through the surface.
  bool isDone(const Piece& piece, std::optional<Cut>& plane) {
    if (piece.kind == Piece::kSpace) {
      return leaves(1, piece, {piece.out[1], Vec::Zero()}, plane) ||
             leaves(0, piece, {piece.out[0], Vec::Zero()}, plane);
    }
    const int solid = piece.kind == Piece::kOfA ? 1 : 0;
    if (piece.node >= 0) return leaves(solid, piece, {piece.out[0], Vec::Zero()}, plane);
    // The deepest corner may be that farthest from the way out.
    const Vec* deepest = nullptr;
    piece.shape.forCorners([&](const Vec& p) {
      if (!deepest || piece.out[0].dot(p - *deepest) < 0) deepest = &p;
    });
    const Vec from_corner = look(piece.kind, *deepest).out;
    return leaves(solid, piece, {from_corner, piece.out[0], -piece.shape.normal(), Vec::Zero()},
                  plane);
  }
  bool leaves(int solid, const Piece& piece, std::initializer_list<Vec> ways,
              std::optional<Cut>& plane) {
    const double length = enough() - 4 * rounding_;
    // Where walls meet, a way out through one slides along the others: away from these, too.
    const bool out = std::any_of(ways.begin(), ways.end(), [&](Vec way) {
      for (int walls = 0; walls < 3; ++walls) {
        Vec blocker = Vec::Zero();
        if (solids_[solid].isOutside(piece.shape, length * way, plane, blocker, visits_)) {
          return true;
        }
        if (plane || blocker.isZero(0)) break;
        const Vec turned = way + blocker;
        if (!(turned.norm() > 0.5)) break;
        way = turned.normalized();
      }
      return false;
    });
    if (out) leaveOut(length + 4 * rounding_);
    return out;
  }

  /// How deep a point of a surface lies in the other solid.
  Depth look(Piece::Kind kind, const Vec& p) {
    const Depth depth = other(kind).depthOf(p);
    raiseLower(kind, p, depth.lower, depth.nearest);
    return depth;
  }

  void raiseLower(Piece::Kind kind, const Vec& p, double depth, const Vec& nearest) {
    double lower = depth - rounding_;
    if (!(lower > result_.lower)) return;
    if (kind != Piece::kSpace && own(kind).hasWalls()) {
      lower -= own(kind).fromOutside(p);
      if (!(lower > result_.lower)) return;
    }
    result_.lower = lower;
    result_.surface_of = kind == Piece::kSpace ? 0 : kind == Piece::kOfA ? 1 : 2;
    Eigen::Map<Vec>(result_.point) = p;
    Eigen::Map<Vec>(result_.nearest) = nearest;
  }

  SolidPair& pair_;
  const LocalDepthRequest& request_;
  const double rounding_;
  const std::array<DepthInSolid, 2> solids_;
  std::vector<Piece> waiting_;  ///< a heap
  long long visits_ = 0;        ///< of moves out of a solid
  double left_out_ = 0;         ///< the largest bound of what is not looked at
  LocalDepthResult result_;
};

/// Points of the answer are in the common frame.
LocalDepthResult depthOfPair(SolidPair& pair, const LocalDepthRequest& request) {
  const MeshPair& frame = pair.frame();
  const double rounding = roundingOf(pair);
  if (frame.rootBound(rounding) > rounding) return {};
  const auto contacts = searchContacts(frame, 1, pair.counts());
  if (contacts.empty()) {
    const Separation as_is = pair.test(Vec::Zero(), 2 * rounding);
    if (as_is.apart) {
      LocalDepthResult none;  // but the models may meet by what the frame rounds
      none.upper = as_is.gap > rounding ? 0 : rounding;
      return none;
    }
  }
  return DepthSearch(pair, rounding, request).run(contacts);
}

}  // namespace

template <typename S>
LocalDepthResult localDepth(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                            const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                            const LocalDepthRequest& request) {
  requireValid(request);
  SearchCounts counts;
  SolidPair pair =
      inOrder(meshOf(solid1), X_W1.template cast<double>(), meshOf(solid2),
              X_W2.template cast<double>(), squaredRotationErrors(X_W1, X_W2), counts, false);
  LocalDepthResult result = depthOfPair(pair, request);
  if (pair.swapped() && result.surface_of != 0) result.surface_of = 3 - result.surface_of;
  for (double* const p : {result.point, result.nearest}) {
    Eigen::Map<Vec> point(p);
    point = result.lower > 0 ? pair.pointInWorld(point) : Vec(Vec::Zero());
  }
  return result;
}

template <typename S>
bool deeperThan(const Model<S>& solid1, const fcl::Transform3<S>& X_W1, const Model<S>& solid2,
                const fcl::Transform3<S>& X_W2, double t, long long max_pieces) {
  require(t >= 0, "t", t, ">= 0");
  LocalDepthRequest request;
  request.rel_err = 0;
  request.max_pieces = max_pieces;
  request.threshold = t;
  const LocalDepthResult result = localDepth(solid1, X_W1, solid2, X_W2, request);
  if (result.lower > t) return true;
  if (result.upper <= t) return false;
  refuse<std::runtime_error>("whether the solids are deeper in each other than ", t,
                             " is not decided: their depth lies from ", result.lower, " to ",
                             result.upper, ".");
}

KIOS_INSTANTIATE_FUNCTION(localDepth);
KIOS_INSTANTIATE_FUNCTION(deeperThan);

}  // namespace kios
