#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "campaign/doubts/setting_values.h"

namespace rockyard::campaign {
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

// Goldberg 2002, table 1.
void DoubtGestalt(Values& s) {
  if (!s.Uses("gestalt")) return;
  DoubtVehicle(s);
  DoubtMap(s);
}

}  // namespace rockyard::campaign
