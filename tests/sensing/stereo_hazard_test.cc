// The published hazard criteria on elevation arrays from noisy stereo looks.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "core/archive.h"
#include "core/json_file.h"
#include "perception/cloud_elevations.h"
#include "perception/hazard_detector.h"
#include "perception/hazard_params.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using messages::LookDirection;

constexpr int kLooks = 300;

// What the behaviour controller sees and judges with stereo, as its scenario has it.
struct Rover {
  StereoParams stereo;
  perception::CloudElevationParams bins;
  perception::HazardParams hazard;
};

Rover Stored(const std::string& name) {
  const core::JsonValue scenario = core::LoadJsonFile(std::filesystem::path(ROCKYARD_SOURCE_DIR) /
                                                      "scenarios" / "gestalt" / (name + ".json"));
  const core::JsonValue& perception = *scenario.Find("perception");
  Rover rover;
  core::ReadParams(*scenario.Find("sensors")->Find("stereo"), rover.stereo);
  core::ReadParams(*perception.Find("cloud_elevations"), rover.bins);
  core::ReadParams(*perception.Find("hazard"), rover.hazard);
  return rover;
}

Rover Rocky() { return Stored("abundance_rocky_3_2_behaviour_stereo"); }
Rover Athena() { return Stored("abundance_behaviour_stereo"); }

// Looks with a hazard, of kLooks at ground with a dome of that height somewhere in the array.
int Alarms(const Rover& rover, double height_m) {
  const StereoSensor sensor(rover.stereo);
  int alarms = 0;
  for (int look = 0; look < kLooks; ++look) {
    const double middle_m = 0.5 * (rover.bins.near_m + rover.bins.far_m);
    const double x_m =
        middle_m + 0.35 * (rover.bins.far_m - rover.bins.near_m) * std::sin(3.1 * look);
    const double y_m = 0.5 * rover.bins.half_width_m * std::sin(1.7 * look);
    std::vector<terrain::Rock> rocks;
    if (height_m > 0.0) {
      rocks.push_back(EllipsoidRock(x_m, y_m, 0.0, height_m, 0.8 * height_m, height_m));
    }
    const auto cloud = sensor.Look(FlatWith(std::move(rocks)), PoseAt(0, 0, 0), {1, 0}, look,
                                   LookDirection::kAhead);
    const auto scan = perception::CloudElevations(cloud, {}, rover.bins);
    alarms += perception::ReportHazards(scan, rover.hazard).any();
  }
  return alarms;
}

// Were the rate 2 %, none of 300 looks would be an alarm once in 400 seeds, and 15 or more once in
// 2000 (binomial law).
TEST(StereoHazardTest, FlatGroundIsHardlyEverAHazard) {
  EXPECT_LT(Alarms(Rocky(), 0.0), 15);
  EXPECT_LT(Alarms(Athena(), 0.0), 15);
  // Negative control: wrong matches that the check from left to right has let through. (Noise of
  // any size is none: it raises the highest point of all bins alike.)
  Rover mistaken = Athena();
  mistaken.stereo.mismatch_probability = 0.02;
  EXPECT_GT(Alarms(mistaken, 0.0), 100);
}

// The thresholds are the clearance of the belly: 20 and 13 cm.
TEST(StereoHazardTest, RocksHigherThanTheBellyAreHazardsAndHalfAsHighAreNot) {
  for (const Rover& rover : {Athena(), Rocky()}) {
    EXPECT_EQ(Alarms(rover, 1.25 * rover.hazard.neighbour_threshold_m), kLooks);
    EXPECT_LT(Alarms(rover, 0.5 * rover.hazard.neighbour_threshold_m), kLooks / 10);
  }
}

// Rocks of 12 cm, which cover less than half a bin, at the published thresholds for single points.
TEST(StereoHazardTest, AMedianOverlooksRocksThatFillLessThanHalfABin) {
  Rover rover = Athena();
  rover.hazard = {};
  EXPECT_EQ(Alarms(rover, 0.12), kLooks);
  rover.bins.quantile = 0.5;
  EXPECT_LT(Alarms(rover, 0.12), kLooks / 2);
}

}  // namespace
}  // namespace rockyard::sensing
