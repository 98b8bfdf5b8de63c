// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::distance: against brute force, in both orders, with bounds on entry and error bounds.

#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

template <typename S>
using Result = fcl::DistanceResult<S>;

template <typename S>
class DistanceQuestion {
 public:
  explicit DistanceQuestion(const Case& c)
      : random_(c.draw),
        pair_(c),
        truth_(c.meshes[0], pair_.X, c.meshes[1], pair_.Y),
        reverse_(c.meshes[1], pair_.Y, c.meshes[0], pair_.X) {}

  Verdict run() {
    fcl::DistanceRequest<S> request(true);
    Result<S> result;
    const S d = fcl::distance(pair_.A.get(), pair_.X, pair_.B.get(), pair_.Y, request, result);
    const std::string call =
        "fcl::DistanceRequest<S> request(true); fcl::distance(A.get(), X[0], B.get(), X[1], "
        "request, result)";
    const std::pair<int, int> ids = {static_cast<int>(result.b1), static_cast<int>(result.b2)};
    if (!result.o1 || !truth_.contains(ids) || d != result.min_distance) {
      return failure(Words() << "no answer: " << d << ", triangles " << text(ids)
                             << "; brute force " << truth_.distance << " of "
                             << text(truth_.nearest),
                     call);
    }
    if (auto wrong = judge(d, ids, truth_, call)) return wrong;
    if (auto fault = faultOfPoints<S>(truth_, ids, result.nearest_points[0],
                                      result.nearest_points[1], d, pair_.X, pair_.Y)) {
      return failure(Words() << *fault, call);
    }
    if (auto wrong = swapped(d, ids)) return wrong;
    for (int i = 0; i < 4; ++i) {
      if (auto wrong = bounded(d)) return wrong;
    }
    for (int i = 0; i < 2; ++i) {
      if (auto wrong = tolerant()) return wrong;
    }
    return std::nullopt;
  }

 private:
  /// Returns an exact answer: the kernel's, for triangles that are as near as any.
  static Verdict judge(S d, const std::pair<int, int>& ids, const BruteForce<S>& truth,
                       const std::string& call) {
    if (d != truth.distanceOf(ids)) {
      return failure(Words() << d << ", but the kernel gives " << truth.distanceOf(ids) << " for "
                             << text(ids),
                     call);
    }
    if ((d == 0) == truth.hits.empty()) {
      return failure(Words() << d << ", but " << truth.hits.size() << " pairs intersect", call);
    }
    if (!(double{d} - double{truth.distance} <= truth.tolerance(ids))) {
      return failure(Words() << d << " of " << text(ids) << "; brute force " << truth.distance
                             << " of " << text(truth.nearest) << ", allowed "
                             << truth.tolerance(ids),
                     call);
    }
    return std::nullopt;
  }

  Verdict swapped(S d, const std::pair<int, int>& ids) {
    Result<S> result;
    const S e = fcl::distance(pair_.B.get(), pair_.Y, pair_.A.get(), pair_.X,
                              fcl::DistanceRequest<S>(), result);
    const std::string call =
        "fcl::DistanceRequest<S> request; fcl::distance(B.get(), X[1], A.get(), X[0], request, "
        "result)";
    const std::pair<int, int> ids_e = {static_cast<int>(result.b1), static_cast<int>(result.b2)};
    if (!result.o1 || !reverse_.contains(ids_e)) return failure(Words() << "no answer", call);
    if (auto wrong = judge(e, ids_e, reverse_, call)) return wrong;
    const double L = truth_.extentOf(ids) + reverse_.extentOf(ids_e);
    const double frames = truth_.frameError(ids.second) + truth_.frameError(ids_e.first) +
                          reverse_.frameError(ids.first) + reverse_.frameError(ids_e.second);
    // Transposes of what is no rotation: |E| of the lengths that they take back.
    double reach = L + double{d};
    for (const auto* t :
         {&truth_.trianglesInB()[ids.second], &reverse_.trianglesInB()[ids.first],
          &truth_.trianglesInB()[ids_e.first], &reverse_.trianglesInB()[ids_e.second]}) {
      reach += (*t)[0].template cast<double>().norm();
    }
    reach += detail::boundsOf(truth_.X_AB).T_norm1;
    const double skew = 2 * (skewOf(pair_.X) + skewOf(pair_.Y)) * reach;
    const double bound = 16 * truth_.kEps * L + frames + skew + 2 * truth_.kLeast;
    if (!(std::abs(double{d} - double{e}) <= bound)) {
      return failure(Words() << d << " in one order, " << e << " in the other; allowed " << bound,
                     call);
    }
    return std::nullopt;
  }

  // A bound on entry is kept if nothing is nearer, and beaten if something is.
  Verdict bounded(S d) {
    S t = d;
    switch (below(random_, 3)) {
      case 0:
        t = ulps(d, scenes::integer(random_, -3, 3));
        break;
      case 1:
        t = static_cast<S>(double{d} * (1 + scenes::randomSign(random_) * power(random_, -16, 0)));
        break;
      default:
        t = truth_.distances()[static_cast<std::size_t>(
            below(random_, static_cast<int>(truth_.distances().size())))];
    }
    if (!(t > 0)) return std::nullopt;
    Result<S> result(t);
    const S answer = fcl::distance(pair_.A.get(), pair_.X, pair_.B.get(), pair_.Y,
                                   fcl::DistanceRequest<S>(), result);
    const std::string call = "result.min_distance = " + literal(t) +
                             "; fcl::DistanceRequest<S> request; fcl::distance(A.get(), X[0], "
                             "B.get(), X[1], request, result)";
    const double slack = truth_.tolerance(truth_.nearest);
    const std::pair<int, int> ids = {static_cast<int>(result.b1), static_cast<int>(result.b2)};
    if (!result.o1) {
      if (answer != t) return failure(Words() << answer << " without objects", call);
      // The nearest features may belong to several triangles: those of the full answer count.
      if (d < t && double{truth_.distance} < double{t} - slack) {
        return failure(Words() << "not nearer than " << t << "; brute force " << truth_.distance,
                       call);
      }
      return std::nullopt;
    }
    if (!(answer < t) || !truth_.contains(ids)) {
      return failure(Words() << answer << " does not beat " << t, call);
    }
    return judge(answer, ids, truth_, call);
  }

  Verdict tolerant() {
    const S rel = chance(random_, 0.7) ? static_cast<S>(power(random_, -8, -0.01)) : S{0};
    const S abs = chance(random_, 0.4)
                      ? static_cast<S>(truth_.extentOf(truth_.nearest) * power(random_, -8, 0))
                      : S{0};
    fcl::DistanceRequest<S> request(true);
    request.rel_err = rel;
    request.abs_err = abs;
    Result<S> result;
    const S d = fcl::distance(pair_.A.get(), pair_.X, pair_.B.get(), pair_.Y, request, result);
    const std::string call =
        "fcl::DistanceRequest<S> request(true); request.rel_err = " + literal(rel) +
        "; request.abs_err = " + literal(abs) +
        "; fcl::distance(A.get(), X[0], B.get(), X[1], request, result)";
    const std::pair<int, int> ids = {static_cast<int>(result.b1), static_cast<int>(result.b2)};
    if (!result.o1 || !truth_.contains(ids)) return failure(Words() << "no answer: " << d, call);
    const double e = truth_.distance, slack = truth_.tolerance(ids);
    const double allowed = std::max(double{rel} * (e + slack), double{abs}) + slack;
    if (d != truth_.distanceOf(ids) || !(double{d} - e <= allowed * (1 + 4 * truth_.kEps))) {
      return failure(
          Words() << d << " of " << text(ids) << "; brute force " << e << ", allowed " << allowed,
          call);
    }
    return std::nullopt;
  }

  Random random_;
  const ModelPair<S> pair_;
  const BruteForce<S> truth_, reverse_;
};

}  // namespace

Verdict askDistance(const Case& c) {
  return c.in_float ? DistanceQuestion<float>(c).run() : DistanceQuestion<double>(c).run();
}

}  // namespace kios::fuzz
