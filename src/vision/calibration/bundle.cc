#include "vision/calibration/bundle.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/check.h"
#include "math/pose.h"
#include "vision/cameras/cahv.h"

namespace rockyard::vision {

namespace {

using math::Transform;
using math::Vector3;

Eigen::Matrix3d CrossMatrix(const Vector3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

// Returns X_AT with the rotation R exp(turn) and the translation t + shift.
Transform Turned(const Transform& X_AT, const Vector3& turn_rad, const Vector3& shift_m) {
  Transform moved = X_AT;
  const double angle_rad = turn_rad.norm();
  if (angle_rad > 0.0) {
    moved.linear() = X_AT.linear() * math::RotationAbout(angle_rad, turn_rad / angle_rad);
  }
  moved.translation() += shift_m;
  return moved;
}

}  // namespace

Bundle::Bundle(const CalibrationData& data, const CalibrationOptions& options)
    : data_(data), options_(options) {
  for (std::size_t camera = 0; camera < data.corners.size(); ++camera) {
    for (std::size_t image = 0; image < data.corners[camera].size(); ++image) {
      EXPECT(data.corners[camera][image].size() == data.board.corners());
      for (std::size_t corner = 0; corner < data.board.corners(); ++corner) {
        all_.push_back({camera, image, corner, Pixel::Zero()});
      }
    }
  }
  used_.assign(all_.size(), true);
}

std::size_t Bundle::IndexOf(const CornerResidual& corner) const {
  const std::size_t images = data_.corners.front().size();
  return (corner.camera * images + corner.image) * data_.board.corners() + corner.corner;
}

void Bundle::Exclude(const CornerResidual& corner) { used_[IndexOf(corner)] = false; }

// Must return the number of columns of TangentBasis.
Eigen::Index Bundle::CameraSize(std::size_t camera) const {
  const bool makes_frame = HasPoses() && camera == 0;
  const Eigen::Index linear = makes_frame ? 5 : 11;
  return options_.lens == EstimatedLens::kCahvor ? linear + 4 : linear;
}

Eigen::Index Bundle::CameraStart(std::size_t camera) const {
  return camera == 0 ? 0 : CameraSize(0);
}

Eigen::Index Bundle::PoseStart(std::size_t image) const {
  const std::size_t last = data_.corners.size() - 1;
  return CameraStart(last) + CameraSize(last) + 6 * static_cast<Eigen::Index>(image);
}

std::int64_t Bundle::unknowns() const {
  return PoseStart(HasPoses() ? data_.corners.front().size() : 0);
}

double Bundle::PriorWeight() const {
  const double ratio = sigma_px_ / options_.axis_sd_rad;
  return ratio * ratio;
}

std::vector<Bundle::Basis> Bundle::BasesAt(const BundleState& state) const {
  std::vector<Basis> bases;
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    const bool makes_frame = HasPoses() && camera == 0;
    bases.push_back(TangentBasis(state.cameras[camera], options_.lens,
                                 makes_frame ? EstimatedPlace::kOrigin : EstimatedPlace::kFree));
  }
  return bases;
}

std::vector<CornerResidual> Bundle::Residuals(const BundleState& state, bool in_use) const {
  std::vector<CornerResidual> residuals;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (used_[i] != in_use) continue;
    CornerResidual residual = all_[i];
    const Vector3 p_A = state.X_AT[residual.image] * CornerPosition(data_.board, residual.corner);
    const std::optional<Pixel> predicted = Project(state.cameras[residual.camera], p_A);
    if (!predicted) continue;
    residual.residual_px =
        data_.corners[residual.camera][residual.image][residual.corner] - *predicted;
    residuals.push_back(residual);
  }
  return residuals;
}

std::optional<double> Bundle::SumAt(const BundleState& state) const {
  double sum = 0.0;
  std::size_t imaged = 0;
  for (const CornerResidual& corner : Residuals(state, true)) {
    sum += corner.residual_px.squaredNorm();
    ++imaged;
  }
  std::size_t wanted = 0;
  for (const bool used : used_) wanted += used ? 1 : 0;
  if (imaged != wanted) return std::nullopt;
  if (HasPrior()) {
    for (const Cahvor& camera : state.cameras) {
      sum += PriorWeight() * (camera.O - camera.linear.A).squaredNorm();
    }
  }
  return sum;
}

void Bundle::AddCorner(const BundleState& state, const std::vector<Basis>& bases,
                       const CornerResidual& corner, Normal& normal) const {
  const Transform& X_AT = state.X_AT[corner.image];
  const Vector3 p_T = CornerPosition(data_.board, corner.corner);
  NumbersJacobian by_numbers;
  PixelJacobian by_point;
  const auto predicted =
      ProjectByNumbers(state.cameras[corner.camera], X_AT * p_T, by_numbers, by_point);
  EXPECT(predicted.has_value());
  const Pixel residual = data_.corners[corner.camera][corner.image][corner.corner] - *predicted;
  const Eigen::Matrix<double, 2, Eigen::Dynamic> by_camera = by_numbers * bases[corner.camera];
  const Eigen::Index at = CameraStart(corner.camera);
  const Eigen::Index size = by_camera.cols();
  normal.matrix.block(at, at, size, size).noalias() += by_camera.transpose() * by_camera;
  normal.right.segment(at, size).noalias() += by_camera.transpose() * residual;
  if (!HasPoses()) return;
  // p_A = R exp(turn) p_T + t + shift; its derivative by the turn is -R [p_T]x.
  Eigen::Matrix<double, 2, 6> by_pose;
  by_pose << -by_point * X_AT.linear() * CrossMatrix(p_T), by_point;
  const Eigen::Index pose = PoseStart(corner.image);
  normal.matrix.block<6, 6>(pose, pose).noalias() += by_pose.transpose() * by_pose;
  normal.matrix.block(pose, at, 6, size).noalias() += by_pose.transpose() * by_camera;
  normal.right.segment<6>(pose).noalias() += by_pose.transpose() * residual;
}

void Bundle::AddPrior(const BundleState& state, const std::vector<Basis>& bases,
                      Normal& normal) const {
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    const Eigen::Matrix<double, 3, Eigen::Dynamic> by_camera =
        bases[camera].middleRows<3>(kBlockO) - bases[camera].middleRows<3>(kBlockA);
    const Vector3 residual = state.cameras[camera].linear.A - state.cameras[camera].O;
    const Eigen::Index at = CameraStart(camera);
    const Eigen::Index size = by_camera.cols();
    normal.matrix.block(at, at, size, size) += PriorWeight() * by_camera.transpose() * by_camera;
    normal.right.segment(at, size) += PriorWeight() * by_camera.transpose() * residual;
  }
}

Bundle::Normal Bundle::NormalAt(const BundleState& state, const std::vector<Basis>& bases) const {
  const Eigen::Index size = unknowns();
  Normal normal{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (used_[i]) AddCorner(state, bases, all_[i], normal);
  }
  if (HasPrior()) AddPrior(state, bases, normal);
  normal.matrix.triangularView<Eigen::StrictlyUpper>() = normal.matrix.transpose();
  return normal;
}

BundleState Bundle::Moved(const BundleState& state, const std::vector<Basis>& bases,
                          const Eigen::VectorXd& step) const {
  BundleState moved = state;
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    const CameraVector change =
        bases[camera] * step.segment(CameraStart(camera), bases[camera].cols());
    moved.cameras[camera] = Stepped(state.cameras[camera], change, options_.lens);
  }
  if (!HasPoses()) return moved;
  for (std::size_t image = 0; image < state.X_AT.size(); ++image) {
    const Eigen::Index at = PoseStart(image);
    moved.X_AT[image] = Turned(state.X_AT[image], step.segment<3>(at), step.segment<3>(at + 3));
  }
  return moved;
}

std::optional<BundleState> Bundle::Solve(BundleState state) const {
  constexpr int kMostSteps = 200;
  // A step that lessens the sum by this share or less is the last: with 1000 corners some
  // thousandth of a standard deviation of the unknowns is left.
  constexpr double kEnough = 1e-9;
  constexpr double kMostDamping = 1e12;  // beyond, no step makes the sum smaller: it is the least
  std::optional<double> sum = SumAt(state);
  if (!sum) return std::nullopt;
  double damping = 1e-3;
  for (int count = 0; count < kMostSteps; ++count) {
    const std::vector<Basis> bases = BasesAt(state);
    const Normal normal = NormalAt(state, bases);
    bool smaller = false;
    while (!smaller) {
      if (damping > kMostDamping) return state;
      Eigen::MatrixXd damped = normal.matrix;
      damped.diagonal() *= 1.0 + damping;
      const BundleState next = Moved(state, bases, damped.ldlt().solve(normal.right));
      const std::optional<double> next_sum = SumAt(next);
      smaller = next_sum && *next_sum < *sum;
      if (!smaller) {
        damping *= 10.0;
        continue;
      }
      const bool done = *sum - *next_sum <= kEnough * *sum;
      state = next;
      sum = next_sum;
      if (done) return state;
    }
    damping = std::max(0.1 * damping, 1e-12);
  }
  return std::nullopt;
}

std::optional<Eigen::MatrixXd> Bundle::CameraCofactors(const BundleState& state) const {
  const std::vector<Basis> bases = BasesAt(state);
  const Normal normal = NormalAt(state, bases);
  // The unknowns have many units: scale the diagonal to ones before factoring.
  if (!(normal.matrix.diagonal().minCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd scale = normal.matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal.matrix * scale.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factors(scaled);
  constexpr double kSingular = 1e-15;
  if (!(factors.vectorD().minCoeff() > kSingular)) return std::nullopt;
  const Eigen::Index size = unknowns();
  const Eigen::MatrixXd inverse = scale.asDiagonal() *
                                  factors.solve(Eigen::MatrixXd::Identity(size, size)) *
                                  scale.asDiagonal();
  const auto cameras = static_cast<Eigen::Index>(state.cameras.size());
  const std::size_t last = state.cameras.size() - 1;
  const Eigen::Index inner = CameraStart(last) + CameraSize(last);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(cameras * kCameraNumbers, inner);
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    const auto row = static_cast<Eigen::Index>(camera) * kCameraNumbers;
    spread.block(row, CameraStart(camera), kCameraNumbers, CameraSize(camera)) = bases[camera];
    if (options_.lens == EstimatedLens::kCahv) {
      spread.middleRows(row + kBlockO, 3) = spread.middleRows(row + kBlockA, 3);
    }
  }
  return Eigen::MatrixXd(spread * inverse.topLeftCorner(inner, inner) * spread.transpose());
}

namespace {

using math::Vector3;

// Returns two unit vectors square to `axis`, a unit vector, and to each other.
Eigen::Matrix<double, 3, 2> Across(const Vector3& axis) {
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis.cross(Vector3::Unit(least)).normalized();
  across.col(1) = axis.cross(across.col(0));
  return across;
}

}  // namespace

CameraVector NumbersOf(const Cahvor& camera) {
  CameraVector numbers;
  numbers << camera.linear.C, camera.linear.A, camera.linear.H, camera.linear.V, camera.O, camera.R;
  return numbers;
}

Cahvor CameraOfNumbers(const CameraVector& numbers) {
  const auto block = [&](ParameterBlock at) -> Vector3 { return numbers.segment<3>(at); };
  return {{block(kBlockC), block(kBlockA), block(kBlockH), block(kBlockV)},
          block(kBlockO),
          block(kBlockR)};
}

std::optional<Pixel> ProjectByNumbers(const Cahvor& camera, const Vector3& p_A,
                                      NumbersJacobian& by_numbers, PixelJacobian& by_point) {
  std::optional<Pixel> pixel = Project(camera, p_A, &by_point);
  if (!pixel) return std::nullopt;
  const Vector3& o = camera.O;
  const Vector3 d = p_A - camera.linear.C;
  const double zeta = d.dot(o);
  const Vector3 lambda = d - zeta * o;
  const double tau = lambda.squaredNorm() / (zeta * zeta);
  const RadialPolynomial distortion = DistortionOf(camera.R);
  const double share = Share(distortion, tau);
  const Vector3 bent = zeta * o + share * lambda;
  PixelJacobian by_bent;
  if (!MeetPlane(camera.linear, bent, &by_bent)) return std::nullopt;
  // column = p'.H / p'.A and row = p'.V / p'.A.
  const Eigen::RowVector3d slope = bent.transpose() / bent.dot(camera.linear.A);
  by_numbers.setZero();
  by_numbers.middleCols<3>(kBlockC) = -by_point;
  by_numbers.middleCols<3>(kBlockA) = -*pixel * slope;
  by_numbers.block<1, 3>(0, kBlockH) = slope;
  by_numbers.block<1, 3>(1, kBlockV) = slope;
  // With dO across O, dzeta = lambda . dO, dlambda = -dzeta O - zeta dO and
  // dtau = -2 (1 + tau) dzeta / zeta, so that
  // dp' = (1 - share) (O dzeta + zeta dO) + lambda share' dtau.
  Eigen::Matrix3d bent_by_axis =
      (1.0 - share) * (o * lambda.transpose() + zeta * Eigen::Matrix3d::Identity());
  bent_by_axis -=
      ShareSlope(distortion, tau) * 2.0 * (1.0 + tau) / zeta * lambda * lambda.transpose();
  by_numbers.middleCols<3>(kBlockO) = by_bent * bent_by_axis;
  by_numbers.middleCols<3>(kBlockR) = by_bent * lambda * Eigen::RowVector3d(1.0, tau, tau * tau);
  return pixel;
}

Eigen::Matrix<double, kCameraNumbers, Eigen::Dynamic> TangentBasis(const Cahvor& camera,
                                                                   EstimatedLens lens,
                                                                   EstimatedPlace place) {
  Eigen::Matrix<double, kCameraNumbers, Eigen::Dynamic> basis(kCameraNumbers, kCameraNumbers);
  basis.setZero();
  int count = 0;
  if (place == EstimatedPlace::kFree) {
    for (int i = 0; i < 3; ++i) basis(kBlockC + i, count++) = 1.0;
    basis.block<3, 2>(kBlockA, count) = Across(camera.linear.A);
    count += 2;
    for (int i = 0; i < 3; ++i) basis(kBlockH + i, count++) = 1.0;
  } else {
    EXPECT(camera.linear.C.isZero() && camera.linear.A == Vector3::UnitZ());
    basis(kBlockH, count++) = 1.0;
    basis(kBlockH + 2, count++) = 1.0;
  }
  for (int i = 0; i < 3; ++i) basis(kBlockV + i, count++) = 1.0;
  if (lens == EstimatedLens::kCahvor) {
    basis.block<3, 2>(kBlockO, count) = Across(camera.O);
    count += 2;
    basis(kBlockR + 1, count++) = 1.0;
    basis(kBlockR + 2, count++) = 1.0;
  }
  return basis.leftCols(count);
}

Cahvor Stepped(const Cahvor& camera, const CameraVector& change, EstimatedLens lens) {
  Cahvor stepped = CameraOfNumbers(NumbersOf(camera) + change);
  stepped.linear.A.normalize();
  stepped.O = lens == EstimatedLens::kCahv ? stepped.linear.A : stepped.O.normalized();
  return stepped;
}

}  // namespace rockyard::vision
