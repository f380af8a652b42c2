#include "vision/calibration/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/check.h"
#include "vision/calibration/bundle.h"
#include "vision/calibration/start_values.h"

namespace rockyard::vision {
namespace {

using core::Problem;
using math::Vector3;

// The largest standard deviations of a calibration that is not refused: a share of the focal
// length, and a share of the image's width for the principal point.
constexpr double kOpenFocal = 0.02;
constexpr double kOpenCentre = 0.03;

double SumOfSquares(const std::vector<CornerResidual>& residuals) {
  double sum = 0.0;
  for (const CornerResidual& corner : residuals) sum += corner.residual_px.squaredNorm();
  return sum;
}

// Returns sigma of one coordinate from the median distance, which for a Rayleigh distribution is
// sqrt(2 ln 2) = 1.1774 sigma; at least 1e-3 px, so that corners without noise make no outliers.
double RobustSigma(const std::vector<CornerResidual>& residuals) {
  std::vector<double> distances_px;
  distances_px.reserve(residuals.size());
  for (const CornerResidual& corner : residuals) distances_px.push_back(corner.residual_px.norm());
  const auto middle = distances_px.begin() + static_cast<std::ptrdiff_t>(distances_px.size() / 2);
  std::nth_element(distances_px.begin(), middle, distances_px.end());
  return std::max(1e-3, *middle / 1.1774);
}

// Excludes the outliers and returns whether there were any.
bool ExcludeOutliers(const CalibrationOptions& options, const BundleState& state, Bundle& bundle) {
  const std::vector<CornerResidual> residuals = bundle.Residuals(state, true);
  const double limit_px = options.outlier_sds * RobustSigma(residuals);
  bool any = false;
  for (const CornerResidual& corner : residuals) {
    if (corner.residual_px.norm() <= limit_px) continue;
    bundle.Exclude(corner);
    any = true;
  }
  return any;
}

Problem NoConvergence() {
  return {"targets", "do not fit together: the least squares do not converge",
          "check rows, columns and the order of images and poses; leave the worst images out"};
}

std::int64_t DegreesOfFreedom(const Bundle& bundle, std::size_t corners, std::size_t cameras,
                              const CalibrationOptions& options) {
  // The prior on O counts as two measurements a camera.
  const std::size_t priors = options.lens == EstimatedLens::kCahvor ? 2 * cameras : 0;
  return static_cast<std::int64_t>(2 * corners + priors) - bundle.unknowns();
}

// Solves by rounds, until sigma and the outliers are settled.
std::optional<BundleState> Fit(const CalibrationOptions& options, BundleState state,
                               Bundle& bundle) {
  constexpr int kMostRounds = 10;
  for (int round = 0; round < kMostRounds; ++round) {
    std::optional<BundleState> next = bundle.Solve(std::move(state));
    if (!next) return std::nullopt;
    state = *std::move(next);
    bundle.SetSigma(RobustSigma(bundle.Residuals(state, true)));
    // The first round weighs the prior by a guess of sigma, so that there are at least two.
    if (!ExcludeOutliers(options, state, bundle) && round > 0) break;
  }
  return state;
}

// Returns a problem for each camera whose intrinsics the targets leave too open.
std::vector<Problem> Doubts(const CalibrationData& data, const Calibration& calibration) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < calibration.cameras.size(); ++i) {
    const Intrinsics found = IntrinsicsOf(calibration.cameras[i], CovarianceOf(calibration, i));
    const double focal = std::max(found.focal_h_px.sd / found.focal_h_px.value,
                                  found.focal_v_px.sd / found.focal_v_px.value);
    const double centre = std::max(found.centre_h_px.sd, found.centre_v_px.sd) / data.size.columns;
    if (focal <= kOpenFocal && centre <= kOpenCentre) continue;
    problems.push_back(
        {"targets",
         fmt::format("leave the focal length of camera {} open to {:.1f} % and its principal point "
                     "to {:.1f} % of the image's width (one standard deviation)",
                     i + 1, 100.0 * focal, 100.0 * centre),
         "give more images, with the target tilted by 20 to 45 deg about different axes and all "
         "over the image"});
  }
  return problems;
}

// Returns `value` with the standard deviation that follows from its gradient.
Estimate EstimateOf(double value, const CameraVector& gradient,
                    const CameraCovariance& covariance) {
  return {value, std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

// Returns f = |A x X|, X = H or V. For |A| = 1 its derivatives are (X - (A.X) A) / f by X and
// (|X|^2 A - (A.X) X) / f by A.
Estimate FocalOf(const Cahvor& camera, const CameraCovariance& covariance, const Vector3& X,
                 ParameterBlock block) {
  const Vector3& A = camera.linear.A;
  const double focal_px = A.cross(X).norm();
  CameraVector gradient = CameraVector::Zero();
  gradient.segment<3>(block) = (X - A.dot(X) * A) / focal_px;
  gradient.segment<3>(kBlockA) = (X.squaredNorm() * A - A.dot(X) * X) / focal_px;
  return EstimateOf(focal_px, gradient, covariance);
}

// Returns the coordinate A . X of the principal point, X = H or V.
Estimate CentreOf(const Cahvor& camera, const CameraCovariance& covariance, const Vector3& X,
                  ParameterBlock block) {
  CameraVector gradient = CameraVector::Zero();
  gradient.segment<3>(block) = camera.linear.A;
  gradient.segment<3>(kBlockA) = X;
  return EstimateOf(camera.linear.A.dot(X), gradient, covariance);
}

}  // namespace

core::Result<Calibration> Calibrate(const CalibrationData& data,
                                    const CalibrationOptions& options) {
  EXPECT(data.corners.size() == 1 || data.corners.size() == 2);
  const core::Result<BundleState> start = StartValues(data);
  if (!start.ok()) return start.problems();
  Bundle bundle(data, options);
  const std::optional<BundleState> state = Fit(options, *start, bundle);
  if (!state) return std::vector<Problem>{NoConvergence()};

  Calibration calibration;
  calibration.cameras = state->cameras;
  calibration.X_AT = state->X_AT;
  calibration.residuals = bundle.Residuals(*state, true);
  calibration.outliers = bundle.Residuals(*state, false);
  const double sum = SumOfSquares(calibration.residuals);
  const std::size_t count = calibration.residuals.size();
  calibration.corners = static_cast<std::int64_t>(count);
  calibration.degrees_of_freedom = DegreesOfFreedom(bundle, count, state->cameras.size(), options);
  if (calibration.degrees_of_freedom < 1) return std::vector<Problem>{NoConvergence()};
  calibration.sigma_px = std::sqrt(sum / static_cast<double>(calibration.degrees_of_freedom));
  calibration.rms_px = std::sqrt(sum / static_cast<double>(count));
  bundle.SetSigma(calibration.sigma_px);
  const std::optional<Eigen::MatrixXd> cofactors = bundle.CameraCofactors(*state);
  if (!cofactors) return std::vector<Problem>{NoConvergence()};
  calibration.covariance = calibration.sigma_px * calibration.sigma_px * *cofactors;
  std::vector<Problem> doubts = Doubts(data, calibration);
  if (!doubts.empty()) return doubts;
  return calibration;
}

CameraModel ModelOf(const Calibration& calibration, std::size_t camera, const ImageSize& size,
                    EstimatedLens lens) {
  const Cahvor& found = calibration.cameras.at(camera);
  if (lens == EstimatedLens::kCahv) return {found.linear, size};
  return {found, size};
}

CameraCovariance CovarianceOf(const Calibration& calibration, std::size_t camera) {
  const auto at = static_cast<Eigen::Index>(camera) * kCameraNumbers;
  return calibration.covariance.block<kCameraNumbers, kCameraNumbers>(at, at);
}

std::optional<double> PredictedError(const Cahvor& camera, const CameraCovariance& covariance,
                                     const Vector3& p_A) {
  NumbersJacobian by_numbers;
  PixelJacobian by_point;
  if (!ProjectByNumbers(camera, p_A, by_numbers, by_point)) return std::nullopt;
  return std::sqrt(std::max(0.0, (by_numbers * covariance * by_numbers.transpose()).trace()));
}

Intrinsics IntrinsicsOf(const Cahvor& camera, const CameraCovariance& covariance) {
  const Cahv& linear = camera.linear;
  return {FocalOf(camera, covariance, linear.H, kBlockH),
          FocalOf(camera, covariance, linear.V, kBlockV),
          CentreOf(camera, covariance, linear.H, kBlockH),
          CentreOf(camera, covariance, linear.V, kBlockV)};
}

Estimate BaselineOf(const Calibration& calibration) {
  EXPECT(calibration.cameras.size() == 2);
  const Vector3 apart = calibration.cameras[1].linear.C - calibration.cameras[0].linear.C;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2 * kCameraNumbers);
  gradient.segment<3>(kBlockC) = -apart.normalized();
  gradient.segment<3>(kCameraNumbers + kBlockC) = apart.normalized();
  const double variance = gradient.dot(calibration.covariance * gradient);
  return {apart.norm(), std::sqrt(std::max(0.0, variance))};
}

}  // namespace rockyard::vision
