#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "campaign/doubts/setting_doubts.h"

namespace rockyard::campaign {
namespace {

// A group of parameters, or one, that has an effect only where `read` is true. Values without
// effect are doubted of a group that is missing in the list below.
struct Unread {
  std::string_view path;  // with which parameters begin
  bool read;
};

// Returns whether something that is chosen or enabled reads the parameter. Parameters of the rover
// itself, and what its motors draw, are left out: their ranges are of one rover's size. So are
// limits that follow the course.
bool IsUsed(const Values& s, const std::string& path) {
  const auto begins = [&](std::string_view group) { return path.starts_with(group); };
  const std::string_view parts[] = {"terrain.",    "sensors.",      "perception.",
                                    "navigation.", "course.",       "referee.",
                                    "clock.",      "localization.", "mission."};
  if (std::none_of(std::begin(parts), std::end(parts), begins)) return false;
  const bool scenes = s.whole.experiment.chosen().name() == "hazard_detection";
  if (scenes && !begins("sensors.") && !begins("perception.")) return false;
  const bool stripes = s.Looks() && s.SeesBy("light_stripe");
  const bool stereo = s.Looks() && s.SeesBy("stereo");
  const bool vehicle = s.On("sensors.vehicle.articulation.enabled") ||
                       s.On("sensors.vehicle.accelerometers.enabled") ||
                       s.On("sensors.vehicle.motor_current.enabled") ||
                       s.On("sensors.vehicle.contact.enabled");
  const bool continuous = !s.Is("navigation.gestalt.continuous.cycle", "stop_and_look");
  const bool visual = s.On("sensors.visual_odometry.enabled");
  const bool oracle = s.Is("localization.estimator", "oracle");
  const bool stereo_images = s.Is("sensors.stereo.fidelity", "image");
  const Unread unread[] = {
      {"perception.vehicle_hazard.max_current_A", false},
      {"perception.stuck_detector.strain_current_A", false},
      {"sensors.vehicle.motor_current.", false},
      {"referee.no_path_", false},
      {"clock.compute.stereo_time_factor", false},
      {"terrain.ground.soil.", !s.Is("terrain.ground.soil.preset", "hard_ground")},
      {"terrain.rocks.", s.HasRocks()},
      {"mission.", s.whole.experiment.chosen().name() == "mission"},
      {"navigation.pathfinder.", s.Uses("pathfinder")},
      {"navigation.gestalt.", s.Uses("gestalt")},
      {"navigation.gestalt.continuous.", continuous},
      {"navigation.gestalt.splines.", continuous},
      {"navigation.gestalt.speed.", continuous},
      {"navigation.route.", s.Uses("route")},
      {"sensors.light_stripe.", stripes},
      {"sensors.light_stripe.imager.", s.Is("sensors.light_stripe.fidelity", "image")},
      {"sensors.light_stripe.laser.",
       s.Is("sensors.light_stripe.fidelity", "image") && s("sensors.sun.irradiance_w_m2_nm") > 0.0},
      {"sensors.stereo.", stereo},
      {"sensors.stereo.dropout_probability", !stereo_images},
      {"sensors.stereo.mismatch_probability", !stereo_images},
      {"sensors.stereo.disparity_noise_px", !stereo_images},
      {"sensors.stereo.edge_", !stereo_images},
      {"sensors.look.", stereo_images},
      {"sensors.gyro.", !oracle},
      {"sensors.encoders.", !oracle},
      {"perception.stripe_finder.", stripes},
      {"perception.hazard.", s.DrivesByArray()},
      {"perception.cloud_elevations.", s.DrivesByArray() && stereo},
      {"perception.stereo.", stereo && stereo_images},
      {"perception.vehicle_hazard.", vehicle},
      {"perception.visual_odometry.", visual},
      {"localization.error_state.", s.Is("localization.estimator", "error_state")},
      {"clock.scan_", stripes},
      {"clock.compute.", stereo || visual},
  };
  for (const Unread& each : unread) {
    if (begins(each.path) && !each.read) return false;
  }
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
    if (s.IsOff(path.substr(0, dot) + ".enabled")) return false;
  }
  return true;
}

// What is usual of a value, generously. It stands in place of the range of studies.
struct Usual {
  std::string_view path;
  double low;
  double high;
  std::string_view what;
};
constexpr Usual kUsual[] = {
    {"terrain.rocks.burial_mean", 0.0, 0.7, "rocks that stand out of the ground"},
    {"terrain.rocks.min_height_ratio", 0.2, 3.0, "rocks as heights over diameters go"},
    {"terrain.rocks.max_height_ratio", 0.3, 4.0, "rocks as heights over diameters go"},
    {"rover.drive.speed_m_s", 0.002, 2.0, "a planetary rover"},
    {"rover.drive.ramp_s", 0.0, 10.0, "a motor that starts"},
    {"rover.physics.gravity_m_s2", 0.2, 12.0,
     "a place with ground: Ceres 0.28, Moon 1.62, Mars 3.72, Earth 9.81"},
    {"rover.contact.wheel_rock_friction", 0.3, 1.5, "wheels on rock"},
    {"rover.contact.body_rock_friction", 0.1, 1.2, "a body on rock"},
    {"rover.geometry.rocker_limit_deg", 8.0, 80.0, "rockers that follow the ground"},
    {"sensors.light_stripe.laser.input_power_w", 0.01, 10.0, "a laser that is seen by day"},
    {"sensors.light_stripe.wrong_place_probability", 0.0, 0.2, "points that hazards are found in"},
    {"sensors.light_stripe.missed_probability", 0.0, 0.7, "points that hazards are found in"},
    {"sensors.light_stripe.column_noise_px", 0.0, 20.0, "stripes that are found"},
    {"sensors.stereo.columns", 48.0, kUnbounded, "matching"},
    {"sensors.stereo.rows", 32.0, kUnbounded, "matching"},
    {"sensors.stereo.dropout_probability", 0.0, 0.85, "ground that is seen"},
    {"sensors.stereo.mismatch_probability", 0.0, 0.2, "ground that is seen"},
    {"sensors.visual_odometry.pyramid_level", 0.0, 2.0, "images that keep their features"},
    {"sensors.gyro.level_sand_gain", 0.2, 5.0, "a gyro"},
    {"sensors.gyro.scrape.jump_deg", 0.0, 30.0, "a scrape of a rock"},
    {"sensors.encoders.distance_variance_m2_per_m", 0.0, 0.03, "wheels that roll"},
    {"sensors.aids.lander_fix.heading_sd_deg", 0.0, 30.0, "an aid"},
    {"sensors.aids.lander_fix.range_sd_fraction", 0.0, 0.3, "an aid"},
    {"sensors.aids.lander_fix.bearing_sd_rad", 0.0, 0.1, "an aid"},
    {"sensors.aids.lander_fix.delay_s", 0.0, 7200.0, "a drive that goes on"},
    {"sensors.aids.beacon.bearing_sd_deg", 0.0, 30.0, "an aid"},
    {"sensors.aids.sun.half_field_of_view_deg", 10.0, 90.0, "a camera that finds the sun"},
    {"perception.attitude.filter_s", 0.0, 10.0, "a rover that tilts in seconds"},
    {"localization.error_state.prior.position_sd_m", 0.0, 5.0,
     "a rover that begins beside its lander"},
    {"localization.error_state.prior.heading_sd_deg", 0.0, 45.0,
     "a rover that begins beside its lander"},
    {"localization.error_state.prior.wheel_scale_sd", 0.0, 0.3, "wheels of known size"},
    {"localization.error_state.gate.chance", 0.0, 0.1, "fixes that are mostly right"},
    {"localization.error_state.stretch_m", 0.0, 1.0, "a filter"},
    {"navigation.pathfinder.scan_interval_m", 0.011, kUnbounded, "looks of many seconds"},
    {"navigation.pathfinder.turn_increment_deg", 2.0, 60.0, "a turn around a rock"},
    {"navigation.pathfinder.turn_give_up_deg", 90.0, kUnbounded, "a rover that looks around"},
    {"navigation.pathfinder.heading_deadband_deg", 0.0, 30.0, "driving to a goal"},
    {"navigation.pathfinder.clear_distance_m", 0.0, 3.0, "a rock to pass"},
    {"navigation.gestalt.arcs.num_forward_arcs", 3.0, kUnbounded, "a choice"},
    {"navigation.gestalt.map.max_idles", 10.0, kUnbounded, "a map that is kept"},
    {"navigation.gestalt.map.min_cell_points", 0.0, 50.0, "cells that stereo fills"},
    {"navigation.gestalt.map.roughness_fraction", 0.05, 10.0, "a share of the obstacle height"},
    {"navigation.gestalt.map.rover.max_pitch_deg", 5.0, 60.0, "ground that a rover climbs"},
    {"navigation.gestalt.waypoints.vote_index_variance", 1.0, 10000.0,
     "arcs counted from -11 to 11"},
    {"navigation.gestalt.continuous.motion_m", 0.1, 5.0, "a motion between plans"},
    {"navigation.gestalt.speed.min_speed_share", 0.05, 1.0, "a rover that goes on"},
    {"navigation.gestalt.splines.max_curvature_per_m", 0.1, kUnbounded, "a way around rocks"},
    {"navigation.route.corner_tolerance_m", 0.0, 0.5, "a route between rocks"},
    {"navigation.route.steer_interval_m", 0.005, 1.0, "a route between rocks"},
    {"navigation.route.heading_deadband_deg", 0.0, 20.0, "a route between rocks"},
    {"course.tracking.half_field_of_view_deg", 5.0, 180.0, "a camera that keeps a goal in view"},
    {"course.tracking.range_sd_fraction", 0.0, 0.3, "a goal that is tracked"},
    {"clock.scan_time_s", 0.0, 300.0, "a look"},
    {"clock.scan_speed_factor", 0.2, kUnbounded, "a scan of today: above 1 is faster"},
    {"clock.control_rate_hz", 1.0, 1000.0, "a control loop"},
    {"clock.stop_time_s", 0.0, 10.0, "wheels that stop"},
};

// Doubts assumed values far outside of the range in which studies vary them: most often they are in
// another unit.
void DoubtUnits(Values& s) {
  constexpr double kFar = 5.0;  // times the range's end; units differ by 57 and more
  for (const core::ParameterInfo& each : s.parameters) {
    if (!each.HasStudyRange() || each.study_low < 0.0 || s.IsDoubted(each.path)) continue;
    if (each.kind != core::FieldKind::kReal && each.kind != core::FieldKind::kAngle) continue;
    const double value = each.value.number();
    const double low = each.study_low / kFar;
    if (value == 0.0 || (value >= low && value <= kFar * each.study_high)) continue;  // 0: off
    const auto is_it = [&](const Usual& usual) { return usual.path == each.path; };
    if (std::any_of(std::begin(kUsual), std::end(kUsual), is_it) || !IsUsed(s, each.path)) continue;
    s.Doubt(true, each.path,
            fmt::format("{:g} is far from {:g} to {:g}, where studies have it", value,
                        each.study_low, each.study_high),
            each.unit == "1" ? "check it: it has no unit" : "check the unit: " + each.unit);
  }
}

}  // namespace

void DoubtUnusual(Values& s) {
  for (const Usual& usual : kUsual) {
    const std::string path(usual.path);
    const bool drives = s.whole.experiment.chosen().name() != "hazard_detection";
    if (!(drives && path.starts_with("rover.")) && !IsUsed(s, path)) continue;
    s.Within(path, usual.low, usual.high, usual.what, "check the unit, and what it means");
  }
  DoubtUnits(s);
}

}  // namespace rockyard::campaign
