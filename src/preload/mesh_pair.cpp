// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes over one of FCL's volumes.
#include <exception>
#include <limits>
#include <type_traits>

#include "fcl_kios/query/mesh_queries.h"
#include "preload/back.h"
#include "preload/fcl_search.h"

namespace kios::preload {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The places of two models, and what is asked.
struct Asked {
  Asked(Back& back, const Mesh& a, const Mesh& b, Kind kind)
      : hold_a(back.twins.hold(a)), hold_b(back.twins.hold(b)) {
    if (!hold_a || !hold_b) return;
    have_twins = hold_a.hasTwin() && hold_b.hasTwin();
    question = {hold_a.serial(), hold_b.serial(), kind, 0};
    if (have_twins) {
      question.twins_cost = costOfTwins(
          kind, hold_a.bytesToCompare() + (a.model == b.model ? 0 : hold_b.bytesToCompare()));
    }
  }

  bool areCurrent() const {
    return have_twins && hold_a.isCurrent() &&
           (&hold_a.twin() == &hold_b.twin() || hold_b.isCurrent());
  }

  Twins::Hold hold_a, hold_b;
  Question question = {};
  bool have_twins = false;
};

/// FCL was asked for want of twins: models that have none share the price.
void pay(Back& back, const Mesh& a, const Mesh& b, double nanoseconds) {
  const auto lacks = [&back](const Mesh& mesh) {
    const Twins::Hold hold = back.twins.hold(mesh);
    return hold && !hold.hasTwin();
  };
  const bool of_a = lacks(a), of_b = a.model != b.model && lacks(b);
  if (of_a) back.twins.pay(a, of_b ? 0.5 * nanoseconds : nanoseconds);
  if (of_b) back.twins.pay(b, of_a ? 0.5 * nanoseconds : nanoseconds);
}

/// Returns whether the twins touch, and by which triangles. Throws as k-IOS's queries.
bool touch(const Asked& asked, const Pair& pair, int& id_a, int& id_b) {
  CollisionResult verdict;
  kios::collideMeshes(asked.hold_a.twin(), pair.X_WA, asked.hold_b.twin(), pair.X_WB,
                      CollisionRequest(1, false), verdict);
  if (!verdict.isCollision()) return false;
  id_a = static_cast<int>(verdict.getContact(0).b1);
  id_b = static_cast<int>(verdict.getContact(0).b2);
  return true;
}

template <typename BV>
constexpr bool kFclCopiesModels = std::is_same<BV, fcl::RSSd>::value;

}  // namespace

template <typename BV>
By collideModels(Back& back, const Pair& pair, const CollisionRequest& request,
                 CollisionResult& result) {
  Mesh a, b;
  if (!readMesh<BV>(pair.a, a) || !readMesh<BV>(pair.b, b)) return By::kHandedOn;
  if (request.isSatisfied(result)) return By::kFclSearch;
  const auto &model_a = modelOf<BV>(pair.a), &model_b = modelOf<BV>(pair.b);
  if constexpr (!kFclCopiesModels<BV>) {
    if (!rootsOverlap(model_a, pair.X_WA, model_b, pair.X_WB)) return By::kFclSearch;
  }

  const std::size_t before = result.numContacts();
  // FCL's search of its own volumes; it copies and builds models over RSS, which takes longer than
  // anything else.
  const auto searchByFcl = [&](double limit) -> Search {
    if constexpr (kFclCopiesModels<BV>) {
      const bool twins_first = limit < kInfinity;
      if (twins_first) return {false, 0};
      back.start.fcl.collide(pair.a, pair.X_WA, pair.b, pair.X_WB, request, result);
      return {true, 1000.0 * static_cast<double>(a.num_triangles + b.num_triangles)};
    } else {
      return collideByFcl(model_a, pair.X_WA, model_b, pair.X_WB, request, result, limit);
    }
  };

  if (back.always()) {
    back.makeTwin(a);
    back.makeTwin(b);
  }
  bool stale = false;
  {
    const Asked asked(back, a, b, wantsContacts(request) ? Kind::kContacts : Kind::kVerdict);
    if (asked.have_twins) {
      const double limit = back.always() ? 0 : back.rule.fclLimit(asked.question);
      if (limit == Rule::kHandOn) return By::kHandedOn;
      if (limit > 0) {
        const Search search = searchByFcl(limit);
        back.rule.note(asked.question, search, limit, result.numContacts() > before);
        if (search.done) return By::kFclSearch;
      }
      if (isRigid(pair.X_WA) && isRigid(pair.X_WB)) {
        stale = !asked.areCurrent();
        if (!stale) {
          try {
            int id_a, id_b;
            if (!touch(asked, pair, id_a, id_b)) return By::kTwins;
            back.rule.noteContact(asked.question);
            if (!wantsContacts(request)) {
              const fcl::Vector3d unset = fcl::Vector3d::Zero();  // FCL leaves it uninitialised
              result.addContact(
                  fcl::Contact<double>(pair.a, pair.b, id_a, id_b, unset, unset, 0.0));
              return By::kTwins;
            }
          } catch (const std::exception&) {  // k-IOS refuses the pair
          }
        }
      }
      if (!stale) {
        searchByFcl(kInfinity);
        return By::kFclSearch;
      }
    }
  }
  const Search search = searchByFcl(kInfinity);
  pay(back, a, b, search.nanoseconds);
  return By::kFclSearch;
}

template <typename BV>
By distanceOfModels(Back& back, const Pair& pair, const DistanceRequest& request,
                    DistanceResult& result) {
  Mesh a, b;
  if (!readMesh<BV>(pair.a, a) || !readMesh<BV>(pair.b, b)) return By::kHandedOn;
  const auto &model_a = modelOf<BV>(pair.a), &model_b = modelOf<BV>(pair.b);
  const auto searchByFcl = [&](double limit) {
    return distanceByFcl(model_a, pair.X_WA, model_b, pair.X_WB, request, result, limit);
  };

  if (back.always()) {
    back.makeTwin(a);
    back.makeTwin(b);
  }
  bool stale = false;
  {
    const Asked asked(back, a, b, Kind::kDistance);
    if (asked.have_twins) {
      const double limit = back.always() ? 0 : back.rule.fclLimit(asked.question);
      if (limit > 0) {
        const Search search = searchByFcl(limit);
        back.rule.note(asked.question, search, limit, false);
        if (search.done) return By::kFclSearch;
      }
      if (isRigid(pair.X_WA) && isRigid(pair.X_WB)) {
        stale = !asked.areCurrent();
        if (!stale) {
          try {
            DistanceResult found(result.min_distance);
            kios::distanceMeshes(asked.hold_a.twin(), pair.X_WA, asked.hold_b.twin(), pair.X_WB,
                                 exact(request.enable_nearest_points), found);
            if (request.enable_nearest_points) {
              result.update(found.min_distance, pair.a, pair.b, static_cast<int>(found.b1),
                            static_cast<int>(found.b2), found.nearest_points[0],
                            found.nearest_points[1]);
            } else {
              result.update(found.min_distance, pair.a, pair.b, static_cast<int>(found.b1),
                            static_cast<int>(found.b2));
            }
            return By::kTwins;
          } catch (const std::exception&) {  // k-IOS refuses the pair
          }
        }
      }
      if (!stale) {
        searchByFcl(kInfinity);
        return By::kFclSearch;
      }
    }
  }
  const Search search = searchByFcl(kInfinity);
  pay(back, a, b, search.nanoseconds);
  return By::kFclSearch;
}

template By collideModels<fcl::OBBd>(Back&, const Pair&, const CollisionRequest&, CollisionResult&);
template By collideModels<fcl::RSSd>(Back&, const Pair&, const CollisionRequest&, CollisionResult&);
template By collideModels<fcl::kIOSd>(Back&, const Pair&, const CollisionRequest&,
                                      CollisionResult&);
template By collideModels<fcl::OBBRSSd>(Back&, const Pair&, const CollisionRequest&,
                                        CollisionResult&);
template By distanceOfModels<fcl::RSSd>(Back&, const Pair&, const DistanceRequest&,
                                        DistanceResult&);
template By distanceOfModels<fcl::kIOSd>(Back&, const Pair&, const DistanceRequest&,
                                         DistanceResult&);
template By distanceOfModels<fcl::OBBRSSd>(Back&, const Pair&, const DistanceRequest&,
                                           DistanceResult&);

}  // namespace kios::preload
