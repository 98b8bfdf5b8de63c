// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <fcl_kios/fcl_kios.h>

#include "error_competitor.h"

namespace kios::bench {
namespace {

class KiosErrorCompetitor final : public ErrorCompetitor {
 public:
  const char* name() const override { return "kios"; }
  bool serves(const ErrorSetting& /*setting*/) const override { return true; }

  void load(const scenes::Mesh& a, const scenes::Mesh& b) override {
    a_ = scenes::buildModel<kIOSd>(a);
    b_ = scenes::buildModel<kIOSd>(b);
    prepare(*a_);
    prepare(*b_);
  }

  void answer(const ErrorSetting& setting, const std::vector<ErrorQuestion>& questions,
              std::size_t begin, std::size_t end, std::vector<ErrorAnswer>& answers) override {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [X_WA, X_WB] = questions[i].poses;
      switch (setting.query) {
        case ErrorSetting::kDistance: {
          fcl::DistanceRequestd request;
          request.rel_err = setting.rel_err;
          request.abs_err = setting.abs_err;
          fcl::DistanceResultd result;
          answers[i].upper = fcl::distance(a_.get(), X_WA, b_.get(), X_WB, request, result);
          break;
        }
        case ErrorSetting::kThreshold: {
          const double threshold = *setting.threshold * questions[i].distance;
          const bool closer = closerThan(*a_, X_WA, *b_, X_WB, threshold);
          answers[i].upper = closer ? 0 : std::numeric_limits<double>::infinity();
          break;
        }
        case ErrorSetting::kBracket:
        case ErrorSetting::kBudget: {
          DistanceOptions<double> options;
          options.rel_err = setting.rel_err;
          options.abs_err = setting.abs_err;
          if (setting.budget) options.max_expansions = *setting.budget;
          options.nearest_points = false;
          const auto answer = kios::distance(*a_, X_WA, *b_, X_WB, options);
          answers[i] = {answer.lower_bound, answer.distance};
        }
      }
    }
  }

 private:
  std::shared_ptr<Modeld> a_, b_;
};

}  // namespace

std::unique_ptr<ErrorCompetitor> makeKiosErrorCompetitor() {
  return std::make_unique<KiosErrorCompetitor>();
}

}  // namespace kios::bench
