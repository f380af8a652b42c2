#include "campaign/setting_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/field_table.h"
#include "math/angles.h"
#include "math/sun_position.h"
#include "messages/estimates.h"
#include "scenario/load.h"
#include "trial/hazard_watch.h"
#include "trial/look_time.h"
#include "trial/open_values_params.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using math::DegToRad;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Values by their paths, and the doubts of them.
class Values {
 public:
  explicit Values(const scenario::Scenario& scenario)
      : drive(scenario.drive), parameters(scenario::ListParameters(scenario)) {
    for (const core::ParameterInfo& each : parameters) values_[each.path] = &each.value;
  }

  // In the unit that ends its path's name.
  double operator()(std::string_view path) const { return At(path).number(); }
  std::vector<std::int64_t> Integers(std::string_view path) const {
    std::vector<std::int64_t> numbers;
    for (const JsonValue& each : At(path).list()) numbers.push_back(each.integer());
    return numbers;
  }
  bool On(std::string_view path) const { return At(path).boolean(); }
  bool Is(std::string_view path, std::string_view name) const { return At(path).text() == name; }
  // Whether the parameter is there and false.
  bool IsOff(const std::string& path) const {
    const auto found = values_.find(path);
    return found != values_.end() && !found->second->boolean();
  }

  void Doubt(bool doubtful, std::string_view path, std::string reason, std::string_view right) {
    if (doubtful) doubts.push_back({std::string(path), std::move(reason), std::string(right)});
  }

  // "0.4 is little for a course of 7.6 m": where the value is below `low` or above `high`.
  void Within(std::string_view path, double low, double high, std::string_view what,
              std::string_view right) {
    const double value = (*this)(path);
    Doubt(value < low || value > high, path,
          fmt::format("{:g} is {} for {}", value, value < low ? "little" : "much", what), right);
  }
  void AtLeast(std::string_view path, double low, std::string_view what, std::string_view right) {
    Within(path, low, kUnbounded, what, right);
  }
  void AtMost(std::string_view path, double high, std::string_view what, std::string_view right) {
    Within(path, -kUnbounded, high, what, right);
  }

  const trial::DriveParams& drive;
  const std::vector<core::ParameterInfo> parameters;
  std::vector<core::Problem> doubts;

 private:
  const JsonValue& At(std::string_view path) const {
    const auto found = values_.find(path);
    EXPECT(found != values_.end());
    return *found->second;
  }

  std::map<std::string, const JsonValue*, std::less<>> values_;
};

double Course_m(const Values& s) { return trial::CourseLength_m(s.drive.course); }

std::string OfCourse(const Values& s) { return fmt::format("a course of {:.3g} m", Course_m(s)); }

double Front_m(const Values& s) { return 0.5 * s("rover.geometry.length_m"); }

bool Uses(const Values& s, std::string_view navigator) {
  return s.Is("navigation.navigator", navigator);
}

bool SeesBy(const Values& s, std::string_view sensor) {
  return s.Is("sensors.terrain_sensor", sensor);
}

bool HasRocks(const Values& s) { return !s.Is("terrain.rocks.kind", "none"); }

// The pathfinder has hazards of an array of elevations; what it does not see now it does not know.
bool DrivesByArray(const Values& s) {
  return Uses(s, "pathfinder") && s.On("perception.hazard.enabled");
}

std::string OfNavigator(const Values& s, std::string_view gestalts, std::string_view key) {
  if (Uses(s, "gestalt")) return fmt::format("navigation.gestalt.{}", gestalts);
  return fmt::format("navigation.{}.{}", Uses(s, "route") ? "route" : "pathfinder", key);
}

trial::Zone ReportedZone(const Values& s) {
  return s.drive.sensors.terrain_sensors.chosen().reported_zone(s.drive);
}

// ---- The task

// The shortest way from a point of the course to the next.
double Leg_m(const Values& s) {
  double leg_m = Course_m(s);
  messages::Goal from{s("course.start_x_m"), s("course.start_y_m")};
  for (const messages::Goal& to : s.drive.course.Goals()) {
    leg_m = std::min(leg_m, std::hypot(to.x_m - from.x_m, to.y_m - from.y_m));
    from = to;
  }
  return leg_m;
}

void DoubtGoal(Values& s) {
  constexpr double kShare = 1.0 / 3.0;  // beyond it a goal is reached without its course
  s.AtMost("course.goal_radius_m", kShare * Course_m(s), OfCourse(s),
           "state how near the rover has to come");
  const double radius_m = s("course.goal_radius_m");
  const std::string tolerance = OfNavigator(s, "waypoints.goal_tolerance_m", "goal_tolerance_m");
  s.AtMost(tolerance, radius_m, fmt::format("a goal that is reached within {:g} m", radius_m),
           "use less than course.goal_radius_m");
  s.AtMost(tolerance, std::max(kShare * Leg_m(s), 0.05),
           fmt::format("points {:.3g} m apart", Leg_m(s)), "use a fraction of their distance");
  s.Doubt(s("course.target_speed_m_s") >= s("rover.drive.speed_m_s"), "course.target_speed_m_s",
          fmt::format("the goal goes away at {:g} m/s, and the rover drives {:g} m/s",
                      s("course.target_speed_m_s"), s("rover.drive.speed_m_s")),
          "let the rover be the faster one");
  if (s.On("course.tracking.enabled")) {
    s.AtLeast("course.tracking.range_m", radius_m,
              fmt::format("a goal that is reached within {:g} m", radius_m),
              "use a range at which the feature is seen on the way");
  }
  if (s.On("course.goal_rock.enabled") && DrivesByArray(s)) {
    s.AtLeast("course.goal_rock.height_m", s("perception.hazard.neighbour_threshold_m"),
              "a rover that finds it as a hazard", "use a rock that perception.hazard sees");
  }
}

// What lies on the way is what is to be found out.
void DoubtField(Values& s) {
  const double width_m = s("rover.geometry.width_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  if (HasRocks(s)) {
    s.Within("terrain.rocks.clear_radius_m", 0.9 * Front_m(s), 0.3 * Course_m(s), OfCourse(s),
             "clear what the rover stands on");
  }
  if (s.Is("terrain.rocks.kind", "uniform_count")) {
    s.AtLeast("terrain.rocks.uniform_max_diameter_m", 0.75 * clearance_m,
              fmt::format("a belly {:g} m above the ground: none is a hazard", clearance_m),
              "let the field have rocks that stop this rover");
    const double mean_m = 0.5 * (s("terrain.rocks.uniform_min_diameter_m") +
                                 s("terrain.rocks.uniform_max_diameter_m"));
    const double area_m2 =
        s("terrain.rocks.count_area_length_m") * s("terrain.rocks.count_area_width_m");
    s.AtMost("terrain.rocks.count", 0.3 * area_m2 / (0.785 * mean_m * mean_m),
             fmt::format("an area of {:.3g} m2", area_m2), "leave a way between them");
  }
  if (s.Is("terrain.rocks.kind", "moore")) {
    s.AtMost("terrain.rocks.k_per_m2", 0.1, "a field of rocks: Viking Lander 2 has 0.013",
             "state the number of rocks of a metre and more per m2");
    s.AtMost("terrain.rocks.min_diameter_m", 3.0 * clearance_m,
             fmt::format("a belly {:g} m above the ground: it meets smaller ones", clearance_m),
             "begin with rocks that the belly clears");
    s.AtLeast("terrain.rocks.max_diameter_m", clearance_m,
              fmt::format("a belly {:g} m above the ground: none is a hazard", clearance_m),
              "let the field have rocks that stop this rover");
  }
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const terrain::GroundParams& ground = s.drive.terrain.ground;
  const std::pair<std::string_view, const std::vector<double>*> hollows[] = {
      {"terrain.ground.ditches.depth_m", &ground.ditches.depth_m},
      {"terrain.ground.pits.depth_m", &ground.pits.depth_m}};
  for (const auto& [path, depths_m] : hollows) {
    const auto deepest = std::ranges::max_element(*depths_m);
    s.Doubt(deepest != depths_m->end() && *deepest < 0.75 * radius_m, path,
            fmt::format("wheels of {:g} m roll through {:g} m", 2.0 * radius_m,
                        deepest == depths_m->end() ? 0.0 : *deepest),
            "let them be hazards of this rover");
  }
  s.AtMost("terrain.ground.roughness_rms_m", clearance_m,
           fmt::format("a belly {:g} m above the ground", clearance_m), "check the unit");
  if (!s.Is("terrain.arena.kind", "open")) {
    s.AtLeast("terrain.arena.width_m", 2.5 * width_m,
              fmt::format("a rover {:g} m wide among rocks", width_m),
              "use several widths of the rover");
  }
  s.Doubt(s("course.trials_per_layout") > 0.2 * s("trials") && s("course.trials_per_layout") > 1.0,
          "course.trials_per_layout",
          fmt::format("{:g} of {:g} trials meet one field: the rate is that of a few fields",
                      s("course.trials_per_layout"), s("trials")),
          "use a small part of the trials");
  const bool lander = s.Is("course.route_map.source", "lander");
  const bool along = s.Is("course.route_map.use", "waypoints");
  if (!Uses(s, "route") && !along) return;
  s.AtMost("course.oracle_route.cell_m", width_m / 3.0, fmt::format("a rover {:g} m wide", width_m),
           "use a tenth of its width");
  const double room_m = 0.5 * (0.6 * s("terrain.arena.width_m") - width_m);
  s.AtMost("course.oracle_route.margin_m", room_m,
           fmt::format("a lane between rocks of an arena {:g} m wide", s("terrain.arena.width_m")),
           "use a few centimetres");
  if (lander) {
    s.AtLeast("course.lander_map.reach_m", 0.8 * Course_m(s), OfCourse(s),
              "let the map show the way");
  }
}

void DoubtReferee(Values& s) {
  const double speed_m_s = s("rover.drive.speed_m_s");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  s.AtLeast("referee.stall_window_s", s("referee.stall_distance_m") / speed_m_s,
            fmt::format("{:g} m (stall_distance_m) at {:g} m/s", s("referee.stall_distance_m"),
                        speed_m_s),
            "use a longer time");
  s.Within("referee.hazard_height_m", 0.25 * clearance_m, 2.0 * clearance_m,
           fmt::format("a belly {:g} m above the ground", clearance_m),
           "use the height that stops this rover");
  s.AtMost("referee.no_path_progress_m", 0.25 * Course_m(s), OfCourse(s),
           "use some tenths of a metre");
  // What stands on level ground: half of the width over the height of the centre of mass.
  const double stands_deg = math::RadToDeg(
      std::atan2(0.5 * s("rover.geometry.width_m"), s("rover.mass.chassis_com_z_m")));
  s.AtLeast("referee.tip_over_deg", 0.6 * stands_deg,
            fmt::format("a rover that stands up to {:.3g} deg", stands_deg), "use 60");
  // What stands in the way is gone around: no nearer to the goal for as far as it reaches.
  const auto& listed = s.drive.terrain.rocks.listed;
  const double patience_m = s.drive.referee.no_path_distance_m;
  if (s.Is("terrain.rocks.kind", "listed") && listed.x_m.size() > 2 && patience_m > 0.0) {
    const auto [near, far] = std::ranges::minmax(listed.x_m);
    const auto [right, left] = std::ranges::minmax(listed.y_m);
    const double around_m = far - near + 0.5 * (left - right);
    s.Doubt(patience_m < 0.5 * around_m, "referee.no_path_distance_m",
            fmt::format("{:g} m end a rover on its way around rocks that take {:.3g} m", patience_m,
                        around_m),
            "use more than the way around them, or null");
  }
  const double turn_deg = s("referee.no_path_turn_deg");
  if (turn_deg > 0.0 && Uses(s, "pathfinder")) {
    s.AtLeast("referee.no_path_turn_deg", 0.5 * s("navigation.pathfinder.turn_give_up_deg"),
              "a rover that looks around before it gives up", "use some full turns, or 0");
  }
  // Ground that is a hazard everywhere stops the rover everywhere.
  const double slope_deg = s("terrain.ground.slope_deg");
  const std::pair<std::string_view, bool> limits[] = {
      {"perception.vehicle_hazard.max_tilt_deg", s.On("sensors.vehicle.accelerometers.enabled")},
      {"navigation.gestalt.map.rover.max_pitch_deg",
       Uses(s, "gestalt") && s.On("navigation.gestalt.map.tests.pitch")},
      {"referee.tip_over_deg", true}};
  for (const auto& [path, used] : limits) {
    if (!used) continue;
    s.AtLeast(path, slope_deg + 2.0, fmt::format("ground that slopes by {:g} deg", slope_deg),
              "use what is steep for this rover");
  }
}

// ---- The rover, with three wheels a side

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
           fmt::format("wheels of {:g} m", 2.0 * radius_m),
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
  // Over the load: resistance of sand, or of a rock that half of the wheels climb.
  const double resistance = HasRocks(s) ? 0.5 : 0.15;
  const double gravity_m_s2 = s("rover.physics.gravity_m_s2");
  const double weight_N = s("rover.mass.total_kg") * gravity_m_s2;
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double need_N = weight_N * (std::sin(DegToRad(s("terrain.ground.slope_deg"))) + resistance);
  s.AtLeast("rover.drive.stall_torque_Nm", need_N * radius_m / 6.0,
            fmt::format("the {:.3g} N that keep it moving here", need_N),
            "state the torque at the wheel, behind its gears");
  s.AtLeast("rover.contact.stiffness_N_m", weight_N / 6.0 / (0.2 * radius_m),
            fmt::format("a load of {:.3g} N a wheel", weight_N / 6.0),
            "use a stiffness for this mass");
  // Bekker's pressure under a sixth of the weight, on a patch as long as the radius.
  const double wide_m = s("rover.geometry.wheel_width_m");
  const double modulus = s("terrain.ground.soil.cohesive_modulus_N_per_mn1") / wide_m +
                         s("terrain.ground.soil.frictional_modulus_N_per_mn2");
  const double pressure_Pa = weight_N / 6.0 / (wide_m * radius_m);
  const double sinkage_m = modulus > 0.0 ? std::pow(pressure_Pa / modulus,
                                                    1.0 / s("terrain.ground.soil.sinkage_exponent"))
                                         : 0.0;
  s.Doubt(sinkage_m > 0.5 * radius_m, "terrain.ground.soil",
          fmt::format("wheels of {:g} m sink {:.2g} m into it", 2.0 * radius_m, sinkage_m),
          "check the units of its moduli: N, not kN");
  s.Within("terrain.ground.soil.friction_angle_deg", 15.0, 55.0, "a dry soil", "use 25 to 45");
  // Between Mars, 3.72, and Earth, 9.81.
  const bool drift = s.Is("terrain.ground.soil.preset", "mars_drift");
  const bool arena = s.Is("terrain.ground.soil.preset", "landscaping_sand");
  s.Within("rover.physics.gravity_m_s2", arena ? 6.0 : 0.0, drift ? 6.0 : kUnbounded,
           drift ? "the soil of Mars" : "the sand of an arena on Earth",
           "choose soil and gravity of one place");
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
  // Corners that steer, as seen from the middle of the rover.
  const double length_m = s("rover.geometry.length_m");
  const double turn_m =
      0.5 * s("rover.geometry.wheelbase_m") / std::tan(DegToRad(s("rover.drive.max_steer_deg")));
  const std::string path = OfNavigator(s, "arcs.max_curvature_per_m", "tight_arc_radius_m");
  const double arc_m = Uses(s, "gestalt") ? 1.0 / s(path) : s(path);
  s.Doubt(turn_m > arc_m, "rover.drive.max_steer_deg",
          fmt::format("{:g} deg give arcs of {:.3g} m at least, and the navigator drives {:.3g} m",
                      s("rover.drive.max_steer_deg"), turn_m, arc_m),
          "let the wheels turn as far as its tightest arc");
  // Corners that turn in place stand across the way to the middle.
  const double across_deg =
      math::RadToDeg(std::atan2(s("rover.geometry.wheelbase_m"),
                                s("rover.geometry.width_m") - s("rover.geometry.wheel_width_m")));
  s.Doubt(Uses(s, "pathfinder") && s("rover.drive.max_steer_deg") < across_deg - 2.0,
          "rover.drive.max_steer_deg",
          fmt::format("{:g} deg, and to turn in place takes {:.3g}", s("rover.drive.max_steer_deg"),
                      across_deg),
          "let the wheels turn so far");
  s.Doubt(arc_m > 5.0 * length_m, path,
          fmt::format("arcs of {:.3g} m and more lead a rover {:g} m long around no rock", arc_m,
                      length_m),
          "let it drive tighter arcs");
}

// ---- What it sees

// Between two looks, or two commands, the rover is blind.
void DoubtPace(Values& s) {
  const double speed_m_s = s("rover.drive.speed_m_s");
  const double tick_m = speed_m_s / s("clock.control_rate_hz");
  s.Doubt(tick_m > s("rover.geometry.wheel_radius_m"), "rover.drive.speed_m_s",
          fmt::format("it comes {:.2g} m far between two commands (clock.control_rate_hz {:g})",
                      tick_m, s("clock.control_rate_hz")),
          "drive slower, or command more often");
  const double seen_m =
      Uses(s, "gestalt") ? s("sensors.stereo.max_range_m") : ReportedZone(s).x_high_m;
  const double ahead_m = seen_m - Front_m(s);
  const double stop_m = speed_m_s * (0.5 * s("rover.drive.ramp_s") + s("clock.stop_time_s"));
  s.Doubt(stop_m > ahead_m, "rover.drive.ramp_s",
          fmt::format("it takes {:.2g} m to stop, and sees {:.2g} m ahead of its front", stop_m,
                      ahead_m),
          "drive slower, or see farther");
}

// Looks and drives from start to goal, one after the other.
void DoubtTime(Values& s) {
  if (Uses(s, "route") || (Uses(s, "pathfinder") && !s.On("perception.hazard.enabled"))) return;
  const double speed_m_s = s("rover.drive.speed_m_s");
  const double look_s = trial::MakeLookTime(s.drive).total_s();
  const bool continuous =
      Uses(s, "gestalt") && !s.Is("navigation.gestalt.continuous.cycle", "stop_and_look");
  const double step_m = continuous ? s("navigation.gestalt.continuous.motion_m")
                                   : s(OfNavigator(s, "drive.step_m", "scan_interval_m"));
  const double limit_s = s.drive.referee.time_limit_s;
  const double needed_s = Course_m(s) / step_m * (look_s + step_m / speed_m_s);
  // Shorter ones are doubted as limits (scenario_doubts.cc), or meant as durations.
  const bool is_for_course = limit_s >= 800.0 * Course_m(s);
  s.Doubt(limit_s > 0.0 && (limit_s < look_s || (is_for_course && limit_s < 0.75 * needed_s)),
          limit_s < look_s ? "referee.time_limit_s" : "clock",
          fmt::format("a look takes {:.3g} s, the way with its looks {:.3g} s, and the drive ends "
                      "after {:g} s",
                      look_s, needed_s, limit_s),
          "check the units, or state referee.time_limit_s");
  for (const std::string_view aid : {"lander_fix", "sun", "beacon"}) {
    const std::string group = fmt::format("sensors.aids.{}", aid);
    if (!s.On(group + ".enabled") || s(group + ".every_m") > 0.0) continue;
    s.AtMost(group + ".every_s", needed_s, fmt::format("a drive of {:.3g} s", needed_s),
             "let it come on the way");
  }
  if (continuous) {
    const double rest_s =
        (1.0 - s("navigation.gestalt.continuous.replan_fraction")) * step_m / speed_m_s;
    s.AtMost("clock.compute.acquisition_s", rest_s > 0.0 ? rest_s : kUnbounded,
             fmt::format("the {:.3g} s until the next plan is due", rest_s),
             "use a camera that keeps up, or stop and look");
  }
  s.Doubt(continuous && look_s > 1.2 * step_m / speed_m_s, "clock.compute.computer",
          fmt::format("a look takes {:.3g} s, and a motion of {:g} m {:.3g} s: it stands and waits",
                      look_s, step_m, step_m / speed_m_s),
          "use a computer that keeps up, or stop and look");
}

// The array of elevations of the pathfinder, fitted to a rover.
void DoubtArray(Values& s) {
  if (!DrivesByArray(s)) return;
  const trial::Zone seen = ReportedZone(s);
  const double width_m = s("rover.geometry.width_m");
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  const double wheels_m = 0.5 * s("rover.geometry.wheelbase_m") + radius_m;
  const bool stereo = SeesBy(s, "stereo");
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
  s.Doubt(stereo && begins_m < 0.95 * Front_m(s), array,
          fmt::format("it begins {:g} m ahead of the rover's middle, and the front is at {:g} m",
                      begins_m, Front_m(s)),
          "begin right before the wheels");
  s.Doubt(begins_m > Front_m(s) + 0.75 * s("rover.geometry.length_m"), array,
          fmt::format("what it looks at begins {:.2g} m ahead of its front, and it remembers "
                      "nothing",
                      begins_m - Front_m(s)),
          "begin right before the wheels");
  const double ahead_m = seen.x_high_m - Front_m(s);
  s.AtMost("navigation.pathfinder.scan_interval_m", ahead_m,
           fmt::format("a rover that sees {:.2g} m ahead of its front", ahead_m),
           "look at all of the way");
  s.Within("perception.hazard.neighbour_threshold_m", 0.2 * radius_m, 3.0 * radius_m,
           fmt::format("wheels of {:g} m", 2.0 * radius_m), "use what these wheels do not climb");
  s.Within("perception.hazard.range_threshold_m", 0.25 * clearance_m, 1.25 * clearance_m,
           fmt::format("a belly {:g} m above the ground", clearance_m), "state the clearance");
}

void DoubtLightStripe(Values& s) {
  if (!SeesBy(s, "light_stripe")) return;
  const double front_m = s("sensors.light_stripe.front_x_m");
  s.Doubt(std::abs(front_m - Front_m(s)) > 0.15 * s("rover.geometry.length_m"),
          "sensors.light_stripe.front_x_m",
          fmt::format("the front of this rover is at {:g} m, not at {:g} m", Front_m(s), front_m),
          "use half of its length");
  const double slant_m = std::hypot(ReportedZone(s).x_high_m - s("sensors.light_stripe.camera_x_m"),
                                    s("sensors.light_stripe.camera_height_m"));
  s.AtLeast("sensors.light_stripe.max_range_m", slant_m,
            fmt::format("a farthest row {:.2g} m from the camera", slant_m),
            "let the farthest row be bright");
}

void DoubtStereo(Values& s) {
  if (!SeesBy(s, "stereo")) return;
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
            fmt::format("cameras {:g} deg tall: half of what they see is sky", tall_deg),
            "turn them down, and check that it is in degrees");
  const double upper_deg = pitch_deg - 0.5 * tall_deg;
  const double end_m =
      upper_deg > 0.0 ? ahead_m + high_m / std::tan(DegToRad(upper_deg)) : kUnbounded;
  s.Doubt(
      end_m < Front_m(s) + 0.25 * length_m, "sensors.stereo.front.pitch_deg",
      fmt::format("the ground is seen up to {:.2g} m ahead of the rover's middle, and its front "
                  "is at {:.2g} m",
                  end_m, Front_m(s)),
      "turn the cameras up");
  s.Within("sensors.stereo.baseline_m", 0.02 * width_m, width_m,
           fmt::format("a rover {:g} m wide", width_m), "check the unit");
  // The ground half a length ahead of the front.
  const double half_fov_rad = 0.5 * DegToRad(s("sensors.stereo.horizontal_fov_deg"));
  const double there_m = std::hypot(Front_m(s) + 0.5 * length_m - ahead_m, high_m);
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
      Uses(s, "gestalt") ? std::min(range_m, path_m) : s("perception.cloud_elevations.far_m");
  s.AtMost("sensors.stereo.min_disparity_px", product_px_m / (0.6 * used_m),
           fmt::format("depths up to {:.2g} m", used_m), "use less, or a longer baseline");
  if (s.Is("sensors.stereo.fidelity", "image")) {
    s.AtMost("perception.stereo.filters.blob_min_px",
             0.1 * s("sensors.stereo.columns") * s("sensors.stereo.rows"),
             "images of that size: whole rocks are regions", "use a hundredth of the image");
    s.Doubt(s("sensors.look.soil_graininess") == 0.0 && s("sensors.look.drift.contrast") == 0.0,
            "sensors.look", "soil without grain and contrast has nothing that matches",
            "leave it some texture");
  }
  if (Uses(s, "gestalt")) {
    s.AtLeast("sensors.stereo.max_range_m", 0.5 * path_m,
              fmt::format("paths that are judged for {:g} m", path_m),
              "judge the ground that is seen");
  }
}

// ---- GESTALT (Goldberg 2002, table 1), which is told what vehicle it drives

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
              "use twice plan_max_dist_m and more");
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

// ---- What it believes

void DoubtLocalization(Values& s) {
  const std::string course = OfCourse(s);
  s.Within("sensors.gyro.scale", 0.75, 1.25, "a gyro that measures turns", "use a share near 1");
  const double bias_deg_s = s("sensors.gyro.bias_sd_deg_per_s");
  const double driven_s = Course_m(s) / s("rover.drive.speed_m_s");
  s.Doubt(bias_deg_s * driven_s > 45.0, "sensors.gyro.bias_sd_deg_per_s",
          fmt::format("it turns the heading by {:.3g} deg over the course", bias_deg_s * driven_s),
          "check the unit: gyros of this kind keep 0.01 deg/s");
  s.AtMost("sensors.gyro.heading_variance_deg2_per_m", 45.0 * 45.0 / Course_m(s), course,
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
    const double every_s = std::max(s("sensors.visual_odometry.schedule.every_s"),
                                    s("sensors.visual_odometry.schedule.every_m") / speed_m_s);
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
  const std::string course = OfCourse(s);
  for (const std::string_view aid : {"lander_fix", "sun", "beacon"}) {
    const std::string group = fmt::format("sensors.aids.{}", aid);
    if (!s.On(group + ".enabled")) continue;
    if (s(group + ".every_s") == 0.0) {
      s.AtMost(group + ".every_m", Course_m(s), course, "let it come on the way");
    }
    if (aid == "sun") continue;
    s.AtLeast(group + ".range_m", 0.5 * Course_m(s), course, "let it reach along the way");
  }
  if (s.On("sensors.aids.beacon.enabled")) {
    s.AtMost("sensors.aids.beacon.range_sd_m", 0.5 * Course_m(s), course, "check the unit");
  }
  if (!s.On("sensors.aids.sun.enabled")) return;
  const math::SkyDirection sun = math::SunPosition(
      DegToRad(s("sensors.aids.sun.latitude_deg")),
      math::SunDeclination(DegToRad(s("sensors.aids.sun.areocentric_longitude_deg"))),
      s("sensors.aids.sun.start_solar_time_h"));
  s.Doubt(sun.elevation_rad < 0.0, "sensors.aids.sun.start_solar_time_h",
          fmt::format("at {:g} h and a latitude of {:g} deg the sun has set",
                      s("sensors.aids.sun.start_solar_time_h"), s("sensors.aids.sun.latitude_deg")),
          "drive by day");
}

// ---- Assumed values far outside of the range in which studies vary them: most often a unit

// Whether something that is chosen or enabled reads the parameter. Not those of the rover itself,
// nor the current that its motors take: their ranges are of one rover's size.
bool IsUsed(const Values& s, const std::string& path) {
  if (path == "perception.vehicle_hazard.max_current_A") return false;
  const std::string_view parts[] = {"terrain.", "sensors.", "perception.", "navigation.",
                                    "course.",  "referee.", "clock.",      "localization."};
  const auto in = [&](std::string_view group) { return path.starts_with(group); };
  if (std::none_of(std::begin(parts), std::end(parts), in)) return false;
  for (const std::string_view navigator : {"pathfinder", "gestalt", "route"}) {
    if (in(fmt::format("navigation.{}.", navigator)) && !Uses(s, navigator)) return false;
  }
  for (const std::string_view sensor : {"light_stripe", "stereo"}) {
    if (in(fmt::format("sensors.{}.", sensor)) && !SeesBy(s, sensor)) return false;
  }
  if (in("terrain.ground.soil.") && s.Is("terrain.ground.soil.preset", "hard_ground")) return false;
  if (in("localization.error_state.") && !s.Is("localization.estimator", "error_state"))
    return false;
  if (in("perception.visual_odometry.") && !s.On("sensors.visual_odometry.enabled")) return false;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
    if (s.IsOff(path.substr(0, dot) + ".enabled")) return false;
  }
  return true;
}

// What no study varies: what is usual of it, generously.
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
    {"rover.physics.gravity_m_s2", 1.0, 12.0,
     "a place with ground: Moon 1.62, Mars 3.72, Earth 9.81"},
    {"rover.contact.wheel_rock_friction", 0.3, 1.5, "wheels on rock"},
    {"rover.contact.body_rock_friction", 0.1, 1.2, "a body on rock"},
    {"rover.geometry.rocker_limit_deg", 8.0, 80.0, "rockers that follow the ground"},
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
    {"navigation.pathfinder.scan_interval_m", 0.02, kUnbounded, "looks of many seconds"},
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

void DoubtUnusual(Values& s) {
  for (const Usual& usual : kUsual) {
    const std::string path(usual.path);
    if (IsUsed(s, path) || path.starts_with("rover.")) {
      s.Within(path, usual.low, usual.high, usual.what, "check the unit, and what it means");
    }
  }
}

void DoubtUnits(Values& s) {
  constexpr double kFar = 5.0;  // times the range's end; units differ by 57 and more
  for (const core::ParameterInfo& each : s.parameters) {
    if (!each.HasStudyRange() || each.study_low < 0.0 || !IsUsed(s, each.path)) continue;
    if (each.kind != core::FieldKind::kReal && each.kind != core::FieldKind::kAngle) continue;
    const double value = each.value.number();
    const double low = each.study_low / kFar;
    if (value == 0.0 || (value >= low && value <= kFar * each.study_high)) continue;  // 0: off
    const bool told =
        std::any_of(s.doubts.begin(), s.doubts.end(),
                    [&](const core::Problem& doubt) { return doubt.path == each.path; });
    s.Doubt(!told, each.path,
            fmt::format("{:g} is far from {:g} to {:g}, where studies have it", value,
                        each.study_low, each.study_high),
            fmt::format("check the unit: {}", each.unit == "1" ? "none" : each.unit));
  }
}

}  // namespace

std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario) {
  Values s(scenario);
  for (const auto rule : {DoubtGoal, DoubtField, DoubtReferee, DoubtShape, DoubtTraction,
                          DoubtMotors, DoubtSteering, DoubtPace, DoubtTime, DoubtArray,
                          DoubtLightStripe, DoubtStereo, DoubtLocalization, DoubtAids}) {
    rule(s);
  }
  if (Uses(s, "gestalt")) {
    DoubtVehicle(s);
    DoubtMap(s);
  }
  DoubtUnusual(s);
  DoubtUnits(s);
  return s.doubts;
}

}  // namespace rockyard::campaign
