// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl_kios/fcl_kios.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <functional>
#include <utility>

/// A state of a RealVectorStateSpace.
inline Eigen::VectorXd coordinates(const ompl::base::SpaceInformation& si,
                                   const ompl::base::State* state) {
  const auto* own = state->as<ompl::base::RealVectorStateSpace::StateType>();
  return Eigen::Map<const Eigen::VectorXd>(own->values,
                                           static_cast<Eigen::Index>(si.getStateDimension()));
}

/// OMPL's question about an edge, answered by a proof: that of kios::checkMotion() of a linkage, or
/// of kios::Robot::checkMotion().
class ProvingValidator : public ompl::base::MotionValidator {
 public:
  using State = ompl::base::State;
  using Proof = std::function<kios::MotionResult(
      const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, const kios::MotionRequest& request)>;

  ProvingValidator(const ompl::base::SpaceInformationPtr& si, Proof proof)
      : ompl::base::MotionValidator(si), proof_(std::move(proof)) {}

  bool checkMotion(const State* from, const State* to) const override {
    const auto answer = proof_(coordinates(*si_, from), coordinates(*si_, to), {});
    return answer.verdict == kios::MotionVerdict::kClear;
  }
  /// Also sets how far the path is clear: up to the first contact.
  bool checkMotion(const State* from, const State* to,
                   std::pair<State*, double>& last_valid) const override {
    kios::MotionRequest request;
    request.first_contact = true;
    const auto answer = proof_(coordinates(*si_, from), coordinates(*si_, to), request);
    if (answer.verdict == kios::MotionVerdict::kClear) return true;
    last_valid.second = answer.from;
    if (last_valid.first) {
      si_->getStateSpace()->interpolate(from, to, answer.from, last_valid.first);
    }
    return false;
  }

 private:
  Proof proof_;
};
