// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/distance.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "query/engine_pair.h"
#include "query/mesh_pair.h"
#include "query/tree_search.h"
#include "volume/rounding.h"

namespace kios {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename S>
constexpr double kUlp = sizeof(S) == sizeof(double) ? kUlpDouble : kUlpFloat;

template <typename S>
constexpr double kLeast = std::numeric_limits<S>::min();  // results below are rounded absolutely

template <typename T>
void require(bool valid, const char* name, T value, const char* range) {
  if (valid) return;
  std::ostringstream message;
  message << "fcl_kios: " << name << " is " << value << ", but must be " << range << ".";
  throw std::invalid_argument(message.str());
}

template <typename S>
void requireValid(const DistanceOptions<S>& o) {
  require(o.rel_err >= 0, "DistanceOptions::rel_err", o.rel_err, ">= 0");
  require(o.abs_err >= 0, "DistanceOptions::abs_err", o.abs_err, ">= 0");
  require(!std::isnan(o.far_enough), "DistanceOptions::far_enough", o.far_enough, "a number");
  require(!std::isnan(o.near_enough), "DistanceOptions::near_enough", o.near_enough, "a number");
  require(o.max_expansions >= 0, "DistanceOptions::max_expansions", o.max_expansions, ">= 0");
}

/// Two models at a pose, and how far computed distances may be from the exact ones.
template <typename S>
struct ModelPair {
  ModelPair(const Model<S>& m1, const fcl::Transform3<S>& X_W1, const Model<S>& m2,
            const fcl::Transform3<S>& X_W2)
      : model1(m1), model2(m2), X_12((requireFinished(m1), requireFinished(m2), X_W1), X_W2) {}

  const kIOS<S>& root1() const { return model1.getBV(0).bv; }
  const kIOS<S>& root2() const { return model2.getBV(0).bv; }

  /// Of a point of model 2 with |x|_1 <= norm1: 4 eps (|x| + |t|) in each of three coordinates.
  double frameError(double norm1) const {
    return 16 * kUlp<S> * (1.01 * norm1 + 1.01 * X_12.T_norm1);
  }

  /// Of the distance d of any triangles: 16 eps of their extent, at most 1.74 (d + 2 r1 + 2 r2),
  /// and the frame's.
  double searchError(double d) const {
    const kIOS<S>& b = root2();
    const double c1 = std::abs(double{b.center0[0]}) + std::abs(double{b.center0[1]}) +
                      std::abs(double{b.center0[2]});
    const double extent = 1.74 * (d + 2 * double{root1().radius0} + 2 * double{b.radius0});
    return 32 * kUlp<S> * extent + frameError(c1 + 1.8 * double{b.radius0}) + kLeast<S>;
  }

  /// The same for two triangles.
  double errorOf(const engine::TrianglePairIds& ids) const {
    const auto p = cornersOf(model1, ids.a), local = cornersOf(model2, ids.b);
    const auto q = transformed(local, X_12);
    double norm1 = 0;
    fcl::Vector3<S> low = p[0], high = p[0];
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(p[k]).cwiseMin(q[k]);
      high = high.cwiseMax(p[k]).cwiseMax(q[k]);
      norm1 = std::max(norm1, local[k].template cast<double>().template lpNorm<1>());
    }
    const double extent = (high - low).template cast<double>().stableNorm();
    return 33 * kUlp<S> * extent + frameError(norm1) + kLeast<S>;
  }

  const Model<S>&model1, &model2;
  const RelativePose<S> X_12;
};

/// Sets what was proven. `other` bounds all pairs that weren't evaluated.
template <typename S>
void setBounds(const ModelPair<S>& models, const engine::BracketResult<S>& found,
               DistanceAnswer<S>& answer) {
  double lower = found.least_other;
  if (found.least_evaluated < kInfinity) {
    const double error = models.searchError(found.least_evaluated);
    lower = std::min(lower, std::max(0.0, found.least_evaluated - error));
  }
  if (found.ids.a >= 0) {
    answer.distance = found.nearest.distance;
    answer.upper_bound = roundUp<S>(double{answer.distance} + models.errorOf(found.ids));
    answer.triangle1 = found.ids.a;
    answer.triangle2 = found.ids.b;
    lower = std::min(lower, double{answer.distance});
  }
  answer.lower_bound = std::max(answer.lower_bound, roundDown<S>(lower));
}

/// near_enough and far_enough in double, as closerThan() needs them between two floats.
template <typename S>
DistanceAnswer<S> search(const ModelPair<S>& models, const fcl::Transform3<S>& X_W1,
                         const engine::BracketQuery<S>& query, const DistanceOptions<S>& options) {
  DistanceAnswer<S> answer;
  if (query.far_enough <= 0) {
    answer.stop = DistanceStop::kFar;
    return answer;
  }
  if (query.far_enough < kInfinity || query.hasBudget()) {
    const double enough = std::min(query.far_enough, 0x1p1000);
    const double roots = separation(models.root1(), models.root2(), models.X_12, enough);
    answer.lower_bound = roundDown<S>(std::max(0.0, roots));
    if (double{answer.lower_bound} >= query.far_enough) {
      answer.stop = DistanceStop::kFar;
      return answer;
    }
  }
  engine::BracketResult<S> found;
  if (const EnginePair<S> engine(models.model1, models.model2, models.X_12); engine) {
    found = engine::bracketDistance(engine.pair(), query, answer.counts);
  } else {
    const double rounding = models.searchError(0);
    found =
        bracketInTree(models.model1, models.model2, models.X_12, query, rounding, answer.counts);
  }
  setBounds(models, found, answer);
  if (answer.distance == 0) {
    answer.stop = DistanceStop::kTolerance;
  } else if (found.end == engine::SearchEnd::kNear) {
    answer.stop = DistanceStop::kNear;
  } else if (double{answer.lower_bound} >= query.far_enough) {
    answer.stop = DistanceStop::kFar;
  } else if (found.end == engine::SearchEnd::kBudget) {
    answer.stop = DistanceStop::kBudget;
  }
  if (found.ids.a >= 0 && options.nearest_points) {
    answer.point1 = transform<S>(X_W1, found.nearest.point_a);
    answer.point2 = transform<S>(X_W1, found.nearest.point_b);
  }
  // Within rounding of far_enough neither this is proven nor all that is nearer than the answer was
  // looked at: a search without it decides. With a budget the bracket stands as it is.
  if (found.end == engine::SearchEnd::kDone && double{answer.distance} > query.far_enough &&
      double{answer.lower_bound} < query.far_enough) {
    if (query.hasBudget()) {
      answer.stop = DistanceStop::kBudget;
    } else {
      engine::BracketQuery<S> unlimited = query;
      unlimited.far_enough = kInfinity;
      const SearchCounts before = answer.counts;
      answer = search(models, X_W1, unlimited, options);
      answer.counts += before;
    }
  }
  if (answer.triangle1 >= 0 && options.warm_start) {
    *options.warm_start = {answer.triangle1, answer.triangle2};
  }
  return answer;
}

template <typename S>
engine::BracketQuery<S> queryOf(const DistanceOptions<S>& options) {
  engine::BracketQuery<S> query;
  query.rel_err = options.rel_err;
  query.abs_err = options.abs_err;
  query.near_enough = options.near_enough;
  query.far_enough = options.far_enough;
  query.max_expansions = options.max_expansions;
  if (options.warm_start)
    query.start = {options.warm_start->triangle1, options.warm_start->triangle2};
  return query;
}

}  // namespace

template <typename S>
DistanceAnswer<S> distance(const Model<S>& model1, const fcl::Transform3<S>& X_W1,
                           const Model<S>& model2, const fcl::Transform3<S>& X_W2,
                           const DistanceOptions<S>& options) {
  requireValid(options);
  return search(ModelPair<S>(model1, X_W1, model2, X_W2), X_W1, queryOf(options), options);
}

// Within searchError() of t an exact answer decides. Farther from it no rounding can part this
// verdict from the exact answer's: the pair that realises that is not farther than the pair found
// here, and not nearer than what was proven, by more than searchError().
template <typename S>
bool closerThan(const Model<S>& model1, const fcl::Transform3<S>& X_W1, const Model<S>& model2,
                const fcl::Transform3<S>& X_W2, std::common_type_t<S> t,
                std::common_type_t<DistanceAnswer<S>>* certificate, WarmStart* warm_start) {
  require(!std::isnan(t), "the distance asked for", t, "a number");
  const ModelPair<S> models(model1, X_W1, model2, X_W2);
  DistanceAnswer<S> unused;
  DistanceAnswer<S>& answer = certificate ? *certificate : unused;
  answer = DistanceAnswer<S>();
  if (t < 0) {
    answer.stop = DistanceStop::kFar;
    return false;
  }
  DistanceOptions<S> options;
  options.nearest_points = false;
  options.warm_start = warm_start;
  engine::BracketQuery<S> query = queryOf(options);
  const double error = models.searchError(t);
  query.near_enough = t < kInfinity ? t - error : t;
  query.far_enough = t + 2 * error;
  answer = search(models, X_W1, query, options);
  if (answer.stop == DistanceStop::kFar) return false;
  if (answer.distance == 0 || double{answer.distance} <= query.near_enough) return true;
  const SearchCounts before = answer.counts;
  answer = search(models, X_W1, queryOf(options), options);
  answer.counts += before;
  return answer.distance <= t;
}

#define KIOS_INSTANTIATE(S)                                                                        \
  template DistanceAnswer<S> distance(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&, \
                                      const fcl::Transform3<S>&, const DistanceOptions<S>&);       \
  template bool closerThan(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&,            \
                           const fcl::Transform3<S>&, std::common_type_t<S>, DistanceAnswer<S>*,   \
                           WarmStart*);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
