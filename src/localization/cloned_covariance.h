// The covariance of a state's error, and of copies of that error at earlier moments (stochastic
// cloning; Roumeliotis and Burdick 2002, "Stochastic cloning: a generalized framework for
// processing relative state measurements").
//
// Data that are taken at one moment and arrive at a later one, or that compare two moments, do not
// measure the state of now. A clone keeps the error x_c of a moment as it was. While the state
// goes on, x <- F x + w with covariance Q of w, the clone stands still:
//   P_xx <- F P_xx F' + Q,   P_xc <- F P_xc,   P_cc stays,
// so that a measurement of clones, r = sum_i H_i x_i + n with covariance R of n, corrects the state
// through P_xc as much as it is worth now:
//   S = H P H' + R,   K = P H' S^-1,   x <- x + K r,   P <- (I - K H) P (I - K H)' + K R K'.
// A clone that is forgotten leaves what it has taught.
//
// With n coordinates and c clones the matrix has n (1 + c) rows; a propagation costs O(n^3 (1 +
// c)), an update of m values O((n (1 + c))^2 m).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rockyard::localization {

class ClonedCovariance {
 public:
  // One moment's part of a measurement: of now, or of the clone with that number.
  struct Part {
    std::optional<std::int64_t> clone;
    Eigen::MatrixXd jacobian;  // H_i: m x n for a measurement of m values
  };

  struct Correction {
    // What is to be added to the state and to the state kept with each clone, in their order: n
    // rows, 1 + clones columns.
    Eigen::MatrixXd changes;
    double mahalanobis_squared = 0.0;  // r' S^-1 r, chi-squared with m degrees of freedom
  };

  // `initial`: n x n, symmetric, of the state that there is now.
  explicit ClonedCovariance(const Eigen::MatrixXd& initial);

  // The state goes on by x <- transition x + w.
  void Propagate(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise);

  // Keeps the error of now under a number that no clone has.
  void Clone(std::int64_t number);
  bool Has(std::int64_t number) const;
  // The state of now and that of every clone may be off by one more error, which all of them share:
  // `noise` is its covariance, n x n.
  void Inflate(const Eigen::MatrixXd& noise);
  // The state of each part may be off by its jacobian (n x k) times one error e, which all of them
  // share: `noise` is the covariance of e, k x k.
  void Inflate(std::span<const Part> parts, const Eigen::MatrixXd& noise);
  // Nothing where it is not there.
  void Forget(std::int64_t number);
  std::span<const std::int64_t> clones() const { return clones_; }

  // r' S^-1 r of a measurement that is not taken: to be gated by. Each clone must be there.
  double MahalanobisSquared(std::span<const Part> parts, const Eigen::VectorXd& residual,
                            const Eigen::MatrixXd& noise) const;
  // Takes a measurement. Each clone must be there, and S regular.
  Correction Update(std::span<const Part> parts, const Eigen::VectorXd& residual,
                    const Eigen::MatrixXd& noise);

  // Of the state of now: n x n.
  Eigen::MatrixXd now() const { return covariance_.topLeftCorner(size_, size_); }
  // Between the state of now and a clone: n x n.
  Eigen::MatrixXd With(std::int64_t clone) const;

 private:
  Eigen::Index RowOf(const std::optional<std::int64_t>& clone) const;
  Eigen::MatrixXd Jacobian(std::span<const Part> parts, Eigen::Index values) const;

  Eigen::Index size_;
  std::vector<std::int64_t> clones_;  // in the order of their rows, after those of now
  Eigen::MatrixXd covariance_;
};

}  // namespace rockyard::localization
