// The way that wheels make of their rims over rocks, driven in legs as trials drive them: what the
// odometer of a trial is right or wrong by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "rover/rover_drive.h"
#include "terrain/field.h"

namespace rockyard::rover {
namespace {

constexpr int kFields = 120;
constexpr int kLegs = 40;
// About a wheel radius, in whole steps of both rovers: each start and stop costs way.
constexpr double kDrive_s = 0.45;
constexpr double kRest_s = 0.15;
// A rover that makes less than this of its rims' way has met what it does not climb.
constexpr double kStuck = 0.5;
// The last legs before one of two rovers gets stuck are those of one that pushes already.
constexpr int kLegsBefore = 2;

struct RockyDrive {
  std::vector<double> way;  // of each leg over that of the rims, until the rover gets stuck
  double deepest_m = 0.0;   // of its wheels, at the ends of the legs
};

RockyDrive DriveOverRocks(const RoverParams& params, const terrain::Terrain& terrain) {
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand drive = Drive(params, params.drive.speed_m_s, 0.0);
  const double rolled_m = params.drive.speed_m_s * kDrive_s;
  RockyDrive found;
  for (int leg = 0; leg < kLegs; ++leg) {
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, drive, kDrive_s);
    RunFor(*rover, kBraked, kRest_s);
    const double way = (rover->state().X_WR.translation() - from).norm() / rolled_m;
    if (way < kStuck) break;
    found.way.push_back(way);
    for (const double depth_m : rover->state().wheel_sinkage_m) {
      found.deepest_m = std::max(found.deepest_m, depth_m);
    }
  }
  return found;
}

// The nominal terrain of Matthies 1995 with its pointed rocks.
terrain::Terrain NominalRocks(std::uint32_t field) {
  terrain::TerrainParams params{.rocks = {.pointedness = 0.8675}};
  constexpr std::uint64_t kSeed = 77;
  return terrain::BuildField(params, {kSeed, field}, {}).terrain;
}

std::vector<RockyDrive> DriveOverFields(const RoverParams& params) {
  std::vector<RockyDrive> drives;
  for (std::uint32_t field = 0; field < kFields; ++field) {
    drives.push_back(DriveOverRocks(params, NominalRocks(field)));
  }
  return drives;
}

RoverParams QuasiStatic(double rock_settle_share) {
  RoverParams params = WithFidelity(Fidelity::kQuasiStatic);
  params.quasi_static.rock_settle_share = rock_settle_share;
  return params;
}

// Mean over the legs that both drive.
double LessWay(const std::vector<RockyDrive>& first, const std::vector<RockyDrive>& second) {
  double less = 0.0;
  int legs = 0;
  for (std::size_t field = 0; field < first.size(); ++field) {
    const std::vector<double>& a = first[field].way;
    const std::vector<double>& b = second[field].way;
    const int both = static_cast<int>(std::min(a.size(), b.size())) - kLegsBefore;
    for (int leg = 0; leg < both; ++leg) {
      less += a[static_cast<std::size_t>(leg)] - b[static_cast<std::size_t>(leg)];
      ++legs;
    }
  }
  return less / legs;
}

double MeanDeepest_m(const std::vector<RockyDrive>& drives) {
  double sum_m = 0.0;
  for (const RockyDrive& drive : drives) sum_m += drive.deepest_m;
  return sum_m / static_cast<double>(drives.size());
}

// Legs that only one of them drives are left out, so that a rover that gets stuck in one of the two
// decides nothing. The margin is 1 cm at a goal 7.6 m away.
TEST(RockyWay, IsThatOfTheMultibody) {
  constexpr double kMargin = 1.5e-3;
  const std::vector<RockyDrive> multibody = DriveOverFields(RoverParams{});
  const std::vector<RockyDrive> chosen = DriveOverFields(QuasiStatic(0.5));
  const std::vector<RockyDrive> fine = DriveOverFields(QuasiStatic(0.25));
  EXPECT_NEAR(LessWay(multibody, chosen), 0.0, kMargin);
  EXPECT_NEAR(LessWay(fine, chosen), 0.0, kMargin);
  // The control: stretches on rocks as long as on soil lose way.
  EXPECT_GT(LessWay(multibody, DriveOverFields(QuasiStatic(1.0))), kMargin);
  // Wheels that leave a rock stand no deeper than they are loaded.
  EXPECT_NEAR(MeanDeepest_m(chosen), MeanDeepest_m(multibody), 0.1 * MeanDeepest_m(multibody));
  EXPECT_EQ(RoverParams{}.quasi_static.rock_settle_share, 0.5);
}

}  // namespace
}  // namespace rockyard::rover
