#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "campaign/doubts/setting_doubts.h"
#include "math/angles.h"
#include "math/sun_position.h"

namespace rockyard::campaign {
namespace {

void DoubtLocalization(Values& s) {
  if (s.Is("localization.estimator", "oracle")) return;
  const std::string course = s.OfCourse();
  s.Within("sensors.gyro.scale", 0.75, 1.25, "a gyro that measures turns", "use a share near 1");
  const double bias_deg_s = s("sensors.gyro.bias_sd_deg_per_s");
  const double driven_s = s.course_m() / s("rover.drive.speed_m_s");
  s.Doubt(bias_deg_s > 0.05 && bias_deg_s * driven_s > 45.0, "sensors.gyro.bias_sd_deg_per_s",
          fmt::format("it turns the heading by {:.3g} deg over the course", bias_deg_s * driven_s),
          "check the unit: gyros of this kind keep 0.01 deg/s");
  s.AtMost("sensors.gyro.heading_variance_deg2_per_m", 45.0 * 45.0 / s.course_m(), course,
           "check the unit: it is a variance");
  const double speed_m_s = s("rover.drive.speed_m_s");
  if (s.Is("localization.estimator", "error_state")) {
    const double reference_m_s = s("sensors.gyro.reference_speed_m_s");
    s.Within("localization.error_state.drift.reference_speed_m_s", reference_m_s / 5.0,
             5.0 * reference_m_s,
             fmt::format("a gyro whose variance is of {:g} m/s", reference_m_s),
             "state that of the gyro");
    s.Doubt(s.On("sensors.gyro.accumulates_at_rest") &&
                !s.On("localization.error_state.drift.drifts_at_rest"),
            "localization.error_state.drift.drifts_at_rest", "the gyro drifts at rest",
            "tell the filter, too");
    const double error = std::abs(s("sensors.gyro.scale") - 1.0);
    s.AtLeast("localization.error_state.prior.gyro_scale_sd", error / 4.0,
              fmt::format("a gyro whose scale is off by {:.2g}", error),
              "use how well the scale is known");
    const double drift = s("sensors.gyro.heading_variance_deg2_per_m");
    s.Within("localization.error_state.drift.heading_variance_deg2_per_m", drift / 10.0,
             std::max(100.0 * drift, 2.0), fmt::format("a gyro of {:g}", drift),
             "use that of the gyro, or somewhat more");
  }
  s.AtMost("sensors.gyro.scrape.min_sliding_speed_m_s", 0.8 * s("rover.drive.speed_m_s"),
           fmt::format("a rover that drives {:g} m/s: no scrape would count",
                       s("rover.drive.speed_m_s")),
           "use a share of its speed");
  if (s.On("sensors.visual_odometry.enabled")) {
    for (const char* axis : {"along", "across", "up"}) {
      s.AtMost(fmt::format("sensors.visual_odometry.error_model.{}.per_m", axis), 0.05,
               "visual odometry: wheels on sand are as good", "use a share, not per cent");
    }
    s.AtMost("sensors.visual_odometry.schedule.every_deg",
             0.6 * s("sensors.stereo.horizontal_fov_deg"),
             fmt::format("images {:g} deg wide", s("sensors.stereo.horizontal_fov_deg")),
             "let images show common ground");
    double every_s = kUnbounded;
    for (const double due_s : {s("sensors.visual_odometry.schedule.every_s"),
                               s("sensors.visual_odometry.schedule.every_m") / speed_m_s}) {
      if (due_s > 0.0) every_s = std::min(every_s, due_s);
    }
    s.AtMost("clock.compute.visual_cpu_s", every_s,
             fmt::format("images that are due every {:.3g} s", every_s), "check the unit");
    const double range_m = s("sensors.stereo.max_range_m");
    s.AtMost("sensors.visual_odometry.schedule.every_m", 0.5 * range_m,
             fmt::format("images that show the ground up to {:g} m", range_m),
             "use less than a metre");
  }
  if (s.On("perception.visual_odometry.slip_check.enabled")) {
    const double keyframe_m = s.Is("sensors.visual_odometry.fidelity", "image")
                                  ? s("perception.visual_odometry.keyframe.max_way_m")
                                  : s("sensors.visual_odometry.error_model.keyframe_m");
    const double together_m = keyframe_m + s("sensors.visual_odometry.schedule.every_m");
    s.AtMost("perception.visual_odometry.slip_check.min_way_m", together_m,
             fmt::format("keyframes of {:.3g} m: so far none is kept", together_m),
             "use some revolutions of a wheel");
  }
}

void DoubtAids(Values& s) {
  const std::string course = s.OfCourse();
  for (const std::string_view aid : {"lander_fix", "sun", "beacon"}) {
    const std::string group = fmt::format("sensors.aids.{}", aid);
    if (!s.On(group + ".enabled")) continue;
    if (s(group + ".every_s") == 0.0) {
      s.AtMost(group + ".every_m", s.course_m(), course, "let it come on the way");
    }
    if (aid == "sun") continue;
    s.AtLeast(group + ".range_m", 0.25 * s.course_m(), course, "let it reach along the way");
  }
  if (s.On("sensors.aids.beacon.enabled")) {
    s.AtMost("sensors.aids.beacon.range_sd_m", 0.5 * s.course_m(), course, "check the unit");
  }
  if (!s.On("sensors.aids.sun.enabled")) return;
  const math::SkyDirection sun = math::SunPosition(
      math::DegToRad(s("sensors.aids.sun.latitude_deg")),
      math::SunDeclination(math::DegToRad(s("sensors.aids.sun.areocentric_longitude_deg"))),
      s("sensors.aids.sun.start_solar_time_h"));
  s.Doubt(sun.elevation_rad < 0.0, "sensors.aids.sun.start_solar_time_h",
          fmt::format("at {:g} h and a latitude of {:g} deg the sun has set",
                      s("sensors.aids.sun.start_solar_time_h"), s("sensors.aids.sun.latitude_deg")),
          "drive by day");
}

}  // namespace

void DoubtBelief(Values& s) {
  DoubtLocalization(s);
  DoubtAids(s);
}

namespace {

void DoubtVehicle(Values& s) {
  struct Told {
    std::string_view path;
    std::string_view of;
    double alike;  // share of the rover's
  };
  constexpr std::string_view kGroup = "navigation.gestalt.map.rover";
  constexpr Told kTold[] = {{"width_m", "width_m", 0.1},
                            {"length_m", "length_m", 0.15},
                            {"wheel_radius_m", "wheel_radius_m", 0.25},
                            {"clearance_m", "belly_clearance_m", 0.25}};
  std::string differing;
  for (const Told& told : kTold) {
    const double believed = s(fmt::format("{}.{}", kGroup, told.path));
    const double real = s(fmt::format("rover.geometry.{}", told.of));
    if (std::abs(believed - real) < told.alike * real) continue;
    differing +=
        fmt::format("{}{} {:g} for {:g}", differing.empty() ? "" : ", ", told.path, believed, real);
  }
  s.Doubt(!differing.empty(), kGroup, "it drives another vehicle: " + differing,
          "state length_m, width_m, wheel_radius_m, clearance_m and obst_height_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  s.Within("navigation.gestalt.map.rover.obst_height_m", 0.25 * clearance_m, 1.25 * clearance_m,
           fmt::format("a belly {:g} m above the ground", clearance_m),
           "use what this rover climbs");
}

void DoubtMap(Values& s) {
  const double length_m = s("rover.geometry.length_m");
  const double width_m = s("rover.geometry.width_m");
  const double path_m = s("navigation.gestalt.plan.plan_max_dist_m");
  const std::string rover = fmt::format("a rover {:g} m long", length_m);
  const std::string paths = fmt::format("paths that are judged for {:g} m", path_m);
  for (const char axis : {'x', 'y'}) {
    const std::string grid = "navigation.gestalt.map.grid.";
    s.AtMost(fmt::format("{}{}step_m", grid, axis), 0.75 * width_m,
             fmt::format("a rover {:g} m wide", width_m), "use several cells for its width");
    const std::string end = fmt::format("{}{}N_m", grid, axis);
    s.AtLeast(end, s(fmt::format("{}{}0_m", grid, axis)) + 1.5 * path_m, paths,
              "let it reach plan_max_dist_m to every side");
  }
  s.AtLeast("navigation.gestalt.map.grid_dist_timeout_m", 0.75 * path_m, paths,
            "keep what was seen of them");
  s.AtMost("navigation.gestalt.plan.plan_min_dist_m", length_m, rover,
           "judge the ground right before it");
  s.AtLeast("navigation.gestalt.plan.plan_max_dist_m", length_m, rover,
            "judge what it drives until the next look");
  s.AtMost("navigation.gestalt.drive.step_m", 0.6 * path_m, paths, "use a fraction of them");
  for (const char* name : {"votes.min_fwd_threshold", "votes.min_allowed_goodness",
                           "votes.min_vote_goodness", "waypoints.waypoint_certainty"}) {
    const std::string path = fmt::format("navigation.gestalt.{}", name);
    s.Doubt(s(path) > 0.0 && s(path) < 1.5, path,
            fmt::format("{:g} of 255 is next to none", s(path)), "count to 255, not to 1");
  }
  s.AtMost("navigation.gestalt.votes.min_allowed_goodness", 180.0,
           "cells of 255: those beside an obstacle and unknown ones are below",
           "use 10, as Goldberg 2002 does");
  const double step_s = s("navigation.gestalt.drive.step_m") / s("rover.drive.speed_m_s");
  s.AtLeast("navigation.gestalt.drive.step_time_out_s", step_s,
            fmt::format("a step that takes {:.3g} s", step_s), "use some times as long");
  if (s.Is("navigation.gestalt.continuous.cycle", "stop_and_look")) return;
  s.AtMost("navigation.gestalt.splines.length_m", 2.0 * s("sensors.stereo.max_range_m"),
           fmt::format("cameras that see {:g} m", s("sensors.stereo.max_range_m")),
           "lead them over what is seen");
}

}  // namespace

// Doubts what GESTALT is told, parameters of Goldberg 2002, table 1.
void DoubtGestalt(Values& s) {
  if (!s.Uses("gestalt")) return;
  DoubtVehicle(s);
  DoubtMap(s);
}

}  // namespace rockyard::campaign
