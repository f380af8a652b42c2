// How far a calibration lies from the truth, in units of what it says of itself.
#pragma once

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>
#include <vector>

#include "vision/calibration/calibrate.h"

namespace rockyard::vision {

// Chi-squared with `rank` degrees of freedom, over the directions in which there is an estimate.
struct Distance {
  double squared = 0.0;
  int rank = 0;
};

inline Distance DistanceOf(const Calibration& found, const std::vector<Cahvor>& truth) {
  Eigen::VectorXd error(found.covariance.rows());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    error.segment<kCameraNumbers>(static_cast<Eigen::Index>(i) * kCameraNumbers) =
        NumbersOf(found.cameras[i]) - NumbersOf(truth[i]);
  }
  // To numbers of like size.
  const Eigen::VectorXd scale =
      found.covariance.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * found.covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * scale.asDiagonal() * error;
  Distance distance;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    if (solver.eigenvalues()[i] < 1e-11) continue;
    distance.squared += along[i] * along[i] / solver.eigenvalues()[i];
    ++distance.rank;
  }
  return distance;
}

// The probability that chi-squared is larger.
inline double Tail(double squared, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), squared));
}

}  // namespace rockyard::vision
