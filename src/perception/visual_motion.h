// What a motion of the cameras, told in the rover's frame, says of the rover's pose and of the slip
// of its wheels. The aid of visual odometry hands on the former and raises slip alarms by the
// latter; the experimenter tells by the same law when slip truly began.
#pragma once

#include <optional>

#include "messages/aids.h"
#include "messages/estimates.h"
#include "perception/eyes_params.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::perception {

// How the rover believes to have stood when it took the first images, and how well it knows.
struct FirstStance {
  messages::AttitudeEstimate attitude;
  double tilt_sd_rad = 0.0;  // of roll and of pitch
};

// Turns a motion X_R0R1 (the cameras' outer frame is R) into the levelled frame F of the first
// moment, x along its heading, z up:
//
//   R_FR0 = Ry(pitch) Rx(roll)    p_F = R_FR0 p_R0    R_FR1 = R_FR0 R_R0R1
//
// and heading, pitch and roll of R_FR1 less those of R_FR0. Small turns e about the axes of F
// change the heading h, pitch p and roll of R_FR1 = Rz(h) Ry(p) Rx(roll) by
//
//   dh = e_z + tan(p) (cos(h) e_x + sin(h) e_y)
//   dp = cos(h) e_y - sin(h) e_x
//   droll = (cos(h) e_x + sin(h) e_y) / cos(p)
//
// The covariance of the motion goes through these equations. An error of the first stance tilts the
// way: tilt_sd^2 (p_x^2 + p_y^2) is added to the variance of z. The caller fills in the captures of
// the message. Requires |pitch| < 90 deg at both moments.
messages::RelativeMotion LevelledMotion(const vision::Motion& motion, const FirstStance& first);

// Slip over a stretch of way: what the wheels rolled against what was seen.
struct MeasuredSlip {
  double slip = 0.0;  // 1 - seen over rolled way, along the way that wheels and gyro lay off
  double sd = 0.0;    // its standard deviation
  bool exceeded = false;
};

// Returns the slip. `rolled_F` is the way of wheels and gyro in the plane, in the frame of the
// motion that was seen (x along the heading at first). Let r be its length, u its direction, m the
// way seen and C the covariance of m. Then
//
//   slip = 1 - m . u / r      sd = sqrt(u' C u) / r
//
// and the limit is exceeded where slip - sigma sd > limit. Slip is negative where a rover slides
// on. Returns nothing where r is below min_way_m: a turn in place has no slip of this kind, and a
// short way is noise. The wheels' own noise is part of what is measured.
//
// Must stay one law for on-board code and for the experimenter, who passes the true way and no
// covariance to tell when slip truly began and which alarms were right.
std::optional<MeasuredSlip> SlipOf(const Eigen::Vector2d& rolled_F,
                                   const messages::RelativeMotion& seen,
                                   const SlipCheckParams& params);

// Returns the way in the plane from one pose of the odometry frame to another, x along the heading
// of `from`.
Eigen::Vector2d RolledWay(const messages::PoseEstimate& from, const messages::PoseEstimate& to);

}  // namespace rockyard::perception
