#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/doubts/setting_doubts.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "math/angles.h"
#include "math/functions.h"
#include "rover/rover_params.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {
namespace {

// Doubts speeds: between two looks, or two commands, the rover is blind.
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

// Doubts whether the array of elevations of the pathfinder is fitted to the rover.
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
      upper_deg > 0.0 ? ahead_m + high_m / math::Tan(math::DegToRad(upper_deg)) : kUnbounded;
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
  const double there_m = math::Hypot(s.front_m() + 0.5 * length_m - ahead_m, high_m);
  const double strip_m = 2.0 * there_m * math::Tan(half_fov_rad);
  s.Doubt(strip_m < width_m, "sensors.stereo.horizontal_fov_deg",
          fmt::format("it sees a strip of {:.2g} m before a rover {:g} m wide", strip_m, width_m),
          "use a wider lens");
  // disparity = focal length times baseline over depth
  const double product_px_m =
      0.5 * s("sensors.stereo.columns") / math::Tan(half_fov_rad) * s("sensors.stereo.baseline_m");
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
  const experiments::HazardDetectionParams& scenes =
      s.whole.experiment.params<experiments::HazardDetectionParams>();
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

namespace {

void DoubtShape(Values& s) {
  const double length_m = s("rover.geometry.length_m");
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  const std::string rover = fmt::format("a rover {:g} m long", length_m);
  // Rocky 3.2 and MFEX have 0.10, MER 0.08.
  s.Within("rover.geometry.wheel_radius_m", 0.05 * length_m, 0.25 * length_m, rover,
           "check the unit: a tenth of the length is usual");
  s.Within("rover.geometry.wheelbase_m", std::max(4.4 * radius_m, 0.6 * length_m - 2.0 * radius_m),
           1.2 * length_m, fmt::format("{} with wheels of {:g} m", rover, 2.0 * radius_m),
           "state the distance of its outer axles");
  s.Within("rover.geometry.width_m", 0.3 * length_m, 2.0 * length_m, rover,
           "state the outer faces of its wheels");
  s.Within("rover.geometry.belly_clearance_m", 0.75 * radius_m, 5.0 * radius_m,
           fmt::format("wheels {:g} m high", 2.0 * radius_m),
           "state the height of the chassis' underside");
  s.Within("rover.mass.chassis_com_z_m", clearance_m, s("rover.geometry.height_m"),
           fmt::format("a chassis from {:g} to {:g} m above the ground", clearance_m,
                       s("rover.geometry.height_m")),
           "state it from the ground up");
  const double moving_kg =
      6.0 * s("rover.mass.wheel_kg") + 2.0 * (s("rover.mass.rocker_kg") + s("rover.mass.bogie_kg"));
  s.AtLeast("rover.mass.total_kg", moving_kg / 0.75,
            fmt::format("wheels and arms of {:g} kg", moving_kg),
            "state the masses of this rover's parts, too");
}

void DoubtTraction(Values& s) {
  // The resistance over the load: of sand, or of a rock that half of the wheels climb.
  const double resistance = s.HasRocks() ? 0.5 : 0.15;
  const double gravity_m_s2 = s("rover.physics.gravity_m_s2");
  const double weight_N = s("rover.mass.total_kg") * gravity_m_s2;
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double need_N =
      weight_N * (math::Sin(math::DegToRad(s("terrain.ground.slope_deg"))) + resistance);
  s.AtLeast("rover.drive.stall_torque_Nm", need_N * radius_m / 6.0,
            fmt::format("the {:.3g} N that {} takes here", need_N,
                        s.HasRocks() ? "climbing rocks" : "rolling"),
            "state the torque at the wheel, behind its gears");
  // The rolling resistance over the weight: larger on soils, 0.01 to 0.02 on concrete.
  const double rolling = s.Is("terrain.ground.soil.preset", "hard_ground") ? 0.01 : 0.05;
  const double rolling_W = rolling * weight_N * s("rover.drive.speed_m_s");
  s.AtLeast("energy.driving_W", rolling_W,
            fmt::format("{:.3g} N that roll at {:g} m/s", weight_N, s("rover.drive.speed_m_s")),
            "state what the drive motors draw, in W");
  s.AtLeast("rover.contact.stiffness_N_m", weight_N / 6.0 / (0.2 * radius_m),
            fmt::format("a load of {:.3g} N a wheel", weight_N / 6.0),
            "use a stiffness for this mass");
  const terrain::SoilParams& soil = s.drive.terrain.ground.soil;
  const double sinkage_m =
      rover::MakeWheelOnSoil(s.drive.rover, soil).Under(weight_N / 6.0, 0.0).sinkage_m;
  s.Doubt(sinkage_m > 0.5 * radius_m, "terrain.ground.soil",
          fmt::format("wheels of {:g} m sink {:.2g} m into it", 2.0 * radius_m, sinkage_m),
          "check the units of its moduli: N, not kN");
  if (s.Is("terrain.ground.soil.preset", "hard_ground")) return;
  s.Within("terrain.ground.soil.friction_angle_deg", 15.0, 55.0, "a dry soil", "use 25 to 45");
  // Presets as they are, held against gravity: the bound lies between Mars, 3.72, and Earth, 9.81,
  // as kBetweenMarsAndEarth_m_s2 in scenario_doubts.cc.
  constexpr double kBetween_m_s2 = 6.0;
  const terrain::SoilParams as_it_is = terrain::MakeSoil(soil.preset);
  const bool own = soil.density_kg_m3 != as_it_is.density_kg_m3 ||
                   soil.cohesive_modulus_N_per_mn1 != as_it_is.cohesive_modulus_N_per_mn1 ||
                   soil.frictional_modulus_N_per_mn2 != as_it_is.frictional_modulus_N_per_mn2;
  const bool of_mars = soil.preset == terrain::SoilPreset::kMarsDrift ||
                       soil.preset == terrain::SoilPreset::kSojournerSoil ||
                       soil.preset == terrain::SoilPreset::kSojournerDrift;
  s.Doubt(!own && of_mars == (gravity_m_s2 > kBetween_m_s2), "terrain.ground.soil.preset",
          fmt::format("{} under {:g} m/s2", of_mars ? "the soil of Mars" : "the sand of an arena",
                      gravity_m_s2),
          "choose another preset, or state the moduli of the place");
}

void DoubtMotors(Values& s) {
  const double per_ampere = s("sensors.vehicle.motor_current.torque_per_ampere_Nm_A");
  const double stall_A =
      s("rover.drive.stall_torque_Nm") / per_ampere + s("sensors.vehicle.motor_current.no_load_A");
  if (s.On("sensors.vehicle.motor_current.enabled")) {
    s.AtMost("perception.vehicle_hazard.max_current_A", 1.5 * stall_A,
             fmt::format("motors that stall at {:.3g} A: it is never passed", stall_A),
             "use less than the motors can draw");
  }
  if (!s.Is("navigation.on_board_stuck.reaction", "off")) {
    s.Within("perception.stuck_detector.strain_current_A",
             s("sensors.vehicle.motor_current.no_load_A"), stall_A,
             fmt::format("motors of {:g} A without load and {:.3g} A at rest",
                         s("sensors.vehicle.motor_current.no_load_A"), stall_A),
             "use what rolling over rocks draws");
  }
  if (s.Is("rover.fidelity", "quasi_static")) {
    s.AtMost("rover.quasi_static.settle_distance_m", s("rover.geometry.wheel_radius_m"),
             fmt::format("wheels of {:g} m: it steps over rocks",
                         2.0 * s("rover.geometry.wheel_radius_m")),
             "use a fraction of a wheel's radius");
  }
}

void DoubtSteering(Values& s) {
  const double told_deg_s = s("navigation.wheel_driver.steer_rate_deg_s");
  s.AtLeast("rover.drive.steer_rate_deg_s", 0.2 * told_deg_s,
            fmt::format("a navigation.wheel_driver that reckons with {:g} deg/s", told_deg_s),
            "state the same rate in both");
  // The wheels at the corners steer: the inner one turns most.
  const double length_m = s("rover.geometry.length_m");
  const double track_m = s("rover.geometry.width_m") - s("rover.geometry.wheel_width_m");
  const double middle_m = 0.5 * s("rover.geometry.wheelbase_m") /
                          math::Tan(math::DegToRad(s("rover.drive.max_steer_deg")));
  // The middle of the rover is taken for GESTALT: its published curvatures ask more of the inner
  // wheels than these rovers give.
  const double turn_m = s.Uses("gestalt") ? middle_m : middle_m + 0.5 * track_m;
  const std::string path = s.OfNavigator("arcs.max_curvature_per_m", "tight_arc_radius_m");
  const double arc_m = s.Uses("gestalt") ? 1.0 / s(path) : s(path);
  s.Doubt(turn_m > arc_m, "rover.drive.max_steer_deg",
          fmt::format("{:g} deg give arcs of {:.3g} m at least, and the navigator drives {:.3g} m",
                      s("rover.drive.max_steer_deg"), turn_m, arc_m),
          "let the wheels turn as far as its tightest arc");
  // To turn in place, wheels at the corners stand across the way to the middle.
  const double across_deg = math::RadToDeg(math::Atan2(s("rover.geometry.wheelbase_m"), track_m));
  s.Doubt(s.Uses("pathfinder") && s("rover.drive.max_steer_deg") < across_deg - 2.0,
          "rover.drive.max_steer_deg",
          fmt::format("{:g} deg, and to turn in place takes {:.3g}", s("rover.drive.max_steer_deg"),
                      across_deg),
          "let the wheels turn so far");
  s.Doubt(arc_m > 5.0 * length_m, path,
          fmt::format("arcs of {:.3g} m and more lead a rover {:g} m long around no rock", arc_m,
                      length_m),
          "let it drive tighter arcs");
}

}  // namespace

void DoubtRover(Values& s) {
  DoubtShape(s);
  DoubtTraction(s);
  DoubtMotors(s);
  DoubtSteering(s);
}

}  // namespace rockyard::campaign
