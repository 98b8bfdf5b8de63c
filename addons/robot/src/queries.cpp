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

void requireOptions(const ClearanceRequest& options) {
  if (!(options.rel_err >= 0) || !(options.abs_err >= 0) || std::isinf(options.rel_err) ||
      std::isinf(options.abs_err)) {
    refuse("rel_err and abs_err must be finite and >= 0.");
  }
  if (std::isnan(options.far_enough)) refuse("far_enough is NaN.");
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

/// Refuses a configuration beyond the limits, by the name of the joint.
void requireWithin(const robot::Arm& arm, const Eigen::VectorXd& q, const std::string& what) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (q[i] >= arm.tree.lower[i] && q[i] <= arm.tree.upper[i]) continue;
    refuse(what + " is beyond the limits of the joint '" +
           arm.tree.names[static_cast<std::size_t>(i)] + "'.");
  }
}

/// Refuses a box that isn't one of the robot's, by the names of its joints.
void requireBox(const robot::Arm& arm, const JointBox& box, bool within_limits) {
  const auto size = static_cast<std::size_t>(arm.tree.coordinates());
  if (box.lower.size() != size || box.upper.size() != size) {
    refuse("a box has " + std::to_string(box.lower.size()) + " lower and " +
           std::to_string(box.upper.size()) + " upper ends, but " + arm.description.name + " has " +
           std::to_string(size) + " coordinates.");
  }
  for (std::size_t i = 0; i < size; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const std::string range = "the range of the joint '" + arm.tree.names[i] + "'";
    if (!(box.lower[i] <= box.upper[i])) {
      refuse(range + " is NaN or empty: its lower end must not be above its upper one.");
    }
    const bool within = box.lower[i] >= arm.tree.lower[k] && box.upper[i] <= arm.tree.upper[k];
    if (within_limits && !within) refuse(range + " is outside of the joint's limits.");
  }
}

}  // namespace

std::optional<RobotContact> Robot::contact(const Eigen::VectorXd& q) const {
  impl_->requireConfiguration(q, "q");
  return impl_->cell().contact(q);
}

RobotClearance Robot::clearance(const Eigen::VectorXd& q, const ClearanceRequest& options) const {
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
                               const RobotMotionRequest& request) const {
  impl_->requireConfiguration(q0, "q0");
  impl_->requireConfiguration(q1, "q1");
  if (request.within_limits) {
    requireWithin(*impl_->arm, q0, "q0");
    requireWithin(*impl_->arm, q1, "q1");
  }
  const robot::Cell& cell = impl_->cell();
  return cell.checkMotion(cell.proofs(), q0, q1, request);
}

RobotRange Robot::leastClearance(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                 const RangeRequest& request) const {
  impl_->requireConfiguration(q0, "q0");
  impl_->requireConfiguration(q1, "q1");
  return leastClearance(std::vector{q0, q1}, request);
}

RobotRange Robot::leastClearance(const std::vector<Eigen::VectorXd>& path,
                                 const RangeRequest& request) const {
  if (path.size() < 2) refuse("a path has two configurations or more.");
  for (const Eigen::VectorXd& q : path)
    impl_->requireConfiguration(q, "a configuration of the path");
  return impl_->cell().leastClearance(request, [&](const Linkage& linkage, const auto& padded) {
    return robot::Cell::leastOf(path.size() - 1, padded, [&](std::size_t i, const auto& part) {
      return kios::leastClearance(linkage, path[i], path[i + 1], part);
    });
  });
}

RobotRange Robot::leastClearance(const JointBox& box, const RangeRequest& request,
                                 bool within_limits) const {
  requireBox(*impl_->arm, box, within_limits);
  return impl_->cell().leastClearance(request, [&](const Linkage& linkage, const auto& padded) {
    return kios::leastClearance(linkage, box, padded);
  });
}

std::vector<RobotRange> Robot::leastClearances(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                               const RangeRequest& request) const {
  impl_->requireConfiguration(q0, "q0");
  impl_->requireConfiguration(q1, "q1");
  return impl_->cell().leastClearances(request, [&](const Linkage& linkage, const auto& padded) {
    return kios::leastClearances(linkage, q0, q1, padded);
  });
}

std::vector<RobotRange> Robot::leastClearances(const JointBox& box, const RangeRequest& request,
                                               bool within_limits) const {
  requireBox(*impl_->arm, box, within_limits);
  return impl_->cell().leastClearances(request, [&](const Linkage& linkage, const auto& padded) {
    return kios::leastClearances(linkage, box, padded);
  });
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
                                              const ClearanceRequest& options, int threads) const {
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
                                             const RobotMotionRequest& request, int threads) const {
  requireColumns(*impl_, q0, "q0");
  requireColumns(*impl_, q1, "q1");
  if (q0.cols() != q1.cols()) refuse("q0 and q1 have different numbers of columns.");
  for (Eigen::Index i = 0; request.within_limits && i < q0.cols(); ++i) {
    requireWithin(*impl_->arm, q0.col(i), "q0, column " + std::to_string(i) + ",");
    requireWithin(*impl_->arm, q1.col(i), "q1, column " + std::to_string(i) + ",");
  }
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
