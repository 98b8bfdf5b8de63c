// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/shape_queries.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "model/prepared.h"
#include "query/collide_with.h"
#include "query/float_solid.h"
#include "query/posed_solid.h"
#include "search/mesh_pair.h"
#include "search/search.h"
#include "shape/convex_faces.h"
#include "shape/separating_slabs.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"
#include "volume/instantiate.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// The box of a bounded shape along the world's axes. Half-spaces and planes, as in FCL, fill the
/// world but for axes that their normal is parallel to.
template <typename S>
fcl::AABB<S> worldBox(const shape::Solid& solid, const fcl::Transform3<S>& tf) {
  const Eigen::Matrix3d R = tf.linear().template cast<double>();
  fcl::AABB<S> box;
  for (int c = 0; c < 3; ++c) {
    const shape::Vec n = R.row(c).transpose();
    const double high = shape::extentAlong(solid, n), low = -shape::extentAlong(solid, -n);
    const double most = std::numeric_limits<S>::max(), at = tf.translation()[c];
    box.min_[c] = roundedTo<S>(std::max(-most, low + at));
    box.max_[c] = roundedTo<S>(std::min(most, high + at));
  }
  return box;
}

/// The triangles of a model that meet a shape, reported as FCL's oriented traversal does.
template <typename S>
class ShapeCollision final : public engine::SolidEvaluator {
 public:
  ShapeCollision(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3<S>& X_WS,
                 double squared_errors, const fcl::CollisionRequest<S>& request,
                 fcl::CollisionResult<S>& result, SearchCounts& counts)
      : model_(model),
        geometry_(geometry),
        X_WM_(X_WM),
        X_WS_(X_WS),
        request_(request),
        result_(result),
        counts_(counts),
        occupied_(model.isOccupied() && geometry.isOccupied()),
        costs_(request.enable_cost && !model.isFree() && !geometry.isFree()),
        posed_(toSolid(geometry), X_WM, X_WS, model.getBV(0).bv, squared_errors),
        slabs_(posed_.solid()) {}

  void run() {
    if (!occupied_ && !costs_) return;
    if (costs_) shape_box_ = worldBox(toSolid(geometry_), X_WS_);
    search();
    if (!isSatisfied()) sort(static_cast<std::size_t>(model_.num_tris));
    std::sort(common_.begin(), common_.end());
    for (const int id : found_) report(id);
  }

  bool evaluate(std::uint32_t triangle, bool meets) override {
    return test(static_cast<int>(triangle), meets);
  }

 private:
  struct CommonPoint {
    int id;
    shape::Vec point;
    bool operator<(const CommonPoint& o) const { return id < o.id; }
  };

  /// Finds as many triangles as there is room for; all that touch if costs are asked for.
  void search() {
    const engine::Tree& tree = treeOf(model_);
    engine::FloatSolid solid;
    const bool by_faces = facesPay(tree);
    if (!makeFloatSolid(tree, posed_, by_faces, solid)) {  // floats tell nothing
      for (int id = 0; id < model_.num_tris && !test(id, false);) ++id;
      return;
    }
    tree_ = &tree;
    if (by_faces) setFaces();
    cull_distance = 0;
    engine::kernels().solid({tree, solid, *this, counts_});
  }

  /// True if no more are asked for.
  bool test(int id, bool meets) {
    if (!meets) {
      ++counts_.leaf_kernels;
      constexpr int kFewTests = 8;     // that take less than a convex shape's planes
      constexpr int kMostFaces = 256;  // whose planes take less than GJK
      if (++num_tests_ > kFewTests && posed_.solid().num_faces <= kMostFaces) makeFaces();
      const shape::Triangle t = posed_.place(cornersOf(model_, id));
      const double clear = 0x1p-40 * (shape::sizeOf(t) + posed_.reach());
      if (slabs_.proveFarther(t, clear)) return false;
      shape::Witness witness;
      if (!shape::intersects(posed_.solid(), t, faces_ ? &*faces_ : nullptr, &witness)) {
        if (witness.across) addSlab(*witness.across);
        return false;
      }
      if (witness.common && request_.enable_contact) common_.push_back({id, *witness.common});
    }
    found_.push_back(id);
    return isSatisfied();
  }

  /// Whether the slabs of all of a convex shape's faces, made at once, take less than those that
  /// are found on the way: without them shapes/convex/contacts takes 1.8 times as long.
  bool facesPay(const engine::Tree& tree) const {
    constexpr std::size_t kFewContacts = 8, kMostProducts = 1 << 14;
    constexpr double kMostReach = 64;  // that lets the slabs tell something
    const shape::Solid& solid = posed_.solid();
    return solid.kind == shape::Kind::kConvex &&
           (costs_ || request_.num_max_contacts > kFewContacts) &&
           posed_.reach() <= kMostReach * double{tree.reach} &&
           static_cast<std::size_t>(solid.num_faces) * solid.points.size() <= kMostProducts;
  }

  void setFaces() {
    makeFaces();
    std::vector<engine::FloatSlab> slabs;
    for (const auto& slab : faces_->slabs()) {
      slabs.push_back(slabInTree(*tree_, posed_, slab.normal, slab.offset));
    }
    by_faces_ = !slabs.empty();
    setSlabs(std::move(slabs));
  }

  void addSlab(const shape::Vec& across) {
    const auto* const slab = slabs_.add(across);
    if (slab && tree_ && !by_faces_) {
      engine::SolidEvaluator::addSlab(slabInTree(*tree_, posed_, slab->normal, slab->offset));
    }
  }

  /// A list of all that touch has one order, whichever tree was searched. By the bits of ids, as
  /// std::sort() takes a fifth of shapes/capsule/contacts.
  void sort(std::size_t num_triangles) {
    constexpr std::size_t kBits = 64;
    if (found_.size() < num_triangles / (4 * kBits)) {
      std::sort(found_.begin(), found_.end());
      return;
    }
    std::vector<std::uint64_t> words(num_triangles / kBits + 1);
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

  bool isSatisfied() const {
    return !costs_ && result_.numContacts() + found_.size() >= request_.num_max_contacts;
  }

  void makeFaces() {
    if (!faces_) faces_.emplace(posed_.solid());
  }

  std::optional<shape::Vec> commonPointOf(int id) const {
    const auto at = std::lower_bound(common_.begin(), common_.end(), CommonPoint{id, {}});
    if (at == common_.end() || at->id != id) return std::nullopt;
    return at->point;
  }

  void report(int id) {
    const TriangleVertices<S> corners = cornersOf(model_, id);
    if (occupied_ && result_.numContacts() < request_.num_max_contacts) {
      fcl::Contact<S> contact(&model_, &geometry_, id, fcl::Contact<S>::NONE,
                              fcl::Vector3<S>::Zero(), fcl::Vector3<S>::Zero(), S(0));
      if (request_.enable_contact) {
        makeFaces();
        const shape::TriangleShapeContact c =
            shape::contact(posed_.solid(), posed_.place(corners), &*faces_, commonPointOf(id));
        contact.pos = posed_.toWorld(c.position);
        contact.normal = posed_.directionToWorld(-c.normal);  // from the mesh to the shape
        contact.penetration_depth = c.depth > 0 ? posed_.fromUnits(c.depth) : S(0);
      }
      result_.addContact(contact);
    }
    if (costs_) {
      fcl::AABB<S> shared;
      const auto t = transformed(corners, X_WM_);
      fcl::AABB<S>(t[0], t[1], t[2]).overlap(shape_box_, shared);
      result_.addCostSource(
          fcl::CostSource<S>(shared, model_.cost_density * geometry_.cost_density),
          request_.num_max_cost_sources);
    }
  }

  const Model<S>& model_;
  const fcl::CollisionGeometry<S>& geometry_;
  const fcl::Transform3<S>&X_WM_, &X_WS_;
  const fcl::CollisionRequest<S>& request_;
  fcl::CollisionResult<S>& result_;
  SearchCounts& counts_;
  const bool occupied_, costs_;
  const PosedSolid<S> posed_;
  shape::SeparatingSlabs slabs_;
  const engine::Tree* tree_ = nullptr;
  bool by_faces_ = false;  ///< the search has the slabs of all faces
  std::optional<shape::ConvexFaces> faces_;
  int num_tests_ = 0;
  std::vector<CommonPoint> common_;  ///< where it is known; by id once reported
  fcl::AABB<S> shape_box_;
  std::vector<int> found_;
};

}  // namespace

template <typename S>
std::size_t collideShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                         SearchCounts* counts) {
  const auto search = [&](const fcl::CollisionRequest<S>& asked) {
    SearchCounts unused;
    SearchCounts& counted = counts ? *counts : unused;
    const double squared_errors = squaredRotationErrors(X_WS, X_WM);
    const bool done = request.isSatisfied(result);
    if (!done) {
      ++counted.volume_tests;
      if (provenApart(model, X_WM, shape, X_WS, squared_errors, 0)) return true;
    }
    ShapeCollision<S> of(model, X_WM, shape, X_WS, squared_errors, asked, result, counted);
    if (!done) of.run();
    return !done;
  };
  return collideWith(model, X_WM, shape, X_WS, request, result, search);
}

KIOS_INSTANTIATE_FUNCTION(collideShape);

}  // namespace kios
