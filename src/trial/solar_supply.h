// Electrical power of solar cells over the day, and what a load draws beyond it.
//
// A level panel under a clear sky gives power by the cosine of the sun's zenith angle. With
// latitude phi, declination delta and hour angle H (math/sun_position.h)
//   S(H) = S_noon max(0, a + b cos H) / (a + b),   a = sin phi sin delta,   b = cos phi cos delta,
// and H grows by 2 pi in a sol. Matthies 1995, section 2.1.2: "a peak output of 16 W at noon". A
// steady load P is supplied by the sun as far as that reaches, min(P, S); the rest is the
// shortfall, which batteries have to give. Surplus is lost: these batteries are not rechargeable.
//
// Limits: neither tilt of the panel nor light that the dust scatters, which broadens the arc.
#pragma once

namespace rockyard::trial {

class SolarSupply {
 public:
  // `noon_W`: power at local noon, of that day. `start_solar_time_h`: true solar time at time 0.
  // The sun rises: |latitude - declination| < 90 deg, and it is not always up at a pole.
  SolarSupply(double noon_W, double latitude_rad, double declination_rad,
              double start_solar_time_h);

  double Power_W(double time_s) const;

  // What the sun gives from begin_s to end_s >= begin_s, J.
  double Energy_J(double begin_s, double end_s) const;
  // The part of it that a steady load takes: the integral of min(load, S).
  double Used_J(double load_W, double begin_s, double end_s) const;
  // What that load draws beyond it: the integral of max(0, load - S).
  double Shortfall_J(double load_W, double begin_s, double end_s) const;

  // For how long on either side of noon the sun alone carries the load, s; 0 where it never does.
  double Carries_s(double load_W) const;

 private:
  double HourAngle(double time_s) const;
  // |H| up to which S >= power, rad.
  double CarryingAngle(double power_W) const;
  // Integral of max(0, load - S) from noon to H, J; odd in H, and 0 where the sun carries the load.
  double ShortSinceNoon_J(double load_W, double hour_angle_rad) const;

  double noon_W_;
  double a_;
  double b_;
  double start_rad_;  // hour angle at time 0
};

}  // namespace rockyard::trial
