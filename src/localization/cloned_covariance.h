// The covariance of a state's error, and of copies of that error at earlier moments (stochastic
// cloning; Roumeliotis and Burdick 2002, "Stochastic cloning: a generalized framework for
// processing relative state measurements"). The error-state filter keeps its error in it.
//
// Data that are taken at one moment and arrive at a later one, or that compare two moments, do not
// measure the present state. A clone keeps the error x_c of a moment as it was. While the state
// goes on, x <- F x + w with covariance Q of w, the clone stands still:
//   P_xx <- F P_xx F' + Q,   P_xc <- F P_xc,   P_cc stays,
// so that a measurement of clones, r = sum_i H_i x_i + n with covariance R of n, corrects the
// present state through P_xc by what the measurement is still worth:
//   S = H P H' + R,   K = P H' S^-1,   x <- x + K r,   P <- (I - K H) P (I - K H)' + K R K'.
// What measurements of a clone have corrected stays when the clone is forgotten.
//
// With n coordinates and c clones the matrix has n (1 + c) rows; a propagation costs O(n^3 (1 +
// c)), an update of m values O((n (1 + c))^2 m).
//
// Records depend on its operations, their order included, where localization.estimator is
// error_state; no others do.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rockyard::localization {

// The covariance of the present error and of its clones.
class ClonedCovariance {
 public:
  // One moment's part of a measurement.
  struct Part {
    std::optional<std::int64_t> clone;  // number of the clone; empty: the present state
    Eigen::MatrixXd jacobian;           // H_i: m x n for a measurement of m values
  };

  // What a measurement corrects.
  struct Correction {
    // Changes to be added: in the first column to the present state, then to the state kept with
    // each clone, in the order of clones(); n rows.
    Eigen::MatrixXd changes;
    double mahalanobis_squared = 0.0;  // r' S^-1 r, chi-squared with m degrees of freedom
  };

  // Begins with the covariance of the present state, n x n and symmetric.
  explicit ClonedCovariance(const Eigen::MatrixXd& initial);

  // Lets the state go on by x <- transition x + w, with covariance `noise` of w.
  void Propagate(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise);

  // Keeps the present error under a number that no clone has.
  void Clone(std::int64_t number);
  bool Has(std::int64_t number) const;
  // Adds one more error that the present state and every clone share, with covariance `noise`,
  // n x n.
  void Inflate(const Eigen::MatrixXd& noise);
  // Adds one more error e that the parts share, with covariance `noise`, k x k: the state of each
  // part is off by the part's jacobian (n x k) times e.
  void Inflate(std::span<const Part> parts, const Eigen::MatrixXd& noise);
  // Forgets a clone; without effect where there is none with that number.
  void Forget(std::int64_t number);
  std::span<const std::int64_t> clones() const { return clones_; }

  // Returns r' S^-1 r of a measurement, for gates, and does not take it. Each clone must be there.
  double MahalanobisSquared(std::span<const Part> parts, const Eigen::VectorXd& residual,
                            const Eigen::MatrixXd& noise) const;
  // Takes a measurement. Each clone must be there, and S must be regular.
  Correction Update(std::span<const Part> parts, const Eigen::VectorXd& residual,
                    const Eigen::MatrixXd& noise);

  // Returns the covariance of the present error, n x n.
  Eigen::MatrixXd now() const { return covariance_.topLeftCorner(size_, size_); }
  // Returns the covariance of the present error with a clone's, n x n.
  Eigen::MatrixXd With(std::int64_t clone) const;

 private:
  Eigen::Index RowOf(const std::optional<std::int64_t>& clone) const;
  Eigen::MatrixXd Jacobian(std::span<const Part> parts, Eigen::Index values) const;

  Eigen::Index size_;
  std::vector<std::int64_t> clones_;  // in the order of their rows, which follow those of now
  Eigen::MatrixXd covariance_;
};

}  // namespace rockyard::localization
