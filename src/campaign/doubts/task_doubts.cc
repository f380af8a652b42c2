#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/doubts/setting_doubts.h"
#include "experiments/mission/mission_params.h"
#include "experiments/mission/sol.h"
#include "math/angles.h"
#include "math/functions.h"
#include "messages/estimates.h"
#include "trial/clock/compute_profile.h"

namespace rockyard::campaign {
namespace {

// Returns the length of the shortest leg from a point of the course to the next.
double Leg_m(const Values& s) {
  double leg_m = s.course_m();
  messages::Goal from{s("course.start_x_m"), s("course.start_y_m")};
  for (const messages::Goal& to : s.drive.course.Goals()) {
    leg_m = std::min(leg_m, math::Hypot(to.x_m - from.x_m, to.y_m - from.y_m));
    from = to;
  }
  return leg_m;
}

void DoubtGoal(Values& s) {
  constexpr double kShare = 1.0 / 3.0;  // beyond it a goal is reached without its course
  s.AtMost("course.goal_radius_m", kShare * s.course_m(), s.OfCourse(),
           "state how near the rover has to come");
  const double radius_m = s("course.goal_radius_m");
  const std::string tolerance = s.OfNavigator("waypoints.goal_tolerance_m", "goal_tolerance_m");
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
  if (s.On("course.goal_rock.enabled") && s.DrivesByArray()) {
    s.AtLeast("course.goal_rock.height_m", s("perception.hazard.neighbour_threshold_m"),
              "a rover that finds it as a hazard", "use a rock that perception.hazard sees");
  }
}

// Doubts the terrain: what lies on the way is what is to be found out.
void DoubtField(Values& s) {
  const double width_m = s("rover.geometry.width_m");
  const double clearance_m = s("rover.geometry.belly_clearance_m");
  if (s.HasRocks() && !s.Is("terrain.rocks.kind", "listed")) {
    s.AtMost("terrain.rocks.clear_radius_m", 0.3 * s.course_m(), s.OfCourse(),
             "clear what the rover stands on");
    s.AtLeast("terrain.rocks.clear_radius_m", 0.9 * s.front_m(),
              fmt::format("a rover whose front is {:.3g} m ahead", s.front_m()),
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
    s.AtMost("terrain.rocks.k_per_m2", 0.06, "a field of rocks: Viking Lander 2 has 0.013",
             "state the number of rocks of a metre and more per m2");
  }
  if (s.drive.terrain.rocks.FollowsLaw()) {
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
  if (!s.Uses("route") && !along) return;
  s.AtMost("course.oracle_route.cell_m", width_m / 3.0, fmt::format("a rover {:g} m wide", width_m),
           "use a tenth of its width");
  const double room_m = 0.5 * (0.6 * s("terrain.arena.width_m") - width_m);
  s.AtMost("course.oracle_route.margin_m", room_m,
           fmt::format("a lane between rocks of an arena {:g} m wide", s("terrain.arena.width_m")),
           "use a few centimetres");
  if (lander) {
    s.AtLeast("course.lander_map.reach_m", 0.8 * s.course_m(), s.OfCourse(),
              "let the map show the way");
  }
}

// Doubts patience that ends on the way around listed rocks which leave no way between them: as far
// as they reach the rover comes no nearer to the goal.
void DoubtPatience(Values& s) {
  const auto& listed = s.drive.terrain.rocks.listed;
  const double patience_m = s.drive.referee.no_path_distance_m;
  if (!s.Is("terrain.rocks.kind", "listed") || listed.x_m.size() < 3 || patience_m <= 0.0) return;
  const double width_m = s("rover.geometry.width_m");
  double longest_m = 0.0;  // of the walls, along them
  double wall_m = 0.0;
  for (std::size_t i = 1; i < listed.x_m.size(); ++i) {
    const double apart_m =
        math::Hypot(listed.x_m[i] - listed.x_m[i - 1], listed.y_m[i] - listed.y_m[i - 1]);
    const double gap_m = apart_m - 0.5 * (listed.diameter_m[i] + listed.diameter_m[i - 1]);
    wall_m = gap_m < width_m ? wall_m + apart_m : 0.0;
    longest_m = std::max(longest_m, wall_m);
  }
  s.Doubt(patience_m < 0.5 * longest_m, "referee.no_path_distance_m",
          fmt::format("{:g} m end a rover on its way around rocks that stand {:.3g} m long",
                      patience_m, longest_m),
          "use more than the way around them");
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
  s.AtMost("referee.no_path_progress_m", 0.25 * s.course_m(), s.OfCourse(),
           "use some tenths of a metre");
  // The tilt at which the rover stands no more: half of the width over the height of the centre of
  // mass.
  const double stands_deg = math::RadToDeg(
      math::Atan2(0.5 * s("rover.geometry.width_m"), s("rover.mass.chassis_com_z_m")));
  s.AtLeast("referee.tip_over_deg", 0.6 * stands_deg,
            fmt::format("a rover that stands up to {:.3g} deg", stands_deg),
            "use about where this rover tips");
  if (!s.Uses("route")) {
    const std::string clock = s.OfNavigator("drive.time_out_s", "time_out_s");
    const double fastest_s = s.course_m() / s("rover.drive.speed_m_s");
    if (s(clock) > 0.0) {
      s.AtLeast(clock, fastest_s,
                fmt::format("{}, {:.3g} s at full speed", s.OfCourse(), fastest_s),
                "let it have time for the way, or 0 for no limit");
    }
  }
  DoubtPatience(s);
  const double turn_deg = s("referee.no_path_turn_deg");
  if (turn_deg > 0.0 && s.Uses("pathfinder")) {
    s.AtLeast("referee.no_path_turn_deg", 0.5 * s("navigation.pathfinder.turn_give_up_deg"),
              "a rover that looks around before it gives up", "use some full turns, or 0");
  }
  // Ground that is a hazard everywhere stops the rover everywhere.
  const double slope_deg = s("terrain.ground.slope_deg");
  const std::pair<std::string_view, bool> limits[] = {
      {"perception.vehicle_hazard.max_tilt_deg", s.On("sensors.vehicle.accelerometers.enabled")},
      {"navigation.gestalt.map.rover.max_pitch_deg",
       s.Uses("gestalt") && s.On("navigation.gestalt.map.tests.pitch")},
      {"referee.tip_over_deg", true}};
  for (const auto& [path, used] : limits) {
    if (!used) continue;
    s.AtLeast(path, slope_deg + 2.0, fmt::format("ground that slopes by {:g} deg", slope_deg),
              "use what is steep for this rover");
  }
}

// Doubts times: the rover looks and drives from start to goal, one after the other.
void DoubtTime(Values& s) {
  if (!s.Looks()) return;
  const double speed_m_s = s("rover.drive.speed_m_s");
  const double look_s = trial::MakeLookTime(s.drive).total_s();
  const bool continuous =
      s.Uses("gestalt") && !s.Is("navigation.gestalt.continuous.cycle", "stop_and_look");
  const double step_m = continuous ? s("navigation.gestalt.continuous.motion_m")
                                   : s(s.OfNavigator("drive.step_m", "scan_interval_m"));
  const double limit_s = s.drive.referee.time_limit_s;
  const double needed_s = s.course_m() / step_m * (look_s + step_m / speed_m_s);
  // Shorter limits are doubted as limits, or meant as durations; the bound must agree with that of
  // referee.time_limit_s in scenario_doubts.cc.
  const bool is_for_course = limit_s >= 800.0 * s.course_m();
  s.Doubt(is_for_course && limit_s < 0.75 * needed_s, "clock",
          fmt::format("a look takes {:.3g} s, the way with its looks {:.3g} s, and the drive ends "
                      "after {:g} s",
                      look_s, needed_s, limit_s),
          "check the units, or use a longer time");
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

}  // namespace

void DoubtTask(Values& s) {
  DoubtGoal(s);
  DoubtField(s);
  DoubtReferee(s);
  DoubtTime(s);
}

namespace {

// Returns the largest distance from the lander to a goal.
double Farthest_m(const experiments::MissionParams& mission) {
  double farthest_m = 0.0;
  for (const messages::Goal& goal : mission.goals.Places()) {
    farthest_m = std::max(
        farthest_m, math::Hypot(goal.x_m - mission.lander_x_m, goal.y_m - mission.lander_y_m));
  }
  return farthest_m;
}

}  // namespace

void DoubtMission(Values& s) {
  const experiments::MissionParams& mission =
      s.whole.experiment.params<experiments::MissionParams>();
  const double far_m = Farthest_m(mission);
  const std::string goals = fmt::format("goals up to {:.3g} m from the lander", far_m);
  s.AtLeast("mission.radio_range_m", far_m, goals, "let the rover hear its commands there");
  if (mission.lander_update != experiments::LanderUpdate::kNone) {
    s.AtLeast("sensors.aids.lander_fix.range_m", 0.5 * far_m, goals,
              "let the lander find the rover there, or set mission.lander_update=none");
  }
  const double needed_bits = experiments::NeededBits(mission.day);
  constexpr double kMostSols = 3.0;  // published rates take one
  const double sols = needed_bits / experiments::SolBits(mission.day);
  s.Doubt(sols > kMostSols, "mission.day.downlink_bit_s",
          fmt::format("{:.3g} Mbit that a command needs take {:.3g} sols to reach the Earth",
                      1e-6 * needed_bits, sols),
          "use a faster link, more hours, or fewer images");
}

}  // namespace rockyard::campaign
