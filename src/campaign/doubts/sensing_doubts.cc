#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/doubts/setting_values.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

// Between two looks, or two commands, the rover is blind.
void DoubtPace(Values& s) {
  const double speed_m_s = s("rover.drive.speed_m_s");
  const double tick_m = speed_m_s / s("clock.control_rate_hz");
  s.Doubt(tick_m > s("rover.geometry.wheel_radius_m"), "rover.drive.speed_m_s",
          fmt::format("it comes {:.2g} m far between two commands (clock.control_rate_hz {:g})",
                      tick_m, s("clock.control_rate_hz")),
          "drive slower, or command more often");
  if (!s.Looks()) return;
  const double seen_m =
      s.Uses("gestalt") && s.SeesBy("stereo") ? s("sensors.stereo.max_range_m") : s.zone().x_high_m;
  const double ahead_m = seen_m - s.front_m();
  const double stop_m = speed_m_s * (0.5 * s("rover.drive.ramp_s") + s("clock.stop_time_s"));
  s.Doubt(stop_m > ahead_m, "rover.drive.ramp_s",
          fmt::format("it takes {:.2g} m to stop, and sees {:.2g} m ahead of its front", stop_m,
                      ahead_m),
          "drive slower, or see farther");
}

// The array of elevations of the pathfinder, fitted to a rover.
void DoubtArray(Values& s) {
  const trial::Zone seen = s.zone();
  const double width_m = s("rover.geometry.width_m");
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  const double wheels_m = 0.5 * s("rover.geometry.wheelbase_m") + radius_m;
  const bool stereo = s.SeesBy("stereo");
  const std::string_view array = stereo ? "perception.cloud_elevations" : "sensors.light_stripe";
  const std::string_view fit = "fit the sensor to this rover, or choose another one";
  const bool far = seen.x_high_m >= wheels_m + 2.0 * radius_m;
  s.Doubt(!far, array,
          fmt::format("it sees the ground up to {:.2g} m ahead of the rover's middle, whose wheels "
                      "reach {:.2g} m",
                      seen.x_high_m, wheels_m),
          fit);
  s.Doubt(far && seen.y_high_m - seen.y_low_m < width_m, array,
          fmt::format("it sees a strip of {:.2g} m for a rover {:.2g} m wide",
                      seen.y_high_m - seen.y_low_m, width_m),
          fit);
  const auto mean = [](const std::vector<std::int64_t>& stripes) {
    double sum = 0.0;
    for (const std::int64_t stripe : stripes) sum += static_cast<double>(stripe);
    return sum / std::max(1.0, static_cast<double>(stripes.size()));
  };
  const std::vector<std::int64_t> left = s.Integers("navigation.pathfinder.left_stripes");
  const std::vector<std::int64_t> right = s.Integers("navigation.pathfinder.right_stripes");
  s.Doubt(!left.empty() && !right.empty() && mean(left) > mean(right),
          "navigation.pathfinder.left_stripes", "are right of right_stripes",
          "count from the left: 0 is the leftmost");
  const double begins_m = stereo ? s("perception.cloud_elevations.near_m") : seen.x_low_m;
  s.Doubt(stereo && begins_m < 0.95 * s.front_m(), array,
          fmt::format("it begins {:g} m ahead of the rover's middle, and the front is at {:g} m",
                      begins_m, s.front_m()),
          "begin right before the wheels");
  s.Doubt(begins_m > s.front_m() + 0.75 * s("rover.geometry.length_m"), array,
          fmt::format("what it looks at begins {:.2g} m ahead of its front, and it remembers "
                      "nothing",
                      begins_m - s.front_m()),
          "begin right before the wheels");
  const double ahead_m = seen.x_high_m - s.front_m();
  s.AtMost("navigation.pathfinder.scan_interval_m", ahead_m,
           fmt::format("a rover that sees {:.2g} m ahead of its front", ahead_m),
           "look at all of the way");
  s.Within("perception.hazard.neighbour_threshold_m", 0.2 * radius_m, 3.0 * radius_m,
           fmt::format("wheels {:g} m high", 2.0 * radius_m), "use what these wheels do not climb");
  s.Within("perception.hazard.range_threshold_m", 0.25 * clearance_m, 1.25 * clearance_m,
           fmt::format("a belly {:g} m above the ground", clearance_m), "state the clearance");
}

void DoubtLightStripe(Values& s) {
  const double front_m = s("sensors.light_stripe.front_x_m");
  s.Doubt(std::abs(front_m - s.front_m()) > 0.15 * s("rover.geometry.length_m"),
          "sensors.light_stripe.front_x_m",
          fmt::format("the front of this rover is at {:g} m, not at {:g} m", s.front_m(), front_m),
          "use half of its length");
}

void DoubtStereo(Values& s) {
  const double ahead_m = s("sensors.stereo.front.ahead_m");
  const double high_m = s("sensors.stereo.front.height_m");
  const double length_m = s("rover.geometry.length_m");
  const double width_m = s("rover.geometry.width_m");
  s.Doubt(std::abs(ahead_m) > length_m || high_m > 5.0 * s("rover.geometry.height_m") ||
              high_m < 0.5 * s("rover.geometry.belly_clearance_m"),
          "sensors.stereo.front",
          fmt::format("cameras {:g} m ahead and {:g} m up do not stand on a rover {:g} m long",
                      ahead_m, high_m, length_m),
          "state where they are on this rover");
  const double tall_deg = s("sensors.stereo.vertical_fov_deg");
  const double pitch_deg = s("sensors.stereo.front.pitch_deg");
  s.AtLeast("sensors.stereo.front.pitch_deg", tall_deg / 8.0,
            fmt::format("cameras {:g} deg tall: much of what they see is sky", tall_deg),
            "turn them down, and check that it is in degrees");
  const double upper_deg = pitch_deg - 0.5 * tall_deg;
  const double end_m =
      upper_deg > 0.0 ? ahead_m + high_m / std::tan(math::DegToRad(upper_deg)) : kUnbounded;
  s.Doubt(
      end_m < s.front_m() + 0.25 * length_m, "sensors.stereo.front.pitch_deg",
      fmt::format("the ground is seen up to {:.2g} m ahead of the rover's middle, and its front "
                  "is at {:.2g} m",
                  end_m, s.front_m()),
      "turn the cameras up");
  s.Within("sensors.stereo.baseline_m", 0.02 * width_m, width_m,
           fmt::format("a rover {:g} m wide", width_m), "check the unit");
  // The ground half a length ahead of the front.
  const double half_fov_rad = 0.5 * math::DegToRad(s("sensors.stereo.horizontal_fov_deg"));
  const double there_m = std::hypot(s.front_m() + 0.5 * length_m - ahead_m, high_m);
  const double strip_m = 2.0 * there_m * std::tan(half_fov_rad);
  s.Doubt(strip_m < width_m, "sensors.stereo.horizontal_fov_deg",
          fmt::format("it sees a strip of {:.2g} m before a rover {:g} m wide", strip_m, width_m),
          "use a wider lens");
  // disparity = focal length times baseline over depth
  const double product_px_m =
      0.5 * s("sensors.stereo.columns") / std::tan(half_fov_rad) * s("sensors.stereo.baseline_m");
  s.AtLeast("sensors.stereo.max_disparity_px", product_px_m / (1.5 * there_m),
            fmt::format("ground {:.2g} m before the cameras", there_m),
            "search farther: disparities grow with columns and baseline");
  const double path_m = s("navigation.gestalt.plan.plan_max_dist_m");
  const double range_m = s("sensors.stereo.max_range_m");
  const double used_m =
      s.Uses("gestalt") ? std::min(range_m, path_m) : s("perception.cloud_elevations.far_m");
  s.AtMost("sensors.stereo.min_disparity_px", product_px_m / (0.6 * used_m),
           fmt::format("depths up to {:.2g} m", used_m), "use less, or a longer baseline");
  if (s.Is("sensors.stereo.fidelity", "image")) {
    s.Doubt(s("sensors.sun.irradiance_w_m2_nm") == 0.0, "sensors.sun.irradiance_w_m2_nm",
            "nothing lights the ground that the cameras look at", "give it the light of a place");
    if (s("sensors.sun.optical_depth") > 0.0) {
      s.AtLeast("sensors.sun.elevation_deg", 2.0, "cameras that see by its light through dust",
                "drive by day");
    }
    s.AtMost("perception.stereo.filters.blob_min_px",
             0.1 * s("sensors.stereo.columns") * s("sensors.stereo.rows"),
             "images of that size: whole rocks are regions", "use a hundredth of the image");
    s.Doubt(s("sensors.look.soil_graininess") == 0.0 && s("sensors.look.drift.contrast") == 0.0,
            "sensors.look", "soil without grain and contrast has nothing that matches",
            "leave it some texture");
  }
  if (s.Uses("gestalt")) {
    s.AtLeast("sensors.stereo.max_range_m", 0.5 * path_m,
              fmt::format("paths that are judged for {:g} m", path_m),
              "judge the ground that is seen");
  }
}

}  // namespace

void DoubtScenes(Values& s) {
  const experiments::HazardDetectionParams& scenes = s.whole.experiment.hazard_detection;
  if (scenes.study != experiments::HazardStudy::kDetection || scenes.distances_m.empty()) return;
  const double end_m = s.zone().x_high_m - s.front_m();
  s.Doubt(
      std::ranges::min(scenes.distances_m) - 0.5 * scenes.distance_width_m > end_m,
      "hazard_detection.distances_m",
      fmt::format("no rock lies within the {:.2g} m ahead of its front that it looks at", end_m),
      "use distances at which it can see a rock");
}

void DoubtSensing(Values& s) {
  DoubtPace(s);
  if (s.DrivesByArray()) DoubtArray(s);
  if (s.Looks() && s.SeesBy("light_stripe")) DoubtLightStripe(s);
  if (s.Looks() && s.SeesBy("stereo")) DoubtStereo(s);
}

}  // namespace rockyard::campaign
