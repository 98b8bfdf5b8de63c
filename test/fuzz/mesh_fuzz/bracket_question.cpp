// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios::distanceBracket and kios::closerThan: the promises of DistanceBracketResult for every
// option.

#include "fcl_kios/distance.h"

#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "scenes/oracle.h"

namespace kios::fuzz {
namespace {

template <typename S>
class BracketQuestion {
 public:
  explicit BracketQuestion(const Case& c)
      : random_(c.draw),
        pair_(c),
        truth_(c.meshes[0], pair_.X, c.meshes[1], pair_.Y),
        exact_(kios::distanceBracket(*pair_.A, pair_.X, *pair_.B, pair_.Y)) {
    // The exact distance of the vertices and poses as they are given, where that is quick.
    if (truth_.distances().size() > 60 || !chance(random_, 0.3)) return;
    Mesh a = c.meshes[0], b = c.meshes[1];
    for (Mesh* mesh : {&a, &b}) {
      for (Vector3d& p : mesh->vertices) p = p.cast<S>().template cast<double>();
    }
    const double given = scenes::MeshOracle(a, b).distanceBruteForce(
        pair_.X.template cast<double>(), pair_.Y.template cast<double>());
    // The oracle's signs are not exact for slivers: it counts where it agrees with the kernel as
    // far as the frame's rounding lets it.
    const double apart = 16 * truth_.kEpsInDouble * truth_.extentOf(truth_.nearest) +
                         truth_.frameError(truth_.nearest.second);
    if (std::abs(given - truth_.in_double) <= apart) given_ = given;
  }

  Verdict brackets() {
    if (auto wrong = judge(exact_, {}, "auto answer = kios::distanceBracket(*A, X[0], *B, X[1])"))
      return wrong;
    for (int i = 0; i < 8; ++i) {
      if (auto wrong = withOptions()) return wrong;
    }
    return std::nullopt;
  }

  Verdict closer() {
    if (auto wrong = judge(exact_, {}, "auto answer = kios::distanceBracket(*A, X[0], *B, X[1])"))
      return wrong;
    for (int i = 0; i < 10; ++i) {
      const S t = threshold();
      WarmStart start = anyStart();
      const bool warm = chance(random_, 0.3);
      DistanceBracketResult<S> certificate;
      const bool is = closerThan<S>(*pair_.A, pair_.X, *pair_.B, pair_.Y, t, &certificate,
                                    warm ? &start : nullptr);
      const std::string call =
          "bool closer = kios::closerThan(*A, X[0], *B, X[1], " + literal(t) + ")";
      if (is != (exact_.distance <= t)) {
        return failure(Words() << "closerThan(" << t << ") is " << (is ? "true" : "false")
                               << ", but the distance is " << exact_.distance,
                       call);
      }
      if (closerThan<S>(*pair_.A, pair_.X, *pair_.B, pair_.Y, t) != is) {
        return failure(Words() << "closerThan(" << t << ") without a certificate is not "
                               << (is ? "true" : "false"),
                       call);
      }
      if (t < 0) continue;
      DistanceBracketRequest<S> any;  // the certificate is no answer to options
      any.near_enough = certificate.stop == DistanceStop::kNear ? certificate.distance : S{0};
      any.far_enough = certificate.stop == DistanceStop::kFar ? certificate.lower_bound
                                                              : std::numeric_limits<S>::infinity();
      any.nearest_points = false;
      if (auto wrong = judge(certificate, any, call)) return wrong;
      const bool proves =
          is ? certificate.distance <= t : certificate.lower_bound > t || certificate.distance > t;
      if (!proves && t < std::numeric_limits<S>::infinity()) {
        return failure(Words() << "a certificate of [" << certificate.lower_bound << ", "
                               << certificate.distance << "] for " << (is ? "true" : "false"),
                       call);
      }
    }
    return std::nullopt;
  }

 private:
  /// Returns a length at which something happens: a distance of triangles, of vertices, give or
  /// take.
  S threshold() {
    if (chance(random_, 0.05)) return chance(random_, 0.5) ? S{0} : S{-1};
    if (chance(random_, 0.02)) return std::numeric_limits<S>::infinity();
    const double d = exact_.distance;
    switch (below(random_, 4)) {
      case 0:
        return ulps(exact_.distance, scenes::integer(random_, -6, 6));
      case 1: {
        const auto& all = truth_.distances();
        const auto i = static_cast<std::size_t>(below(random_, static_cast<int>(all.size())));
        return ulps(all[i], scenes::integer(random_, -6, 6));
      }
      case 2:
        return static_cast<S>(d * (1 + scenes::randomSign(random_) * power(random_, -16, 0)));
      default:
        return static_cast<S>((d + 1e-3 * truth_.extentOf(truth_.nearest)) *
                              random_.uniform(0.1, 3));
    }
  }

  WarmStart anyStart() {
    WarmStart start;
    if (chance(random_, 0.3)) return {exact_.triangle_a, exact_.triangle_b};
    start.triangle_a = scenes::integer(random_, -2, pair_.A->num_tris);
    start.triangle_b = scenes::integer(random_, -2, pair_.B->num_tris);
    return start;
  }

  Verdict withOptions() {
    DistanceBracketRequest<S> options;
    const double L = truth_.extentOf(truth_.nearest);
    if (chance(random_, 0.3)) options.rel_err = static_cast<S>(power(random_, -6, 1));
    if (chance(random_, 0.2)) options.abs_err = static_cast<S>(L * power(random_, -6, 0));
    if (chance(random_, 0.5)) options.near_enough = threshold();
    if (chance(random_, 0.3)) options.far_enough = threshold();
    if (chance(random_, 0.2)) options.max_expansions = below(random_, 20);
    options.nearest_points = chance(random_, 0.5);
    WarmStart start = anyStart();
    const bool warm = chance(random_, 0.3);

    std::ostringstream call;
    call << "kios::DistanceBracketRequest<S> o; o.rel_err = " << literal(options.rel_err)
         << "; o.abs_err = " << literal(options.abs_err)
         << "; o.near_enough = " << literal(options.near_enough)
         << "; o.far_enough = " << literal(options.far_enough)
         << "; o.max_expansions = " << options.max_expansions << "; ";
    if (warm) {
      call << "kios::WarmStart w = {" << start.triangle_a << ", " << start.triangle_b
           << "}; o.warm_start = &w; ";
      options.warm_start = &start;
    }
    call << "auto answer = kios::distanceBracket(*A, X[0], *B, X[1], o)";
    const WarmStart before = start;
    const auto answer = kios::distanceBracket(*pair_.A, pair_.X, *pair_.B, pair_.Y, options);
    if (auto wrong = judge(answer, options, call.str())) return wrong;
    // A larger budget never gives a wider bracket.
    constexpr long long kMost = std::numeric_limits<long long>::max();
    if (options.max_expansions == kMost) return std::nullopt;
    start = before;
    options.max_expansions = 2 * options.max_expansions + 1;
    const auto more = kios::distanceBracket(*pair_.A, pair_.X, *pair_.B, pair_.Y, options);
    const double before_width = double{answer.distance} - double{answer.lower_bound};
    const double width = double{more.distance} - double{more.lower_bound};
    const double rounding = 64 * truth_.kEps * (L + double{truth_.distance});
    if (more.stop != DistanceStop::kFar && more.stop != DistanceStop::kNear &&
        !(width <= before_width + rounding)) {
      return failure(Words() << "a larger budget gives [" << more.lower_bound << ", "
                             << more.distance << "] after [" << answer.lower_bound << ", "
                             << answer.distance << "]",
                     call.str());
    }
    return judge(more, options,
                 call.str() + " with a budget of " + std::to_string(options.max_expansions));
  }

  Verdict judge(const DistanceBracketResult<S>& answer, const DistanceBracketRequest<S>& options,
                const std::string& call) const {
    const char* fault = faultOf(answer, options);
    if (!fault) {
      const std::pair<int, int> ids = {answer.triangle_a, answer.triangle_b};
      const bool points = options.nearest_points && answer.triangle_a >= 0;
      if (points != answer.point_a.allFinite()) {
        fault = "points that were not asked for, or none";
      } else if (points) {
        const auto wrong = faultOfPoints<S>(truth_, ids, answer.point_a, answer.point_b,
                                            answer.distance, pair_.X, pair_.Y);
        if (wrong) return failure(Words() << *wrong, call);
      }
    }
    if (!fault) return std::nullopt;
    constexpr const char* kStops[] = {"kTolerance", "kFar", "kNear", "kBudget"};
    Words words;
    words << fault << ": lower bound " << answer.lower_bound << ", distance " << answer.distance
          << ", upper bound " << answer.upper_bound << ", triangles (" << answer.triangle_a << ", "
          << answer.triangle_b << "), stop " << kStops[static_cast<int>(answer.stop)]
          << "; brute force " << truth_.distance << " of " << text(truth_.nearest)
          << "; default answer " << exact_.distance;
    if (given_ >= 0) words << "; as given " << given_;
    return failure(words, call);
  }

  const char* faultOf(const DistanceBracketResult<S>& answer,
                      const DistanceBracketRequest<S>& options) const {
    const std::pair<int, int> ids = {answer.triangle_a, answer.triangle_b};
    const double lower = answer.lower_bound, distance = answer.distance, upper = answer.upper_bound,
                 exact = truth_.distance;
    const double slack = 16 * truth_.kEps * truth_.extentOf(truth_.nearest) + truth_.kLeast;
    if (!(lower <= exact + slack)) return "the lower bound exceeds the distance";
    if (!(upper >= exact - slack)) return "the upper bound is below the distance";
    if (given_ >= 0) {  // right to long double's rounding
      const double rounding = 0x1p-53 * given_ + slack * (sizeof(S) == 4 ? 1e-9 : 1e-2);
      if (!(lower <= given_ + rounding)) return "the lower bound exceeds the exact distance";
      if (!(upper >= given_ - rounding)) return "the upper bound is below the exact distance";
    }
    if (!(lower >= 0 && lower <= distance && distance <= upper)) return "bounds out of order";
    if (answer.triangle_a < 0) {
      if (!std::isinf(distance) || answer.triangle_b >= 0) return "a distance of no triangles";
    } else {
      if (!truth_.contains(ids)) return "triangles that don't exist";
      if (answer.distance != truth_.distanceOf(ids)) return "not the distance of its triangles";
    }
    if (distance == 0 && lower != 0) return "a lower bound at contact";
    switch (answer.stop) {
      case DistanceStop::kTolerance: {
        if (answer.triangle_a < 0) return "no answer";
        const double allowed = std::max(double{options.rel_err} * exact, double{options.abs_err});
        if (!(distance <= exact + allowed * (1 + 4 * truth_.kEps) + truth_.tolerance(ids))) {
          return "error too large";
        }
        const bool same = answer.distance == exact_.distance &&
                          (distance == 0 || (answer.triangle_a == exact_.triangle_a &&
                                             answer.triangle_b == exact_.triangle_b));
        const bool is_exact = options.rel_err == 0 && options.abs_err == 0 &&
                              options.max_expansions == std::numeric_limits<long long>::max() &&
                              !hasManyNearest();
        return is_exact && !same ? "not the default answer, though exact" : nullptr;
      }
      case DistanceStop::kNear:
        return answer.distance <= options.near_enough ? nullptr : "not near";
      case DistanceStop::kFar:
        return answer.lower_bound >= options.far_enough || options.far_enough <= 0 ? nullptr
                                                                                   : "not far";
      case DistanceStop::kBudget:
        return answer.counts.expansions <= options.max_expansions ? nullptr : "over the budget";
    }
    return "no reason to stop";
  }

  /// Whether so many pairs are as near as the search's floats, or the kernel's rounding, can tell
  /// that an exact search ends at any of them.
  bool hasManyNearest() const {
    constexpr long kMany = 64;  // a thousand of their edges and corners
    const auto& all = truth_.distances();
    const double limit =
        truth_.distance * (1 + 0x1p-20) + 64 * truth_.kEps * truth_.extentOf(truth_.nearest);
    return std::count_if(all.begin(), all.end(), [limit](S d) { return d <= limit; }) >= kMany;
  }

  Random random_;
  const ModelPair<S> pair_;
  const BruteForce<S> truth_;
  const DistanceBracketResult<S> exact_;
  double given_ = -1;  ///< the exact distance in the exact frame; negative: not computed
};

}  // namespace

Verdict askBracket(const Case& c) {
  return c.in_float ? BracketQuestion<float>(c).brackets() : BracketQuestion<double>(c).brackets();
}

Verdict askCloser(const Case& c) {
  return c.in_float ? BracketQuestion<float>(c).closer() : BracketQuestion<double>(c).closer();
}

}  // namespace kios::fuzz
