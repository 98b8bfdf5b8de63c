// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "paper/enclosing_ellipsoid.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace kios {
namespace {

constexpr int kMostRounds = 1000;

/// Weights of points in R^d, d <= 3, that maximise the determinant of M = sum u q q^T over the
/// lifted points q = (p, 1) in R^n, n = d + 1: the dual of the smallest enclosing ellipsoid.
/// Optimal if q^T M^-1 q <= n for all points; the ellipsoid is x^T C^-1 x <= d around the weighted
/// mean, C the weighted covariance.
class WeightSearch {
 public:
  /// `points`: d coordinates a column, spread by about 1 in every direction.
  explicit WeightSearch(Eigen::Matrix3Xd points, int d)
      : points_(std::move(points)),
        n_(d + 1),
        weights_(Eigen::VectorXd::Zero(points_.cols())),
        variance_(points_.cols()) {
    start();
  }

  /// Until max q^T M^-1 q <= n (1 + tolerance).
  void run(double tolerance) {
    std::vector<int> candidates(weights_.size());
    std::iota(candidates.begin(), candidates.end(), 0);
    const std::vector<int> all = candidates;
    for (int round = 0; round < kMostRounds; ++round) {
      updateInverse();
      double excess = measure(candidates);
      if (excess <= tolerance) {
        excess = measure(all);  // what was eliminated counts as well
        if (excess <= tolerance) return;
        candidates = all;
      }
      exchange(candidates);
      eliminate(excess, candidates);
    }
  }

  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  Eigen::Vector4d lifted(int i) const { return {points_(0, i), points_(1, i), points_(2, i), 1}; }

  /// All of a few points, else those that are extreme along the axes and diagonals.
  void start() {
    const int count = static_cast<int>(weights_.size());
    if (count <= 8) {
      weights_.setConstant(1.0 / count);
      return;
    }
    for (int direction = 0; direction < 13; ++direction) {  // half of the 26 of a cube
      const int x = direction % 3 - 1, y = direction / 3 % 3 - 1, z = direction / 9 - 1;
      const Eigen::Vector3d v(x, y, z);
      Eigen::Index low = 0, high = 0;
      const Eigen::RowVectorXd heights = v.transpose() * points_;
      heights.minCoeff(&low);
      heights.maxCoeff(&high);
      weights_[low] = weights_[high] = 1;
    }
    weights_ /= weights_.sum();
  }

  void updateInverse() {
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    for (Eigen::Index i = 0; i < weights_.size(); ++i) {
      if (weights_[i] == 0) continue;
      const Eigen::Vector4d q = lifted(static_cast<int>(i));
      M += weights_[i] * q * q.transpose();
    }
    // Coordinates beyond d are 0: a unit there leaves the rest alone.
    for (int c = n_ - 1; c < 3; ++c) M(c, c) = 1;
    inverse_ = M.inverse();
  }

  /// Sets the variances q^T M^-1 q; returns the relative excess of the greatest over n.
  double measure(const std::vector<int>& among) {
    double greatest = 0;
    for (const int i : among) {
      const Eigen::Vector4d q = lifted(i);
      variance_[i] = q.dot(inverse_ * q);
      greatest = std::max(greatest, variance_[i]);
    }
    return greatest / n_ - 1;
  }

  /// Moves weight between every point that has some and the n of greatest variance.
  void exchange(const std::vector<int>& candidates) {
    support_.clear();
    for (const int i : candidates) {
      if (weights_[i] > 0) support_.push_back(i);
    }
    greedy_.resize(std::min<std::size_t>(n_, candidates.size()));
    std::partial_sort_copy(
        candidates.begin(), candidates.end(), greedy_.begin(), greedy_.end(), [this](int i, int j) {
          return variance_[i] > variance_[j] || (variance_[i] == variance_[j] && i < j);
        });
    for (const int to : greedy_) {
      for (const int from : support_) {
        if (from != to) exchange(from, to);
      }
    }
  }

  /// The exact line search from one point to the other (or back), and the inverse thereafter.
  void exchange(int from, int to) {
    const Eigen::Vector4d p = lifted(from), q = lifted(to), Mp = inverse_ * p, Mq = inverse_ * q;
    const double pp = p.dot(Mp), qq = q.dot(Mq), pq = p.dot(Mq);
    const double area = pp * qq - pq * pq;
    double step = qq > pp ? weights_[from] : -weights_[to];
    if (std::abs(qq - pp) < 2 * area * std::abs(step)) step = (qq - pp) / (2 * area);
    const double scale = 1 + step * (qq - pp) - step * step * area;  // the determinant's factor
    if (step == 0 || !(scale > 0.5)) return;
    inverse_ -= (step * (1 - step * pp) * Mq * Mq.transpose() -
                 step * (1 + step * qq) * Mp * Mp.transpose() +
                 step * step * pq * (Mp * Mq.transpose() + Mq * Mp.transpose())) /
                scale;
    weights_[from] = std::max(0.0, weights_[from] - step);
    weights_[to] = std::max(0.0, weights_[to] + step);
  }

  /// Drops points without weight that no optimal solution has in its support.
  void eliminate(double excess, std::vector<int>& candidates) const {
    const double bound =
        n_ * (1 + excess / 2 - std::sqrt(excess * (4 + excess - 4.0 / n_)) / 2) * (1 - 1e-9);
    candidates.erase(
        std::remove_if(candidates.begin(), candidates.end(),
                       [&](int i) { return weights_[i] == 0 && variance_[i] < bound; }),
        candidates.end());
  }

  const Eigen::Matrix3Xd points_;
  const int n_;
  Eigen::VectorXd weights_;
  std::vector<double> variance_;
  std::vector<int> support_, greedy_;
  Eigen::Matrix4d inverse_ = Eigen::Matrix4d::Identity();
};

}  // namespace

EnclosingEllipsoid smallestEllipsoid(Eigen::Matrix3Xd p, double tolerance) {
  const int count = static_cast<int>(p.cols());
  const Eigen::Vector3d first = p.col(0);
  p.colwise() -= first;  // equal points are then 0
  const Eigen::Vector3d from_first = p.rowwise().mean(), mean = first + from_first;
  p.colwise() -= from_first;

  // The problem is affinely invariant: solved where the spread is 1 in every direction left.
  EnclosingEllipsoid result;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(p * p.transpose() / count);
  Eigen::Matrix3d to_model = Eigen::Matrix3d::Zero();  // columns: direction times spread
  Eigen::Matrix3d directions;
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  const double largest = std::sqrt(std::max(0.0, spread.eigenvalues()[2]));
  for (int k = 0; k < 3; ++k) {
    directions.col(k) = spread.eigenvectors().col(2 - k);
    const double s = std::sqrt(std::max(0.0, spread.eigenvalues()[2 - k]));
    if (!(s > 1e-6 * largest)) continue;
    ++result.rank;
    to_model.col(k) = s * directions.col(k);
    inverse[k] = 1 / s;
  }
  result.center = mean;
  result.axes = directions;
  if (result.rank == 0) return result;
  const Eigen::Matrix3Xd white = inverse.asDiagonal() * directions.transpose() * p;
  WeightSearch search(white, result.rank);
  // q^T M^-1 q = 1 + x^T C^-1 x: n (1 + t) of it are rank (1 + t n / rank) of the latter.
  search.run(0.999 * tolerance * result.rank / (result.rank + 1));

  const Eigen::VectorXd& u = search.weights();
  const Eigen::Vector3d center = white * u;
  Eigen::Matrix3Xd around = white.colwise() - center;
  const Eigen::Matrix3d covariance = around * u.asDiagonal() * around.transpose();
  Eigen::Matrix3d padded = covariance;
  for (int c = result.rank; c < 3; ++c) padded(c, c) = 1;
  const Eigen::LLT<Eigen::Matrix3d> root(padded);
  root.matrixL().solveInPlace(around);
  const double reach = around.colwise().squaredNorm().maxCoeff() * (1 + 1e-12);
  const Eigen::Matrix3d L = root.matrixL();
  const Eigen::Matrix3d shape = to_model * L * std::sqrt(reach);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(shape, Eigen::ComputeFullU);
  result.center = mean + to_model * center;
  result.axes = svd.matrixU();
  result.half = svd.singularValues();
  for (int k = result.rank; k < 3; ++k) result.half[k] = 0;
  result.gap = std::max(0.0, reach / result.rank - 1);
  for (int i = 0; i < count; ++i) {
    if (u[i] > 0) result.weights.emplace_back(i, u[i]);
  }
  return result;
}

}  // namespace kios
