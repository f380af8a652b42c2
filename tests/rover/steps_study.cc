// The largest steps and rocks that Rocky 3.2 climbs, on hard ground and on the sand of the trials,
// as CSV; scripts/studies/steps/steps.py makes tables of it.
//
//   steps_study steps | changes | rocks | statics | pull
//   steps_study frictions ROVER.json
#include <cstdio>
#include <functional>
#include <string_view>

#include "core/archive.h"
#include "core/json_file.h"
#include "rover/climb.h"
#include "rover/step_statics.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {
namespace {

using terrain::SoilPreset;
using terrain::WheelLaw;

constexpr double kObstacle_x_m = 0.6;
constexpr double kFirst_m = 0.015;
constexpr double kStride_m = 0.005;
constexpr double kMost_m = 0.5;
constexpr double kPatience_m = 1.0;  // of its rims, for a rover that is stuck
constexpr std::array kFidelities{Fidelity::kMultibody, Fidelity::kQuasiStatic};
constexpr std::array kLaws{WheelLaw::kBekker, WheelLaw::kWongReece, WheelLaw::kResistiveForce,
                           WheelLaw::kIntrusion};

template <typename Enum>
const char* Name(Enum value) {
  return core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)].data();
}

terrain::SoilParams Sand(WheelLaw law) {
  terrain::SoilParams soil = terrain::MakeSoil(SoilPreset::kLandscapingSand);
  soil.law = law;
  return soil;
}

// A rover before an obstacle.
struct Course {
  RoverParams params;
  terrain::SoilParams soil;
  std::vector<terrain::Rock> beside;  // what else lies there
};

// The rocks of an obstacle of some height, and how far behind its front it ends.
struct Obstacle {
  std::vector<terrain::Rock> rocks;
  double depth_m = 0.0;
};

Obstacle Step(double height_m) { return {StepRocks(height_m), 0.0}; }

// Half balls in the tracks of the wheels.
Obstacle Rocks(double height_m, bool both_sides) {
  const RoverGeometryParams size;
  const double track_m = 0.5 * (size.width_m - size.wheel_width_m);
  const double x_m = kObstacle_x_m + height_m;
  Obstacle obstacle{{MakeRock(x_m, track_m, 0.0, height_m, height_m, height_m)}, 2.0 * height_m};
  if (both_sides) {
    obstacle.rocks.push_back(MakeRock(x_m, -track_m, 0.0, height_m, height_m, height_m));
  }
  return obstacle;
}

// Where the rover stands when it is over or has stopped.
struct End {
  bool up = false;
  const char* stopped = "";
};

End Try(const Course& course, const Obstacle& obstacle) {
  std::vector<terrain::Rock> rocks = obstacle.rocks;
  rocks.insert(rocks.end(), course.beside.begin(), course.beside.end());
  const RoverOn rover(terrain::Terrain(terrain::Ground({.soil = course.soil}, {}), rocks, {}),
                      course.params);
  const RoverGeometryParams& size = course.params.geometry;
  const double axle_m = 0.5 * size.wheelbase_m;
  const Climbed climbed = ClimbAhead(*rover, course.params, course.params.drive.speed_m_s,
                                     kObstacle_x_m + obstacle.depth_m + axle_m + 0.05, kPatience_m);
  if (climbed.how == Climb::kTippedOver) return {false, "tips over"};
  // A rover that has turned aside has climbed nothing.
  if (std::abs(math::Heading(rover->state().X_WR)) > 0.5) return {false, "turns aside"};
  if (climbed.how == Climb::kUp) return {true, ""};
  const double front_m = kObstacle_x_m - climbed.x_m;  // of the obstacle, from the rover's origin
  const double reach_m = 2.0 * size.wheel_radius_m;
  if (front_m > axle_m - 0.01) return {false, "front wheels"};
  if (front_m > 0.0 && front_m < reach_m) return {false, "middle wheels"};
  if (front_m > -axle_m && front_m < reach_m - axle_m) return {false, "rear wheels"};
  return {false, climbed.body_touched ? "belly or arms" : "wheels on top"};
}

void PrintLargest(const char* obstacle, const char* change, const char* ground, const char* law,
                  const Course& course, const std::function<Obstacle(double)>& make) {
  double largest_m = 0.0;
  End end;
  for (double height_m = kFirst_m; height_m < kMost_m; height_m += kStride_m) {
    end = Try(course, make(height_m));
    if (!end.up) break;
    largest_m = height_m;
  }
  std::printf("%s,%s,%s,%s,%s,%.3f,%s\n", obstacle, change, ground, law,
              Name(course.params.fidelity), largest_m, end.up ? "" : end.stopped);
  std::fflush(stdout);
}

using Body = std::function<void(const char* ground, const char* law, const Course& course)>;

void ForEachGround(const Body& body) {
  for (const Fidelity fidelity : kFidelities) {
    const RoverParams params = WithFidelity(fidelity);
    body("hard_ground", "", {params, terrain::MakeSoil(SoilPreset::kHardGround), {}});
    for (const WheelLaw law : kLaws) {
      body("landscaping_sand", Name(law), {params, Sand(law), {}});
    }
  }
}

void PrintSteps() {
  ForEachGround([](const char* ground, const char* law, const Course& course) {
    PrintLargest("step", "", ground, law, course, Step);
  });
}

void PrintRocks() {
  ForEachGround([](const char* ground, const char* law, const Course& course) {
    for (const bool both : {false, true}) {
      PrintLargest(both ? "rocks on both sides" : "rock on one side", "", ground, law, course,
                   [both](double height_m) { return Rocks(height_m, both); });
    }
  });
}

// One cause at a time, and pairs.
struct Change {
  const char* name;
  std::function<void(Course&)> make;
};

// Hard ground, 2 mm above the sand, up to half a wheelbase before the step: under the rear wheels
// when the middle wheels are at the step, under both when the front wheels are.
void HardBehind(Course& course) { course.beside = {MakeRock(-0.9, 0.0, -0.008, 2.0, 2.0, 0.01)}; }
void StrongMotors(Course& course) { course.params.drive.stall_torque_Nm *= 10.0; }
void NoBelly(Course& course) { course.params.contact.body_rock_friction = 0.0; }
Change Grip(const char* name, double friction) {
  return {name, [friction](Course& c) { c.params.contact.wheel_rock_friction = friction; }};
}
Change Both(const char* name, const Change& a, const Change& b) {
  return {name, [a, b](Course& course) {
            a.make(course);
            b.make(course);
          }};
}

std::vector<Change> Changes() {
  const Change motors{"motors of 40 Nm", StrongMotors};
  const Change body{"body without friction", NoBelly};
  const Change hard{"hard ground behind", HardBehind};
  const Change grip = Grip("wheels on rock 1.0", 1.0);
  return {{"none", [](Course&) {}},
          motors,
          {"belly at 18 cm", [](Course& c) { c.params.geometry.belly_clearance_m = 0.18; }},
          body,
          hard,
          {"sand of 45 deg", [](Course& c) { c.soil.friction_angle_rad = math::DegToRad(45.0); }},
          Grip("wheels on rock 0.6", 0.6),
          Grip("wheels on rock 0.9", 0.9),
          grip,
          Grip("wheels on rock 1.2", 1.2),
          Both("motors of 40 Nm and body without friction", motors, body),
          Both("motors of 40 Nm and wheels on rock 1.0", motors, grip),
          Both("body without friction and wheels on rock 1.0", body, grip),
          Both("hard ground behind and wheels on rock 1.0", hard, grip)};
}

void PrintChanges() {
  for (const Change& change : Changes()) {
    for (const WheelLaw law : {WheelLaw::kBekker, WheelLaw::kIntrusion}) {
      for (const Fidelity fidelity : kFidelities) {
        Course course{WithFidelity(fidelity), Sand(law), {}};
        change.make(course);
        PrintLargest("step", change.name, "landscaping_sand", Name(law), course, Step);
      }
    }
  }
}

// What steps take by statics: the friction of everything, and the pull on the ground of a rover
// whose wheels find the friction of rock at the step.
void PrintStatics() {
  const RoverParams params;
  const double friction = params.contact.wheel_rock_friction;
  for (const double height_m : {0.02, 0.04, 0.05, 0.06, 0.065, 0.07, 0.08, 0.09, 0.13, 0.195}) {
    const StepStatics step(params, height_m);
    std::printf("%.3f,%.3f,%.3f,%.3f\n", height_m, step.LeastFriction(),
                step.LeastPull(friction, 1), step.LeastPull(friction, 3));
  }
}

// What sand gives to a wheel that spins, over its load: a mean wheel, and one of twice its load.
void PrintPull() {
  const RoverParams params;
  const double mean_N = params.mass.total_kg * params.physics.gravity_m_s2 / 6.0;
  const auto pull = [](const WheelOnSoil& wheel, double load_N) {
    const SoilAnswer answer = wheel.Under(load_N, 1.0);
    const double share =
        std::isinf(answer.shear_ratio) ? 1.0 : ShareOfRatio(answer.shear_ratio).value;
    return (answer.traction_N * share - answer.resistance_N) / load_N;
  };
  const auto print = [&](const char* ground, const char* law, const terrain::SoilParams& soil) {
    const WheelOnSoil wheel = MakeWheelOnSoil(params, soil);
    std::printf("%s,%s,%.3f,%.3f\n", ground, law, pull(wheel, mean_N), pull(wheel, 2.0 * mean_N));
  };
  print("hard_ground", "", terrain::MakeSoil(SoilPreset::kHardGround));
  for (const WheelLaw law : kLaws) print("landscaping_sand", Name(law), Sand(law));
}

// Which steps of one to three wheel radii a rover climbs by the friction of its wheels on rock.
void PrintFrictions(const char* file) {
  RoverParams rover;
  core::ReadParams(core::LoadJsonFile(file), rover);
  ForEachGround([&](const char* ground, const char* law, Course course) {
    const Fidelity fidelity = course.params.fidelity;
    course.params = rover;
    course.params.fidelity = fidelity;
    for (const double friction : {0.6, 0.7, 0.8, 0.9, 1.0}) {
      course.params.contact.wheel_rock_friction = friction;
      std::printf("%s,%s,%s,%.1f", ground, law, Name(fidelity), friction);
      for (const double radii : {1.0, 2.0, 3.0}) {
        const End end = Try(course, Step(radii * rover.geometry.wheel_radius_m));
        std::printf(",%s", end.up ? "up" : end.stopped);
      }
      std::puts("");
      std::fflush(stdout);
    }
  });
}

int Main(std::string_view part, const char* file) {
  constexpr const char* kLargest = "obstacle,change,ground,law,fidelity,largest_m,stopped";
  if (part == "steps" || part == "changes" || part == "rocks") std::puts(kLargest);
  if (part == "steps") {
    PrintSteps();
  } else if (part == "changes") {
    PrintChanges();
  } else if (part == "rocks") {
    PrintRocks();
  } else if (part == "statics") {
    std::puts("height_m,friction,front_pull,pull");
    PrintStatics();
  } else if (part == "pull") {
    std::puts("ground,law,pull,pull_of_twice");
    PrintPull();
  } else if (part == "frictions") {
    std::puts("ground,law,fidelity,friction,one_radius,two_radii,three_radii");
    PrintFrictions(file);
  } else {
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace rockyard::rover

int main(int count, char** words) {
  return rockyard::rover::Main(count > 1 ? words[1] : "", count > 2 ? words[2] : "");
}
