// The kinematics of ACE (Otsu et al. 2019; Ghosh, Otsu and Ono 2018): attitude and joints of a
// rocker-bogie by the heights of the ground under its six wheels, and bounds on them where these
// heights are known between bounds. Brackets number the equations of Ghosh 2018.
//
// Frame L of the papers, in which all of this stands: x to the end that stands on the rockers (the
// front of Curiosity, the rear of a rover whose bogies are at its front), y to the rover's right, z
// down, origin where that of R is. A larger z is lower ground. With bogies at the front x of L is
// -x of R, and pitch has the other sign; left and right stay.
//
// Two misprints are corrected: [9] and [3] have z_r where the rocker needs the bogie joint, z_b;
// z_od of [10] is negative in a frame whose z points down.
#pragma once

#include <array>
#include <optional>

#include "messages/calibration.h"
#include "messages/wheels.h"

namespace rockyard::navigation {

// Numbers from low to high.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool Holds(double value, double margin = 0.0) const {
    return value >= low - margin && value <= high + margin;
  }
  double Width() const { return high - low; }
};

// Returns the interval that holds nothing, to which values are added.
Interval NoInterval();
// Makes the interval hold the value.
void Include(double value, Interval& interval);

// Attitude and joints, in L. T is a number, or an interval of them.
template <typename T>
struct SuspensionState {
  T roll_rad{};                  // positive: left side up
  T pitch_rad{};                 // positive: x of L points up
  T rocker_rad{};                // of the left rocker; the right one has its negative
  std::array<T, 2> bogie_rad{};  // left, right; 0 on flat ground, as the others
  T origin_z_m{};                // of the rover's origin, down
};

// A joint c that two points a and b carry, whose heights are known: a triangle of rigid links.
class JointTriangle {
 public:
  struct Point {
    double x_m = 0.0;
    double z_m = 0.0;  // up
  };

  // As they stand on level ground; b lies towards -x of a.
  JointTriangle(const Point& a, const Point& b, const Point& c);

  // Returns kappa(z_a, z_b), the angle of the link from a to c above the level [3]. Requires
  // |z_a - z_b| <= l_ab.
  double Angle_rad(double z_a_m, double z_b_m) const;
  // Returns the height of c for that angle [2, 4].
  double JointZ_m(double z_a_m, double angle_rad) const;

  // Returns whether the heights of a and b, anywhere between these bounds, move c and the angle one
  // way only: the joint stays horizontally between the points that carry it.
  bool IsMonotone(const Interval& z_a_m, const Interval& z_b_m) const;

  // Returns the angle on level ground, kappa_0.
  double rest_rad() const { return rest_rad_; }

 private:
  double ca_m_;
  double ab_m_;
  double included_rad_;
  double rest_rad_;
};

class AceLinkage {
 public:
  // Takes `rover` for one whose wheels all have its mean radius. Its suspension must be one: the
  // bogie joint between the bogie's wheels, the rocker's between bogie joint and outer wheel.
  explicit AceLinkage(const messages::RoverBelief& rover);

  // Returns the state on ground of these heights under the wheels, z of L; nothing where the
  // linkage cannot stand on them.
  std::optional<SuspensionState<double>> Stand(const messages::PerWheel<double>& ground_z_m) const;

  // Returns bounds on the state for all heights between these [13 to 21]; nothing where the linkage
  // cannot stand on some of them or its heights are not monotone in them. They are tight for roll,
  // pitch and rockers by themselves, and loose for bogies and the origin's height.
  std::optional<SuspensionState<Interval>> Bound(
      const messages::PerWheel<Interval>& ground_z_m) const;

  // x of L is this times x of R.
  double facing() const { return facing_; }

 private:
  struct Side;

  double facing_;
  std::array<std::size_t, 3> axles_;  // of the rocker's wheel, the middle one, the bogie's other
  double wheel_radius_m_;
  double pivot_x_m_;  // of the rocker joint, in L
  double pivot_y_m_;
  double pivot_z_m_;  // below 0
  JointTriangle bogie_;
  JointTriangle rocker_;
};

}  // namespace rockyard::navigation
