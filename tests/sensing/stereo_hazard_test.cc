// The published hazard criteria on elevation arrays from noisy stereo looks.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "core/archive.h"
#include "core/json_file.h"
#include "perception/cloud_elevations.h"
#include "perception/hazard_criteria.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using messages::LookDirection;

constexpr int kLooks = 300;

struct Rover {
  StereoParams stereo;
  perception::CloudElevationParams bins;
};

Rover Stored(const std::string& name, double near_m, double far_m) {
  const auto path = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios" / "sensors" /
                    ("stereo_" + name + ".json");
  Rover rover;
  core::ReadParams(core::LoadJsonFile(path), rover.stereo);
  rover.bins.near_m = near_m;
  rover.bins.far_m = far_m;
  return rover;
}

Rover Rocky() { return Stored("rocky_3_2", 0.425, 1.425); }
Rover Athena() { return Stored("athena_sdm", 0.62, 1.62); }

// Looks with a hazard, of kLooks at ground with a dome of that height somewhere in the array.
int Alarms(const Rover& rover, double height_m) {
  const StereoSensor sensor(rover.stereo);
  int alarms = 0;
  for (int look = 0; look < kLooks; ++look) {
    const double middle_m = 0.5 * (rover.bins.near_m + rover.bins.far_m);
    const double x_m = middle_m + 0.35 * std::sin(3.1 * look);
    const double y_m = 0.35 * std::sin(1.7 * look);
    std::vector<terrain::Rock> rocks;
    if (height_m > 0.0) {
      rocks.push_back(EllipsoidRock(x_m, y_m, 0.0, height_m, 0.8 * height_m, height_m));
    }
    const auto cloud = sensor.Look(FlatWith(std::move(rocks)), PoseAt(0, 0, 0), {1, 0}, look,
                                   LookDirection::kAhead);
    const auto scan = perception::CloudElevations(cloud, {}, rover.bins);
    alarms += perception::ReportHazards(scan, {}).any();
  }
  return alarms;
}

// Were the rate 2 %, none of 300 looks would be an alarm once in 400 seeds, and 15 or more once in
// 2000 (binomial law).
TEST(StereoHazardTest, FlatGroundIsHardlyEverAHazard) {
  EXPECT_LT(Alarms(Rocky(), 0.0), 15);
  EXPECT_LT(Alarms(Athena(), 0.0), 15);
  // Negative control: noise of six times the size.
  Rover noisy = Athena();
  noisy.stereo.disparity_noise_px *= 6.0;
  EXPECT_GT(Alarms(noisy, 0.0), 100);
}

TEST(StereoHazardTest, RocksOfTwelveCentimetresAreHazardsAndOfThreeAreNot) {
  EXPECT_EQ(Alarms(Rocky(), 0.12), kLooks);
  EXPECT_EQ(Alarms(Athena(), 0.12), kLooks);
  EXPECT_LT(Alarms(Rocky(), 0.03), kLooks / 10);
}

TEST(StereoHazardTest, AMedianOverlooksRocksThatFillLessThanHalfABin) {
  Rover rover = Athena();
  rover.bins.quantile = 0.5;
  EXPECT_LT(Alarms(rover, 0.12), kLooks / 2);
}

}  // namespace
}  // namespace rockyard::sensing
