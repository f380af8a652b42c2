#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "campaign/doubts/setting_values.h"
#include "math/angles.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {
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
  // Over the load: resistance of sand, or of a rock that half of the wheels climb.
  const double resistance = s.HasRocks() ? 0.5 : 0.15;
  const double gravity_m_s2 = s("rover.physics.gravity_m_s2");
  const double weight_N = s("rover.mass.total_kg") * gravity_m_s2;
  const double radius_m = s("rover.geometry.wheel_radius_m");
  const double need_N =
      weight_N * (std::sin(math::DegToRad(s("terrain.ground.slope_deg"))) + resistance);
  s.AtLeast("rover.drive.stall_torque_Nm", need_N * radius_m / 6.0,
            fmt::format("the {:.3g} N that {} takes here", need_N,
                        s.HasRocks() ? "climbing rocks" : "rolling"),
            "state the torque at the wheel, behind its gears");
  // Over the weight: on these soils wheels roll harder, on concrete they take 0.01 to 0.02.
  const double rolling = s.Is("terrain.ground.soil.preset", "hard_ground") ? 0.01 : 0.05;
  const double rolling_W = rolling * weight_N * s("rover.drive.speed_m_s");
  s.AtLeast("energy.driving_W", rolling_W,
            fmt::format("{:.3g} N that roll at {:g} m/s", weight_N, s("rover.drive.speed_m_s")),
            "state what the drive motors draw, in W");
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
  if (s.Is("terrain.ground.soil.preset", "hard_ground")) return;
  s.Within("terrain.ground.soil.friction_angle_deg", 15.0, 55.0, "a dry soil", "use 25 to 45");
  // Soils as they are, between the gravities of Mars, 3.72, and Earth, 9.81.
  constexpr double kBetween_m_s2 = 6.0;
  const terrain::SoilParams& soil = s.drive.terrain.ground.soil;
  const terrain::SoilParams as_it_is = terrain::MakeSoil(soil.preset);
  const bool own = soil.cohesive_modulus_N_per_mn1 != as_it_is.cohesive_modulus_N_per_mn1 ||
                   soil.frictional_modulus_N_per_mn2 != as_it_is.frictional_modulus_N_per_mn2;
  const bool of_mars = soil.preset == terrain::SoilPreset::kMarsDrift;
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
  // Corners that steer: the inner one turns most.
  const double length_m = s("rover.geometry.length_m");
  const double track_m = s("rover.geometry.width_m") - s("rover.geometry.wheel_width_m");
  const double middle_m = 0.5 * s("rover.geometry.wheelbase_m") /
                          std::tan(math::DegToRad(s("rover.drive.max_steer_deg")));
  // Published curvatures of GESTALT ask more of the inner wheels than these rovers give.
  const double turn_m = s.Uses("gestalt") ? middle_m : middle_m + 0.5 * track_m;
  const std::string path = s.OfNavigator("arcs.max_curvature_per_m", "tight_arc_radius_m");
  const double arc_m = s.Uses("gestalt") ? 1.0 / s(path) : s(path);
  s.Doubt(turn_m > arc_m, "rover.drive.max_steer_deg",
          fmt::format("{:g} deg give arcs of {:.3g} m at least, and the navigator drives {:.3g} m",
                      s("rover.drive.max_steer_deg"), turn_m, arc_m),
          "let the wheels turn as far as its tightest arc");
  // Corners that turn in place stand across the way to the middle.
  const double across_deg = math::RadToDeg(std::atan2(s("rover.geometry.wheelbase_m"), track_m));
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
