#include "vision/cameras/cahvore_angles.h"

#include <cmath>
#include <numbers>

#include "vision/cameras/cahvore.h"

namespace rockyard::vision {
namespace {

constexpr int kMostThetaSteps = 30;
constexpr double kThetaTolerance_rad = 1e-14;
// Below this angle sines are replaced by the first terms of their series, whose error is theta^4.
constexpr double kSmallAngle_rad = 1e-4;

struct PupilPolynomial {
  double value_m = 0.0;  // E0 + E1 theta^2 + E2 theta^4
  double by_theta_m = 0.0;
};

PupilPolynomial PupilAt(const math::Vector3& E, double theta) {
  const double t = theta * theta;
  return {E[0] + t * (E[1] + t * E[2]), theta * (2.0 * E[1] + t * 4.0 * E[2])};
}

// theta - sin(theta), without the cancellation at small angles.
double ThetaMinusSine(double theta) {
  if (theta < kSmallAngle_rad) return theta * theta * theta / 6.0;
  return theta - std::sin(theta);
}

}  // namespace

double LargestAngle(double linearity) {
  return std::fmin(std::numbers::pi, 0.5 * std::numbers::pi / std::fabs(linearity));
}

AngleImage ImageOfTheta(double linearity, double theta_rad) {
  const double angle = linearity * theta_rad;
  if (linearity < 0.0) return {std::sin(angle) / linearity, std::cos(angle)};
  if (linearity > 0.0) {
    const double tangent = std::tan(angle);
    return {tangent / linearity, 1.0 + tangent * tangent};
  }
  return {theta_rad, 1.0};
}

std::optional<double> ThetaOf(double linearity, double chi) {
  double theta = chi;
  if (linearity < 0.0) theta = std::asin(linearity * chi) / linearity;
  if (linearity > 0.0) theta = std::atan(linearity * chi) / linearity;
  if (!(theta < LargestAngle(linearity))) return std::nullopt;
  return theta;
}

PupilShift ShiftOf(const math::Vector3& E, double theta_rad) {
  const PupilPolynomial pupil = PupilAt(E, theta_rad);
  if (theta_rad < kSmallAngle_rad) {
    // theta / sin(theta) - 1 = theta^2 / 6 + ...
    const double excess = theta_rad * theta_rad / 6.0;
    return {excess * pupil.value_m, theta_rad / 3.0 * pupil.value_m + excess * pupil.by_theta_m};
  }
  const double sine = std::sin(theta_rad);
  const double excess = theta_rad / sine - 1.0;
  const double excess_by_theta = (sine - theta_rad * std::cos(theta_rad)) / (sine * sine);
  return {excess * pupil.value_m, excess_by_theta * pupil.value_m + excess * pupil.by_theta_m};
}

std::optional<SightAngle> SolveTheta(const math::Vector3& E, double zeta_m, double lambda_m) {
  double theta = std::atan2(lambda_m, zeta_m);
  for (int step = 0; step < kMostThetaSteps; ++step) {
    const double sine = std::sin(theta);
    const double cosine = std::cos(theta);
    const PupilPolynomial pupil = PupilAt(E, theta);
    const double lag = ThetaMinusSine(theta);
    const double residual_m = zeta_m * sine - lambda_m * cosine - lag * pupil.value_m;
    const double reach_m =
        zeta_m * cosine + lambda_m * sine - (1.0 - cosine) * pupil.value_m - lag * pupil.by_theta_m;
    const double change = residual_m / reach_m;
    theta -= change;
    if (!(theta >= 0.0 && theta < std::numbers::pi)) return std::nullopt;
    if (std::fabs(change) <= kThetaTolerance_rad) {
      if (!(reach_m > 0.0)) return std::nullopt;
      return SightAngle{theta, reach_m};
    }
  }
  return std::nullopt;
}

}  // namespace rockyard::vision
