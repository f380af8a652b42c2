// The cameras of NASA's rovers: the linear CAHV, CAHVOR with radial distortion, and CAHVORE up to
// fisheyes. Calibration estimates the first two; rectified pairs, the pictures of looks, the
// backdrop of the cylinder's scene and the designation of goals use Cahv by itself; everything else
// takes all three through CameraModel (camera_model.h). Of these, rovers and studies have Cahv
// alone: records depend on every bit of its functions, and on none of Cahvor's and Cahvore's, which
// cameras from files have and tests hold to flight cameras.
#pragma once

#include <optional>

#include "math/pose.h"
#include "vision/cameras/camera_types.h"
#include "vision/cameras/radial_polynomial.h"

namespace rockyard::vision {

// CAHV: a linear camera (Yakimovsky and Cunningham 1978, "A system for extracting
// three-dimensional measurements from a stereo pair of TV cameras").
//
//   column = (p - C) . H / (p - C) . A        row = (p - C) . V / (p - C) . A
//
// C is the centre, A the unit normal of the image plane. H = f_h H' + c_h A and V = f_v V' + c_v A
// hold focal lengths in pixels, the unit vectors of rows and columns, and the principal point.
struct Cahv {
  math::Vector3 C = math::Vector3::Zero();  // m
  math::Vector3 A = math::Vector3::UnitZ();
  math::Vector3 H = math::Vector3::UnitX();  // pixels
  math::Vector3 V = math::Vector3::UnitY();  // pixels

  bool operator==(const Cahv&) const = default;
};

// Returns where p_A (m, in the camera's outer frame) is imaged, and writes the derivative by p_A to
// `jacobian`, if given. Returns nothing and leaves `jacobian` where the point is not in front of
// the image plane or where the result is not finite.
std::optional<Pixel> Project(const Cahv& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// Returns the ray of a pixel and its derivative by the pixel: the inverse of Project. Returns
// nothing where H, V and A lie in one plane or where the result is not finite.
std::optional<Ray> BackProject(const Cahv& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

// Returns the camera with its vectors told in B: X_BA is the pose of its present outer frame.
Cahv Moved(const math::Transform& X_BA, const Cahv& camera);

// Returns the camera that images at map(pixel) what `camera` images at pixel: H becomes
// scale H + shift A, and V likewise.
Cahv Mapped(const Cahv& camera, const PixelMap& map);

// Returns where a direction d meets the image: (d . H, d . V) / d . A. Writes the derivative by d
// to `by_direction`, if given. Returns nothing where d . A is not positive or where the result is
// not finite.
std::optional<Pixel> MeetPlane(const Cahv& camera, const math::Vector3& d,
                               PixelJacobian* by_direction);

// Returns the direction d with d . A = 1, d . H = column and d . V = row: the inverse of MeetPlane.
// Writes the derivative of d, which is constant, to `by_pixel`, if given. Returns nothing where H,
// V and A lie in one plane or where the result is not finite.
std::optional<math::Vector3> LeavePlane(const Cahv& camera, const Pixel& pixel,
                                        Eigen::Matrix<double, 3, 2>* by_pixel);

// CAHVOR: CAHV with radial distortion about an optical axis of its own (Gennery 2001,
// "Least-squares camera calibration including lens distortion and automatic editing of calibration
// points").
//
//   zeta = (p - C) . O    lambda = (p - C) - zeta O    tau = |lambda|^2 / zeta^2
//   p' = zeta O + (1 + R0 + R1 tau + R2 tau^2) lambda
//   column = p' . H / p' . A        row = p' . V / p' . A
//
// O is used as a unit vector: flight calibrations print O with six digits, and its length is
// divided out here. Flight code keeps that length, which moves pixels by up to 1.3e-3. The length
// of A is kept, as only its ratios to H and V count.
struct Cahvor {
  Cahv linear;
  math::Vector3 O = math::Vector3::UnitZ();
  math::Vector3 R = math::Vector3::Zero();

  bool operator==(const Cahvor&) const = default;
};

// Does what Project of a Cahv does. Returns nothing, too, for points with zeta <= 0 and for points
// beyond the part from the axis outwards where the distorted radius grows: p' would fold back.
std::optional<Pixel> Project(const Cahvor& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// Does what BackProject of a Cahv does. Returns nothing, too, beyond the image of the growing part.
// Iterates by Undistort.
std::optional<Ray> BackProject(const Cahvor& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

Cahvor Moved(const math::Transform& X_BA, const Cahvor& camera);

Cahvor Mapped(const Cahvor& camera, const PixelMap& map);

// Returns (1 + R0) + R1 r^2 + R2 r^4.
inline RadialPolynomial DistortionOf(const math::Vector3& R) {
  return {{1.0 + R[0], R[1], R[2], 0.0}};
}

// The types of a CAHVORE, by its linearity L. The flight software's numbers of them are 1, 2, 3.
enum class CahvoreType {
  kPerspective,  // L = 1
  kFisheye,      // L = 0
  kGeneral,      // L is a parameter
};

// CAHVORE: CAHVOR for lenses up to fisheyes, whose entrance pupil moves along the axis (Gennery
// 2006, "Generalized camera calibration including fish-eye lenses").
//
//   zeta = (p - C) . O    lambda = (p - C) - zeta O
//   theta: zeta sin(theta) - |lambda| cos(theta)
//            = (theta - sin(theta)) (E0 + E1 theta^2 + E2 theta^4)
//   chi = sin(L theta) / L for L < 0, theta for L = 0, tan(L theta) / L for L > 0
//   p' = O + chi (1 + R0 + R1 chi^2 + R2 chi^4) lambda / |lambda|
//   column = p' . H / p' . A        row = p' . V / p' . A
//
// The line of sight leaves the axis under theta at C + s O,
// s = (theta / sin(theta) - 1) (E0 + E1 theta^2 + E2 theta^4).
// The linearity L says which lens it is: 1 is perspective, 1/2 stereographic, 0 a fisheye
// (r = f theta), -1/2 equisolid. O is used as a unit vector, as in CAHVOR.
struct Cahvore {
  Cahv linear;
  math::Vector3 O = math::Vector3::UnitZ();
  math::Vector3 R = math::Vector3::Zero();
  math::Vector3 E = math::Vector3::Zero();  // m
  CahvoreType type = CahvoreType::kGeneral;
  double general_linearity = 1.0;  // of kGeneral, in [-1, 1]

  bool operator==(const Cahvore&) const = default;
};

double Linearity(const Cahvore& camera);

// Returns the bound, rad, below which the angles from the axis must lie that a lens of this
// linearity can image: pi / (2 |L|), at most pi.
double LargestAngle(double linearity);

// Does what Project of a Cahvor does, for all theta below LargestAngle, also with zeta <= 0.
// Finds theta by SolveTheta, and returns nothing where that does.
std::optional<Pixel> Project(const Cahvore& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// Does what BackProject of a Cahvor does. Returns nothing, too, from LargestAngle on.
std::optional<Ray> BackProject(const Cahvore& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

Cahvore Moved(const math::Transform& X_BA, const Cahvore& camera);

Cahvore Mapped(const Cahvore& camera, const PixelMap& map);

// chi as a function of theta: how the lens of a CAHVORE images an angle.
struct AngleImage {
  double chi = 0.0;
  double by_theta = 1.0;  // dchi/dtheta, positive
};

// Returns chi of theta in [0, LargestAngle): the inverse of ThetaOf.
AngleImage ImageOfTheta(double linearity, double theta_rad);

// Returns theta of chi >= 0, or nothing where no angle below LargestAngle has this chi.
std::optional<double> ThetaOf(double linearity, double chi);

// s as a function of theta: where the line of sight of a CAHVORE leaves the axis.
struct PupilShift {
  double s_m = 0.0;  // along the optical axis
  double by_theta = 0.0;
};

// Returns s of theta in [0, pi).
PupilShift ShiftOf(const math::Vector3& E, double theta_rad);

struct SightAngle {
  double theta_rad = 0.0;
  // How far along the line of sight the point lies beyond where neighbouring lines cross it, m: the
  // derivative of theta's equation by theta.
  // dtheta = (cos(theta) dlambda - sin(theta) dzeta) / reach_m.
  double reach_m = 0.0;
};

// Returns the angle under which a point is seen that lies lambda >= 0 off the axis and zeta along
// it, by Newton's method from atan2(lambda, zeta), at most 30 steps, to 1e-14 rad. Returns nothing
// without convergence, outside of [0, pi), or where reach_m is not positive: there the point lies
// so near to a moving pupil that lines of sight cross before they reach it.
std::optional<SightAngle> SolveTheta(const math::Vector3& E, double zeta_m, double lambda_m);

}  // namespace rockyard::vision
