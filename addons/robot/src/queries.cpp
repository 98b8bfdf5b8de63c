// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a robot is asked, one by one and in batches.

#include <cmath>
#include <utility>

#include "batch.h"
#include "robot_impl.h"

namespace kios {

using robot::refuse;

namespace {

void requireOptions(const ClearanceOptions& options) {
  if (!(options.rel_err >= 0) || !(options.abs_err >= 0) || std::isinf(options.rel_err) ||
      std::isinf(options.abs_err)) {
    refuse("ClearanceOptions::rel_err and abs_err must be finite and >= 0.");
  }
  if (std::isnan(options.far_enough)) refuse("ClearanceOptions::far_enough is NaN.");
}

/// Checks the columns of a batch before any is answered.
template <typename Impl>
void requireColumns(const Impl& impl, const Eigen::MatrixXd& q, const char* what) {
  if (q.rows() != impl.arm->tree.coordinates()) {
    refuse(std::string(what) + " has " + std::to_string(q.rows()) + " rows, but " +
           impl.arm->description.name + " has " + std::to_string(impl.arm->tree.coordinates()) +
           " coordinates; a configuration is a column.");
  }
  const bool fine = q.allFinite() && q.lpNorm<Eigen::Infinity>() <= 0x1p300;
  for (Eigen::Index i = 0; i < q.cols() && !fine; ++i) {
    impl.requireConfiguration(q.col(i),
                              (std::string(what) + ", column " + std::to_string(i)).c_str());
  }
}

}  // namespace

std::optional<RobotContact> Robot::contact(const Eigen::VectorXd& q) const {
  impl_->requireConfiguration(q, "q");
  return impl_->cell().contact(q);
}

RobotClearance Robot::clearance(const Eigen::VectorXd& q, const ClearanceOptions& options) const {
  impl_->requireConfiguration(q, "q");
  requireOptions(options);
  return impl_->cell().clearance(q, options);
}

std::vector<RobotClearance> Robot::clearances(const Eigen::VectorXd& q, double within) const {
  impl_->requireConfiguration(q, "q");
  if (std::isnan(within)) refuse("`within` is NaN.");
  return impl_->cell().clearances(q, within);
}

RobotMotion Robot::checkMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                               const MotionRequest& request) const {
  impl_->requireConfiguration(q0, "q0");
  impl_->requireConfiguration(q1, "q1");
  const robot::Cell& cell = impl_->cell();
  return cell.checkMotion(cell.proofs(), q0, q1, request);
}

std::vector<char> Robot::contacts(const Eigen::MatrixXd& q, int threads) const {
  requireColumns(*impl_, q, "q");
  const robot::Cell& cell = impl_->cell();
  std::vector<char> result(static_cast<std::size_t>(q.cols()), 0);
  robot::forAll(q.cols(), robot::threadsFor(threads, q.cols()), [&](long long i, int /*thread*/) {
    result[static_cast<std::size_t>(i)] = cell.inContact(q.col(i)) ? 1 : 0;
  });
  return result;
}

std::vector<RobotClearance> Robot::clearances(const Eigen::MatrixXd& q,
                                              const ClearanceOptions& options, int threads) const {
  requireColumns(*impl_, q, "q");
  requireOptions(options);
  const robot::Cell& cell = impl_->cell();
  std::vector<RobotClearance> result(static_cast<std::size_t>(q.cols()));
  robot::forAll(q.cols(), robot::threadsFor(threads, q.cols()), [&](long long i, int /*thread*/) {
    result[static_cast<std::size_t>(i)] = cell.clearance(q.col(i), options);
  });
  return result;
}

// A linkage keeps the memory of one search for the next: each thread has a copy.
std::vector<RobotMotion> Robot::checkMotions(const Eigen::MatrixXd& q0, const Eigen::MatrixXd& q1,
                                             const MotionRequest& request, int threads) const {
  requireColumns(*impl_, q0, "q0");
  requireColumns(*impl_, q1, "q1");
  if (q0.cols() != q1.cols()) refuse("q0 and q1 have different numbers of columns.");
  const robot::Cell& cell = impl_->cell();
  const int count = robot::threadsFor(threads, q0.cols());
  std::vector<std::vector<robot::Cell::Proof>> proofs(static_cast<std::size_t>(count));
  for (std::size_t i = 1; i < proofs.size(); ++i) proofs[i] = cell.proofs();
  std::vector<RobotMotion> result(static_cast<std::size_t>(q0.cols()));
  robot::forAll(q0.cols(), count, [&](long long i, int thread) {
    const auto& own = thread == 0 ? cell.proofs() : proofs[static_cast<std::size_t>(thread)];
    result[static_cast<std::size_t>(i)] = cell.checkMotion(own, q0.col(i), q1.col(i), request);
  });
  return result;
}

}  // namespace kios
