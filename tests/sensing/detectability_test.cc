// Which rocks a straight approach sees, without noise. Section 6 of Matthies 1995: "on average
// rocks must be about 1.5 times higher" than the neighbour threshold to be seen, since the sparse
// points miss their tops. The bounds here are those of the geometry, not of that statement.
#include <gtest/gtest.h>

#include "core/distributions.h"
#include "perception/hazard_criteria.h"
#include "sensing/stripe_scene.h"

namespace rockyard::sensing {
namespace {

// Share of rocks of one height, a third of them below ground, anywhere across the rover's width,
// that are detected by scans every 6.5 cm before its front reaches them.
double ShareSeen(double height_m, int rocks) {
  const LightStripe sensor(NoiselessParams());
  const perception::Triangulator triangulator(sensor.calibration());
  int seen = 0;
  for (int i = 0; i < rocks; ++i) {
    core::RandomStream stream({20260108, static_cast<std::uint32_t>(i)}, core::Purpose::kTest);
    const double c = 0.75 * height_m;
    const double a = c / core::SampleUniform(stream, 0.5, 1.0);
    const double y = core::SampleUniform(stream, -0.24, 0.24);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    const terrain::Terrain field =
        FlatWith({EllipsoidRock(2.0, y, height_m - c, a, 0.85 * a, c, yaw)});
    double x = core::SampleUniform(stream, 0.8, 0.865);
    bool hazard = false;
    for (; !hazard && x + 0.325 < 2.0 - a; x += 0.065) {
      const auto scan = sensor.Scan(field, PoseAt(x, 0, 0), {1, 0}, 0);
      hazard = perception::ReportHazards(triangulator.Elevations(scan), {}).any();
    }
    seen += hazard;
  }
  return static_cast<double>(seen) / rocks;
}

TEST(DetectabilityTest, HigherRocksAreSeenMoreOften) {
  double before = 0.0;
  for (const double height_m : {0.03, 0.05, 0.07, 0.09, 0.12}) {
    const double share = ShareSeen(height_m, 500);
    EXPECT_GE(share, before) << height_m;
    before = share;
  }
  // No two points of a rock and of flat ground differ by more than its height: only points that it
  // hides from a camera can betray a rock below the threshold.
  EXPECT_LT(ShareSeen(0.03, 500), 0.15);
  EXPECT_GT(ShareSeen(0.12, 500), 0.98);
}

}  // namespace
}  // namespace rockyard::sensing
