#include "localization/cloned_covariance.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/check.h"

namespace rockyard::localization {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Makes a matrix symmetric again: rounding lets its two halves drift apart.
MatrixXd Symmetric(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

}  // namespace

ClonedCovariance::ClonedCovariance(const MatrixXd& initial)
    : size_(initial.rows()), covariance_(initial) {
  EXPECT(initial.rows() == initial.cols());
}

void ClonedCovariance::Propagate(const MatrixXd& transition, const MatrixXd& noise) {
  EXPECT(transition.rows() == size_ && transition.cols() == size_);
  const Index clones = covariance_.rows() - size_;
  const MatrixXd with_clones = transition * covariance_.topRightCorner(size_, clones);
  covariance_.topLeftCorner(size_, size_) =
      Symmetric(transition * now() * transition.transpose() + noise);
  covariance_.topRightCorner(size_, clones) = with_clones;
  covariance_.bottomLeftCorner(clones, size_) = with_clones.transpose();
}

void ClonedCovariance::Clone(std::int64_t number) {
  EXPECT(!Has(number));
  const Index rows = covariance_.rows();
  MatrixXd grown(rows + size_, rows + size_);
  grown.topLeftCorner(rows, rows) = covariance_;
  // A copy varies with everything as the state of now does.
  grown.bottomLeftCorner(size_, rows) = covariance_.topRows(size_);
  grown.topRightCorner(rows, size_) = covariance_.leftCols(size_);
  grown.bottomRightCorner(size_, size_) = now();
  covariance_ = std::move(grown);
  clones_.push_back(number);
}

void ClonedCovariance::Inflate(const MatrixXd& noise) {
  const MatrixXd same = MatrixXd::Identity(size_, size_);
  std::vector<Part> parts{{std::nullopt, same}};
  for (const std::int64_t clone : clones_) parts.push_back({clone, same});
  Inflate(parts, noise);
}

void ClonedCovariance::Inflate(std::span<const Part> parts, const MatrixXd& noise) {
  for (const Part& one : parts) {
    EXPECT(one.jacobian.rows() == size_ && one.jacobian.cols() == noise.rows());
    for (const Part& other : parts) {
      covariance_.block(RowOf(one.clone), RowOf(other.clone), size_, size_) +=
          one.jacobian * noise * other.jacobian.transpose();
    }
  }
}

bool ClonedCovariance::Has(std::int64_t number) const {
  return std::ranges::count(clones_, number) > 0;
}

void ClonedCovariance::Forget(std::int64_t number) {
  const auto found = std::ranges::find(clones_, number);
  if (found == clones_.end()) return;
  const Index gone = RowOf(number);
  const Index after = covariance_.rows() - gone - size_;
  MatrixXd left(covariance_.rows() - size_, covariance_.rows() - size_);
  left.topLeftCorner(gone, gone) = covariance_.topLeftCorner(gone, gone);
  left.topRightCorner(gone, after) = covariance_.topRightCorner(gone, after);
  left.bottomLeftCorner(after, gone) = covariance_.bottomLeftCorner(after, gone);
  left.bottomRightCorner(after, after) = covariance_.bottomRightCorner(after, after);
  covariance_ = std::move(left);
  clones_.erase(found);
}

Index ClonedCovariance::RowOf(const std::optional<std::int64_t>& clone) const {
  if (!clone) return 0;
  const auto found = std::ranges::find(clones_, *clone);
  EXPECT(found != clones_.end());
  return size_ * (1 + (found - clones_.begin()));
}

MatrixXd ClonedCovariance::Jacobian(std::span<const Part> parts, Index values) const {
  MatrixXd jacobian = MatrixXd::Zero(values, covariance_.rows());
  for (const Part& part : parts) {
    EXPECT(part.jacobian.rows() == values && part.jacobian.cols() == size_);
    jacobian.middleCols(RowOf(part.clone), size_) += part.jacobian;
  }
  return jacobian;
}

double ClonedCovariance::MahalanobisSquared(std::span<const Part> parts, const VectorXd& residual,
                                            const MatrixXd& noise) const {
  const MatrixXd H = Jacobian(parts, residual.size());
  const MatrixXd S = H * covariance_ * H.transpose() + noise;
  return residual.dot(S.ldlt().solve(residual));
}

ClonedCovariance::Correction ClonedCovariance::Update(std::span<const Part> parts,
                                                      const VectorXd& residual,
                                                      const MatrixXd& noise) {
  const MatrixXd H = Jacobian(parts, residual.size());
  const MatrixXd PHt = covariance_ * H.transpose();
  const MatrixXd S = H * PHt + noise;
  const Eigen::LDLT<MatrixXd> factors = S.ldlt();
  // K = P H' S^-1, as the solution of S K' = H P.
  const MatrixXd K = factors.solve(PHt.transpose()).transpose();
  const VectorXd change = K * residual;
  // Joseph's form, (I - K H) P (I - K H)' + K R K', multiplied out to what costs O(rows^2 values):
  // errors of the gain enter it in second order only.
  const MatrixXd KHP = K * PHt.transpose();
  covariance_ = Symmetric(covariance_ - KHP - KHP.transpose() + K * S * K.transpose());
  return {.changes = Eigen::Map<const MatrixXd>(change.data(), size_, change.size() / size_),
          .mahalanobis_squared = residual.dot(factors.solve(residual))};
}

MatrixXd ClonedCovariance::With(std::int64_t clone) const {
  return covariance_.block(0, RowOf(clone), size_, size_);
}

}  // namespace rockyard::localization
