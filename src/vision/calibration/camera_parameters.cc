#include "vision/calibration/camera_parameters.h"

#include "core/check.h"
#include "vision/cameras/cahv.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// Two unit vectors across a unit vector and across each other.
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
  // For dO across O: dzeta = lambda . dO, dlambda = -dzeta O - zeta dO and
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
