// The two functions of an angle that make a CAHVORE: how its lens images it and where its line of
// sight leaves the axis.
#pragma once

#include <optional>

#include "math/pose.h"

namespace rockyard::vision {

struct AngleImage {
  double chi = 0.0;
  double by_theta = 1.0;  // dchi/dtheta, positive
};

// chi of theta in [0, LargestAngle).
AngleImage ImageOfTheta(double linearity, double theta_rad);

// theta of chi >= 0; nothing where no angle below LargestAngle has it.
std::optional<double> ThetaOf(double linearity, double chi);

struct PupilShift {
  double s_m = 0.0;  // along the optical axis
  double by_theta = 0.0;
};

// Where the line of sight under theta in [0, pi) leaves the axis.
PupilShift ShiftOf(const math::Vector3& E, double theta_rad);

struct SightAngle {
  double theta_rad = 0.0;
  // How far along the line of sight the point lies beyond where neighbouring ones cross it, m: the
  // derivative of the equation by theta. dtheta = (cos(theta) dlambda - sin(theta) dzeta) / this.
  double reach_m = 0.0;
};

// The angle under which a point is seen that lies lambda >= 0 off the axis, zeta along it. Nothing
// without convergence, outside of [0, pi), or where reach_m is not positive.
std::optional<SightAngle> SolveTheta(const math::Vector3& E, double zeta_m, double lambda_m);

}  // namespace rockyard::vision
