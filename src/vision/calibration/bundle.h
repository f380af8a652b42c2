// Least squares over cameras and poses of targets (Bundle), with the data that go into a
// calibration and the result that comes out. Calibrate (calibrate.h) solves by it; `rockyard
// calibrate` fills the data and reports the result. Derivatives and covariances take a CAHVOR
// camera as 18 numbers in the order of flight calibrations: C, A, H, V, O, R. A Cahv is a Cahvor
// with O = A and R = 0. No record depends on it, so that steps and order of sums are free.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "vision/calibration/chessboard_params.h"
#include "vision/cameras/cahv.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

inline constexpr int kCameraNumbers = 18;
// Where each vector begins. Must stay: reports of calibrations store covariances in this order.
enum ParameterBlock {
  kBlockC = 0,
  kBlockA = 3,
  kBlockH = 6,
  kBlockV = 9,
  kBlockO = 12,
  kBlockR = 15
};

using CameraVector = Eigen::Matrix<double, kCameraNumbers, 1>;
using NumbersJacobian = Eigen::Matrix<double, 2, kCameraNumbers>;

CameraVector NumbersOf(const Cahvor& camera);
Cahvor CameraOfNumbers(const CameraVector& numbers);

// Returns Project(camera, p_A) with its derivatives by the 18 numbers and by p_A. Requires
// |O| = 1. The derivative by O holds for changes across O, as Project divides its length out.
// Returns nothing where Project does.
std::optional<Pixel> ProjectByNumbers(const Cahvor& camera, const math::Vector3& p_A,
                                      NumbersJacobian& by_numbers, PixelJacobian& by_point);

// Which numbers of a camera are estimated.
enum class EstimatedLens {
  kCahv,   // C, A, H, V
  kCahvor  // and O, R1, R2; R0 stays 0: with O near A it does what a focal length does
};

// The frame in which a camera is estimated.
enum class EstimatedPlace {
  kFree,   // where the targets say
  kOrigin  // the camera makes the frame A: C = 0, A = z, H has no y
};

// Returns a matrix whose columns span the ways in which the numbers may change: A and O stay of
// unit length to first order, numbers that are not estimated stand still. It has 5 (a Cahv that
// makes the frame) to 15 columns; Bundle::CameraSize must agree.
Eigen::Matrix<double, kCameraNumbers, Eigen::Dynamic> TangentBasis(const Cahvor& camera,
                                                                   EstimatedLens lens,
                                                                   EstimatedPlace place);

// Returns the camera changed by `change` = basis * step, with A and O made unit length again; with
// `lens` kCahv O is A.
Cahvor Stepped(const Cahvor& camera, const CameraVector& change, EstimatedLens lens);

// The corners of one image, in the order of CornerPosition.
using CornerImage = std::vector<Pixel>;

struct CalibrationData {
  ChessboardParams board;
  ImageSize size;
  // By camera (one, or left and right of a pair), by image: image i of both shows the same target.
  std::vector<std::vector<CornerImage>> corners;
  // X_AT of each image's target, where it was surveyed; empty: poses are estimated too.
  std::vector<math::Transform> surveyed_X_AT;
};

struct CalibrationOptions {
  EstimatedLens lens = EstimatedLens::kCahvor;
  // The standard deviation, in either direction, of the angle between the optical axis O and the
  // normal A of the image plane, rad: the prior that holds O where distortion is too small to tell
  // it. Assumed, > 0; lenses of rovers have 0.001 to 0.01.
  double axis_sd_rad = 0.02;
  // A corner is an outlier further than this many standard deviations from its place. Of 3000 good
  // corners one is lost in 1 % of the calibrations.
  double outlier_sds = 5.0;
};

struct CornerResidual {
  std::size_t camera = 0;
  std::size_t image = 0;
  std::size_t corner = 0;
  Pixel residual_px = Pixel::Zero();  // measured less predicted
};

struct Calibration {
  std::vector<Cahvor> cameras;        // told in frame A
  std::vector<math::Transform> X_AT;  // poses of the targets
  // The covariance of the 18 numbers of each camera, one camera after the other (36 x 36 for a
  // pair). Its rank is how many numbers of the cameras are estimated.
  Eigen::MatrixXd covariance;
  double sigma_px = 0.0;  // of a coordinate of a corner: sqrt(sum of squares / degrees of freedom)
  double rms_px = 0.0;    // of the distance from a corner to its prediction
  std::int64_t corners = 0;  // that were used, over all images
  std::int64_t degrees_of_freedom = 0;
  std::vector<CornerResidual> residuals;  // of the corners that were used
  std::vector<CornerResidual> outliers;   // of the excluded corners that are imaged
};

// The unknowns of a calibration: cameras, and the pose of the target of each image.
struct BundleState {
  std::vector<Cahvor> cameras;
  std::vector<math::Transform> X_AT;
};

// Fits cameras and poses of targets to corners by least squares: over cameras k, images i and the
// corners j in use it minimizes
//   sum |z_kij - Project(camera_k, X_AT_i p_Tj)|^2 + (sigma / axis_sd)^2 sum_k |O_k - A_k|^2,
// the second part (the prior on O) for kCahvor only, by the method of Levenberg and Marquardt
// (Marquardt 1963) with derivatives in closed form (ProjectByNumbers). Each corner touches one
// camera and one pose, so that the normal equations consist of blocks of at most 21 x 21. The
// solver is rockyard's own: there is one dense system of a few hundred unknowns, steps go over
// spheres and rotations, and the covariance is the inverse of a matrix that is there anyway; a
// library would add 28 packages to what rockyard needs.
class Bundle {
 public:
  // `data` must outlive the bundle. Without surveyed poses the first camera makes the frame.
  Bundle(const CalibrationData& data, const CalibrationOptions& options);

  // Sets sigma, the standard deviation of one coordinate of a corner, which the prior on O is
  // weighed against.
  void SetSigma(double sigma_px) { sigma_px_ = sigma_px; }
  void Exclude(const CornerResidual& corner);

  // Returns the state with the least sum, from `state` on. Returns nothing where a corner in use is
  // not imaged at the start, or where 200 steps do not reach the least sum.
  std::optional<BundleState> Solve(BundleState state) const;

  // Returns the residuals of the corners in use, or else of the excluded ones, without those of
  // corners that are not imaged.
  std::vector<CornerResidual> Residuals(const BundleState& state, bool in_use) const;

  // Returns the cameras' part of the inverse of the normal equations' matrix, told in the 18
  // numbers of each camera: the covariance for a sigma of 1 px. Returns nothing where the matrix is
  // singular.
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
