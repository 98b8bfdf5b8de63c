// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes over one of FCL's volumes.
#include <exception>
#include <type_traits>

#include "fcl_kios/contact.h"
#include "preload/fcl_search.h"
#include "preload/implementation.h"
#include "volume/rounding.h"

namespace kios::preload {
namespace {

/// The places of two models, and what is asked.
struct Asked {
  Asked(Implementation& implementation, const Mesh& a, const Mesh& b, Kind kind)
      : lease_a(implementation.copies.lease(a)), lease_b(implementation.copies.lease(b)) {
    if (!lease_a || !lease_b) return;
    have_copies = lease_a.hasCopy() && lease_b.hasCopy();
    question = {lease_a.serial(), lease_b.serial(), kind, 0};
    if (have_copies) {
      question.copies_cost = costOfCopies(
          kind, lease_a.bytesToCompare() + (a.model == b.model ? 0 : lease_b.bytesToCompare()));
    }
  }

  bool areCurrent() const {
    return have_copies && lease_a.isCurrent() &&
           (&lease_a.copy() == &lease_b.copy() || lease_b.isCurrent());
  }

  CopyCache::ModelLease lease_a, lease_b;
  Question question = {};
  bool have_copies = false;
};

/// FCL was asked for want of copies: models that have none share the price.
void pay(Implementation& implementation, const Mesh& a, const Mesh& b, double nanoseconds) {
  const auto lacks = [&implementation](const Mesh& mesh) {
    const CopyCache::ModelLease lease = implementation.copies.lease(mesh);
    return lease && !lease.hasCopy();
  };
  const bool of_a = lacks(a), of_b = a.model != b.model && lacks(b);
  if (of_a) implementation.copies.pay(a, of_b ? 0.5 * nanoseconds : nanoseconds);
  if (of_b) implementation.copies.pay(b, of_a ? 0.5 * nanoseconds : nanoseconds);
}

/// Answers by the copies where they are the cheaper, else by FCL. searchByFcl(limit) asks FCL,
/// touches() says whether it has found a contact, and askCopies(asked) whether the copies' answer
/// will do; it may throw what k-IOS's queries do.
template <typename SearchByFcl, typename Touches, typename AskCopies>
By askTheCheaper(Implementation& implementation, const PosedPair& pair, const Mesh& a,
                 const Mesh& b, Kind kind, const SearchByFcl& searchByFcl, const Touches& touches,
                 const AskCopies& askCopies) {
  if (implementation.always()) {
    implementation.makeCopy(a);
    implementation.makeCopy(b);
  }
  {
    const Asked asked(implementation, a, b, kind);
    if (asked.have_copies) {
      const double limit =
          implementation.always() ? 0 : implementation.policy.fclLimit(asked.question);
      if (limit == Policy::kHandOn) return By::kHandedOn;
      if (limit > 0) {
        const Search search = searchByFcl(limit);
        implementation.policy.note(asked.question, search, limit, touches());
        if (search.done) return By::kFclSearch;
      }
      const bool rigid = isRigid(pair.X_WA) && isRigid(pair.X_WB);
      const bool current = !rigid || asked.areCurrent();
      try {
        if (rigid && current && askCopies(asked)) return By::kCopies;
      } catch (const std::exception&) {  // k-IOS refuses the pair
      }
      if (current) {
        searchByFcl(kInfinity);
        return By::kFclSearch;
      }
    }
  }
  const Search search = searchByFcl(kInfinity);
  pay(implementation, a, b, search.nanoseconds);
  return By::kFclSearch;
}

template <typename BV>
constexpr bool kFclCopiesModels = std::is_same<BV, fcl::RSSd>::value;

}  // namespace

template <typename BV>
By answerModels(Implementation& implementation, const fcl::BVHModel<BV>& model_a,
                const PosedPair& pair, const CollisionRequest& request, CollisionResult& result) {
  const auto& model_b = modelOf<BV>(*pair.b);
  Mesh a, b;
  if (!readMesh(model_a, a) || !readMesh(model_b, b)) return By::kHandedOn;
  if (request.isSatisfied(result)) return By::kFclSearch;
  if constexpr (!kFclCopiesModels<BV>) {
    if (!rootsOverlap(model_a, pair.X_WA, model_b, pair.X_WB)) return By::kFclSearch;
  }

  const std::size_t before = result.numContacts();
  // FCL's search of its own volumes; it copies and builds models over RSS, which takes longer than
  // anything else.
  const auto searchByFcl = [&](double limit) -> Search {
    if constexpr (kFclCopiesModels<BV>) {
      const bool copies_first = limit < kInfinity;
      if (copies_first) return {false, 0};
      implementation.start.fcl.collide(pair.a, pair.X_WA, pair.b, pair.X_WB, request, result);
      return {true, 1000.0 * static_cast<double>(a.num_triangles + b.num_triangles)};
    } else {
      return collideByFcl(model_a, pair.X_WA, model_b, pair.X_WB, request, result, limit);
    }
  };

  const auto touches = [&] { return result.numContacts() > before; };
  const auto askCopies = [&](const Asked& asked) {
    CollisionResult verdict;
    kios::collideMeshes(asked.lease_a.copy(), pair.X_WA, asked.lease_b.copy(), pair.X_WB,
                        CollisionRequest(1, false), verdict);
    if (!verdict.isCollision()) return true;
    implementation.policy.noteContact(asked.question);
    if (wantsContacts(request)) return false;
    const fcl::Contact<double>& found = verdict.getContact(0);
    const int id_a = static_cast<int>(found.b1), id_b = static_cast<int>(found.b2);
    const fcl::Vector3d unset = fcl::Vector3d::Zero();  // FCL leaves it uninitialised
    result.addContact(fcl::Contact<double>(pair.a, pair.b, id_a, id_b, unset, unset, 0.0));
    return true;
  };
  return askTheCheaper(implementation, pair, a, b,
                       wantsContacts(request) ? Kind::kContacts : Kind::kVerdict, searchByFcl,
                       touches, askCopies);
}

template <typename BV>
By answerModels(Implementation& implementation, const fcl::BVHModel<BV>& model_a,
                const PosedPair& pair, const DistanceRequest& request, DistanceResult& result) {
  const auto& model_b = modelOf<BV>(*pair.b);
  Mesh a, b;
  if (!readMesh(model_a, a) || !readMesh(model_b, b)) return By::kHandedOn;
  const auto searchByFcl = [&](double limit) {
    return distanceByFcl(model_a, pair.X_WA, model_b, pair.X_WB, request, result, limit);
  };

  const auto askCopies = [&](const Asked& asked) {
    // FCL ignores the errors that a request allows.
    const DistanceRequest exact(request.enable_nearest_points);
    DistanceResult found(result.min_distance);
    kios::distanceMeshes(asked.lease_a.copy(), pair.X_WA, asked.lease_b.copy(), pair.X_WB, exact,
                         found);
    const int id_a = static_cast<int>(found.b1), id_b = static_cast<int>(found.b2);
    if (request.enable_nearest_points) {
      result.update(found.min_distance, pair.a, pair.b, id_a, id_b, found.nearest_points[0],
                    found.nearest_points[1]);
    } else {
      result.update(found.min_distance, pair.a, pair.b, id_a, id_b);
    }
    return true;
  };
  return askTheCheaper(
      implementation, pair, a, b, Kind::kDistance, searchByFcl, [] { return false; }, askCopies);
}

#define KIOS_INSTANTIATE(BV, Query)                                                     \
  template By answerModels(Implementation&, const fcl::BVHModel<BV>&, const PosedPair&, \
                           const Query##Request&, Query##Result&);
KIOS_INSTANTIATE(fcl::OBBd, Collision)
KIOS_INSTANTIATE(fcl::RSSd, Collision)
KIOS_INSTANTIATE(fcl::kIOSd, Collision)
KIOS_INSTANTIATE(fcl::OBBRSSd, Collision)
KIOS_INSTANTIATE(fcl::RSSd, Distance)
KIOS_INSTANTIATE(fcl::kIOSd, Distance)
KIOS_INSTANTIATE(fcl::OBBRSSd, Distance)
#undef KIOS_INSTANTIATE

}  // namespace kios::preload
