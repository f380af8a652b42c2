// Equal arguments give bit-for-bit equal motion.
#include <gtest/gtest.h>

#include "core/hash.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

std::uint64_t DriveAndHash(const RoverParams& params, const terrain::Terrain& terrain) {
  const auto rover = PlacedRover(params, terrain);
  core::Hasher hasher;
  for (int i = 0; i < 900; ++i) {
    rover->Step(Drive(params, 0.12, i % 300 < 150 ? 0.1 : -0.2));
    hasher.Real(rover->state().X_WR.translation().x());
    hasher.Real(rover->state().X_WR.linear()(2, 0));
    hasher.Real(rover->state().wheel_angle_rad[4]);
  }
  return hasher.value();
}

terrain::Terrain Rocks() {
  return FlatTerrain({MakeRock(0.6, 0.2, 0.0, 0.15, 0.12, 0.1),
                      MakeRock(1.0, -0.15, 0.0, 0.1, 0.1, 0.14),
                      MakeRock(1.3, 0.1, -0.02, 0.2, 0.15, 0.12)});
}

TEST(Determinism, EqualRunsAreEqualBitForBit) {
  const RoverParams params;
  const terrain::Terrain terrain = Rocks();
  const std::uint64_t first = DriveAndHash(params, terrain);
  RoverParams other = params;
  other.mass.total_kg = 19.0;
  EXPECT_NE(DriveAndHash(other, terrain), first);  // the hash can tell runs apart
  EXPECT_EQ(DriveAndHash(params, terrain), first);
  EXPECT_EQ(DriveAndHash(params, Rocks()), first);
}

}  // namespace
}  // namespace rockyard::rover
