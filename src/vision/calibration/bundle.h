// Cameras and poses of targets fitted to corners by least squares.
//
// What is minimized, over cameras k, images i and corners j that are in use, is
//   sum |z_kij - Project(camera_k, X_AT_i p_Tj)|^2 + (sigma / axis_sd)^2 sum_k |O_k - A_k|^2,
// with derivatives in closed form (camera_parameters.h) by Levenberg's and Marquardt's method
// (Marquardt 1963). Each corner touches one camera and one pose, so that the normal equations are
// made of blocks of at most 21 x 21. A solver of our own, as the problem has one dense system of a
// few hundred unknowns and steps on spheres and rotations, and the covariance is the inverse of a
// matrix that is there anyway; a library would add 28 packages to what rockyard needs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/calibration/calibration_data.h"

namespace rockyard::vision {

struct BundleState {
  std::vector<Cahvor> cameras;
  std::vector<math::Transform> X_AT;
};

class Bundle {
 public:
  // `data` must outlive it. Without surveyed poses the first camera makes the frame.
  Bundle(const CalibrationData& data, const CalibrationOptions& options);

  // Of one coordinate of a corner, px: what the axis' prior is weighed against.
  void SetSigma(double sigma_px) { sigma_px_ = sigma_px; }
  void Exclude(const CornerResidual& corner);

  // The state with the least sum, from `state` on. Nothing where a corner's place is not imaged at
  // the start, or where 200 steps do not end it.
  std::optional<BundleState> Solve(BundleState state) const;

  // Of the corners in use, or else of the excluded ones that are imaged.
  std::vector<CornerResidual> Residuals(const BundleState& state, bool in_use) const;

  // The inverse of the normal equations' matrix, told in the 18 numbers of each camera: the
  // covariance for a sigma of 1 px. Nothing where the matrix is singular.
  std::optional<Eigen::MatrixXd> CameraCofactors(const BundleState& state) const;

  std::int64_t unknowns() const;

 private:
  using Basis = Eigen::Matrix<double, kCameraNumbers, Eigen::Dynamic>;
  struct Normal {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;  // -gradient / 2
  };

  std::vector<Basis> BasesAt(const BundleState& state) const;
  std::optional<double> SumAt(const BundleState& state) const;
  Normal NormalAt(const BundleState& state, const std::vector<Basis>& bases) const;
  void AddCorner(const BundleState& state, const std::vector<Basis>& bases,
                 const CornerResidual& corner, Normal& normal) const;
  void AddPrior(const BundleState& state, const std::vector<Basis>& bases, Normal& normal) const;
  BundleState Moved(const BundleState& state, const std::vector<Basis>& bases,
                    const Eigen::VectorXd& step) const;
  bool HasPoses() const { return data_.surveyed_X_AT.empty(); }
  bool HasPrior() const { return options_.lens == EstimatedLens::kCahvor; }
  Eigen::Index CameraSize(std::size_t camera) const;
  Eigen::Index CameraStart(std::size_t camera) const;
  Eigen::Index PoseStart(std::size_t image) const;
  double PriorWeight() const;
  std::size_t IndexOf(const CornerResidual& corner) const;

  const CalibrationData& data_;
  CalibrationOptions options_;
  double sigma_px_ = 0.1;
  std::vector<CornerResidual> all_;  // residuals of 0: which corners there are
  std::vector<bool> used_;
};

}  // namespace rockyard::vision
