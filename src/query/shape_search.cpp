// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/shape_search.h"

#include <algorithm>
#include <utility>

#include "search/pair_query.h"
#include "volume/rounding.h"

namespace kios {

void SolidSearcher::search() {
  if (floats_serve_) return engine::kernels().solid({mesh_.tree(), floats_, *this, counts_});
  for (std::uint32_t t = 0; t < mesh_.numTriangles() && !evaluate(t, false);) ++t;
}

NearestTriangle::NearestTriangle(const Mesh& mesh, const PosedSolid& posed, double rel_err,
                                 double abs_err, double far_enough, SearchCounts& counts)
    : SolidSearcher(mesh, posed, counts),
      rel_err_(rel_err),
      abs_err_(abs_err),
      slack_(rel_err == 0 && abs_err == 0 ? posed.kernelError(mesh) : 0) {
  lowerTo(far_enough);
}

// True if nothing can be nearer.
bool NearestTriangle::evaluate(std::uint32_t triangle, bool /*meets*/) {
  const int id = static_cast<int>(triangle);
  const shape::Triangle t = this->triangle(id);
  if (slabs_.proveFarther(t, limit_ + slack_)) return best_ <= 0;
  const auto d = shape::distance(posed_.solid(), t, limit_ + slack_);
  const shape::Vec way = d.on_triangle - d.on_shape;
  if (posed_.solid().kind == shape::Kind::kConvex) {
    const auto* const added = slabs_.add(way);
    if (added && floats_serve_) addSlab(inTree(added->normal, added->offset));
  }
  if (!(d.distance < best_ || (d.distance == best_ && id < id_))) return best_ <= 0;
  nearest_ = d;
  id_ = id;
  lowerTo(d.distance);
  if (floats_serve_ && posed_.solid().bounded() && d.distance > 0) {
    const double length = way.norm();
    if (length > 0) {
      const shape::Vec n = way / length;
      slab = inTree(n, shape::extentAlong(posed_.solid(), n));
    }
  }
  return best_ <= 0;
}

void NearestTriangle::lowerTo(double distance) {
  best_ = distance;
  limit_ = engine::cullDistance(distance, rel_err_, abs_err_);
  cull_distance = roundUp<float>(limit_);
}

// It is the corner nearest to a half-space that begins well beyond the mesh. With a loop over all
// vertices penetrations take 1.4 times as long (kios_bench solids/arm_in_table) to 1.7 (balls).
Pointd farthestVertex(const Mesh& mesh, const Pointd& n) {
  shape::Solid beyond;
  beyond.kind = shape::Kind::kHalfspace;
  beyond.normal = -n.normalized();
  beyond.offset = beyond.normal.dot(mesh.center()) - 2 * mesh.radius();
  const fcl::Transform3d X = fcl::Transform3d::Identity();
  const PosedSolid posed(std::move(beyond), X, X, mesh, 0);
  SearchCounts unused;
  NearestTriangle search(mesh, posed, 0, 0, kInfinity, unused);
  search.run();
  return posed.toWorld(search.nearest().on_triangle);
}

const std::vector<int>& TouchingTriangles::run() {
  const bool by_faces = facesPay();
  makeFloats(by_faces);
  if (by_faces && floats_serve_) setFaces();
  cull_distance = 0;
  search();
  if (found_.size() < limit_) sort();
  return found_;
}

// True if no more are asked for.
bool TouchingTriangles::evaluate(std::uint32_t triangle, bool meets) {
  const int id = static_cast<int>(triangle);
  if (!meets) {
    ++counts_.leaf_kernels;
    constexpr int kFewTests = 8;     // that take less than a convex shape's planes
    constexpr int kMostFaces = 256;  // whose planes take less than GJK
    if (++num_tests_ > kFewTests && posed_.solid().num_faces <= kMostFaces) faces();
    const shape::Triangle t = this->triangle(id);
    const double clear = 0x1p-40 * (shape::sizeOf(t) + posed_.reach());
    if (slabs_.proveFarther(t, clear)) return false;
    std::optional<shape::Vec> across;
    if (!shape::intersects(posed_.solid(), t, faces_ ? &*faces_ : nullptr, &across)) {
      const auto* const added = across ? slabs_.add(*across) : nullptr;
      if (added && floats_serve_ && !by_faces_) addSlab(inTree(added->normal, added->offset));
      return false;
    }
  }
  found_.push_back(id);
  return found_.size() >= limit_;
}

// Whether the slabs of all of a convex shape's faces, made at once, take less than those that are
// found on the way: without them shapes/convex/contacts takes 4 times as long.
bool TouchingTriangles::facesPay() const {
  constexpr std::size_t kFewContacts = 8, kMostProducts = 1 << 14;
  constexpr double kMostReach = 64;  // that lets the slabs tell something
  const shape::Solid& solid = posed_.solid();
  return solid.kind == shape::Kind::kConvex && limit_ > kFewContacts &&
         posed_.reach() <= kMostReach * double{mesh_.tree().reach} &&
         static_cast<std::size_t>(solid.num_faces) * solid.points.size() <= kMostProducts;
}

void TouchingTriangles::setFaces() {
  std::vector<engine::FloatSlab> slabs;
  for (const auto& slab : faces().slabs()) slabs.push_back(inTree(slab.normal, slab.offset));
  by_faces_ = !slabs.empty();
  setSlabs(std::move(slabs));
}

// A list of all that touch has one order, whichever tree was searched. By the bits of ids, as
// std::sort() takes a fifth of shapes/capsule/contacts.
void TouchingTriangles::sort() {
  constexpr std::size_t kBits = 64;
  if (found_.size() < mesh_.numTriangles() / (4 * kBits)) {
    std::sort(found_.begin(), found_.end());
    return;
  }
  std::vector<std::uint64_t> words(mesh_.numTriangles() / kBits + 1);
  for (const int id : found_) {
    words[static_cast<std::size_t>(id) / kBits] |= std::uint64_t{1} << (id % int{kBits});
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::uint64_t left = words[i]; left != 0; left &= left - 1) {
      found_[n++] = static_cast<int>(i * kBits) + __builtin_ctzll(left);
    }
  }
}

shape::TriangleShapeContact TouchingTriangles::contactOf(int id) {
  return shape::contact(posed_.solid(), triangle(id), &faces());
}

}  // namespace kios
