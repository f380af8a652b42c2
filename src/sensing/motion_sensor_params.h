// Parameters of the turn-rate gyro (Systron Donner QRS-11 on Rocky 3.2), of what scraping against
// rocks does to it, and of the encoders (scenario groups sensors.gyro and sensors.encoders). The
// sensors of motion_sensors.h read them; defaults decide records.
//
// Published growths of errors are those of a rover on level sand, whose physics adds errors of its
// own. level_sand_gain and physics_variance_m2_per_m make up for those. They must be calibrated
// anew where soil, wheels or odometer change (calibrate_odometer.py).
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

// Which way the measured heading jumps when the rover scrapes a rock.
enum class ScrapeSign {
  kRandom,  // either way with equal chance, drawn per episode
  kLeft,
  kRight,
};

// What counts as a scrape, and the jump of the measured heading that it causes.
struct ScrapeParams {
  bool enabled = true;
  double jump_rad = math::DegToRad(5.0);
  double jump_spread_rad = 0.0;
  ScrapeSign sign = ScrapeSign::kRandom;
  double min_force_N = 1.0;
  double min_sliding_speed_m_s = 0.01;
  double episode_gap_s = 1.0;
  double episode_gap_m = 0.05;

  void Visit(core::FieldVisitor& v) {
    v.Boolean("enabled", enabled,
              core::Published("scraping a rock makes the measured heading jump",
                              "Matthies 1995 sec. 5, 8"));
    v.Angle("jump_deg", jump_rad,
            core::Published("size of the jump", "Matthies 1995 sec. 8: about 5 deg", {0.0, 90.0}));
    v.Angle("jump_spread_deg", jump_spread_rad,
            core::Assumed("standard deviation of the jump's size", "the paper gives one size",
                          {0.0, 30.0}, {0.0, 2.5}));
    v.Choice("sign", sign,
             core::Assumed("which way the measured heading jumps", "the paper shows no rule"));
    v.Real("min_force_N", min_force_N,
           core::Assumed(
               "normal force of body on rock from which a sliding contact counts as a scrape",
               "leaves grazing contacts out", {0.0, 1e3}, {0.1, 10.0}));
    v.Real("min_sliding_speed_m_s", min_sliding_speed_m_s,
           core::Assumed("sliding speed from which a contact counts as a scrape",
                         "leaves resting contacts out", {0.0, 1.0}, {0.002, 0.05}));
    v.Real("episode_gap_s", episode_gap_s,
           core::Assumed("time without scraping a rock before scraping it is a new episode",
                         "one jump a scrape", {0.0, 1e3}, {0.3, 5.0}));
    v.Real(
        "episode_gap_m", episode_gap_m,
        core::Assumed("travel since the last scrape of a rock before scraping it is a new episode",
                      "one jump a scrape", {0.0, 10.0}, {0.02, 0.3}));
  }
};

// Scale, noise and scrapes of the gyro.
struct GyroParams {
  double scale = 0.94;
  double heading_variance_deg2_per_m = 0.70;
  double level_sand_gain = 1.0;
  double reference_speed_m_s = 0.15;
  bool accumulates_at_rest = false;
  double bias_sd_rad_s = 0.0;
  ScrapeParams scrape{};

  // Returns the growth of the heading's variance in time that the noise alone gives, rad2/s.
  double heading_variance_rad2_per_s() const {
    const double rad_per_deg = math::DegToRad(1.0);
    return heading_variance_deg2_per_m / level_sand_gain * rad_per_deg * rad_per_deg *
           reference_speed_m_s;
  }

  void Visit(core::FieldVisitor& v) {
    v.Real("scale", scale,
           core::Published("measured over true turn",
                           "Matthies 1995 sec. 8: turns underestimated by about 6 %", {0.5, 1.5}));
    v.Real(
        "heading_variance_deg2_per_m", heading_variance_deg2_per_m,
        core::Published("growth of the heading error's variance per metre at reference_speed_m_s "
                        "on level sand; over level_sand_gain it is a rate noise in time",
                        "Matthies 1995 sec. 5", {0.0, 1e4}));
    v.Real(
        "level_sand_gain", level_sand_gain,
        core::Calibrated("growth of the squared heading error along runs on level sand, the slope "
                         "of fig. 5, over that of the noise alone: slip slows the rover, whose "
                         "noise runs in time, and a wrong scale adds what it turns to correct",
                         "straight 7 m runs of the simulated rover on level sand; 1: the noise "
                         "alone has the published growth",
                         {0.1, 10.0}));
    v.Real("reference_speed_m_s", reference_speed_m_s,
           core::Published("speed at which that growth was measured", "Matthies 1995 sec. 5",
                           {1e-4, 10.0}));
    v.Boolean(
        "accumulates_at_rest", accumulates_at_rest,
        core::Assumed(
            "the rate noise goes on while the rover stands still",
            "the paper ties the drift to driving; a scan of 20 s at rest would add 2.1 deg2"));
    v.Angle("bias_sd_deg_per_s", bias_sd_rad_s,
            core::Assumed("standard deviation of a rate that the gyro adds all through a trial, "
                          "drawn once; it counts whenever the noise does, deg/s",
                          "none in the paper, whose runs were begun anew; gyros of this kind keep "
                          "0.002 to 0.01 deg/s over an hour",
                          {0.0, 10.0}, {0.0, 0.01}));
    v.Group("scrape", scrape, "heading jumps when the rover's body scrapes a rock");
  }
};

// The distance error of the encoders (Matthies 1995, section 5).
struct EncoderParams {
  double distance_variance_m2_per_m = 0.0039;
  double physics_variance_m2_per_m = 0.0;
  double level_sand_gain = 1.0;
  double noise_stretch_m = 0.067;

  // Returns what the encoders add to the distance error that wheel slip already causes, m2 a metre
  // that the wheels roll.
  double noise_variance_m2_per_m() const {
    return (distance_variance_m2_per_m - physics_variance_m2_per_m) / level_sand_gain;
  }

  void Visit(core::FieldVisitor& v) {
    v.Real(
        "distance_variance_m2_per_m", distance_variance_m2_per_m,
        core::Published("growth of the dead-reckoned distance's variance on level, rock-free sand",
                        "Matthies 1995 sec. 5", {0.0, 1.0}));
    v.Real("physics_variance_m2_per_m", physics_variance_m2_per_m,
           core::Calibrated("share of it that the simulated wheels already yield on level sand",
                            "straight 7 m runs of the simulated rover on level sand", {0.0, 1.0}));
    v.Require("physics_variance_m2_per_m", physics_variance_m2_per_m <= distance_variance_m2_per_m,
              "is larger than distance_variance_m2_per_m, so that no encoder noise could bring the "
              "sum to the published value",
              "use a value up to distance_variance_m2_per_m");
    v.Real("level_sand_gain", level_sand_gain,
           core::Calibrated("growth of the dead-reckoned distance's variance on level sand over "
                            "that of the noise per metre rolled: an odometer of scale s takes s^2 "
                            "of the variance, over 1 / s as many metres, so that it is s",
                            "closed form: perception.dead_reckoning.distance_scale; 1: what wheels "
                            "roll is taken for distance",
                            {0.1, 10.0}));
    v.Real("noise_stretch_m", noise_stretch_m,
           core::Published("travel over which the distance error keeps its rate",
                           "Matthies 1995 sec. 5: steps of 6.7 cm", {0.001, 100.0}));
  }
};

}  // namespace rockyard::sensing

template <>
struct rockyard::core::EnumNames<rockyard::sensing::ScrapeSign> {
  static constexpr std::array<std::string_view, 3> kNames{"random", "left", "right"};
};
