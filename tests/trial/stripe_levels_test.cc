// Both levels of fidelity of the light stripe sensor on the same scenes: where stripes are found,
// and what the hazard detector makes of it. The errors of the geometric level come from
// scenarios/sensors/fitted_*.json, which were counted on the scenes of seed 1; here are others.
#include "stripe_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "perception/hazard_detector.h"
#include "perception/triangulation.h"
#include "scenario/load.h"
#include "statistics/proportions.h"
#include "trial/sight/onboard_calibration.h"
#include "vision/lens.h"

namespace rockyard::trial {
namespace {

using scenario::Scenario;
using sensing::Fidelity;

// Chance of a false alarm of each check if its seed were drawn anew. Seeds are fixed.
constexpr double kAlpha = 1e-3;
constexpr std::uint32_t kScenes = 200;

// VL-2 terrain, where most such scenes have a hazard, in the light and with the errors of a file.
Scenario Light(const std::string& light, const std::vector<std::string>& overrides = {}) {
  const std::string text = R"({"schema_version": 1, "seed": 2, "extends": ["pathfinder/vl2.json",)"
                           R"( "sensors/fitted_)" +
                           light + R"(.json"]})";
  return scenario::ParseScenario(text, overrides, std::string(ROCKYARD_SOURCE_DIR) + "/scenarios");
}

struct Decision {
  messages::PerStripe<bool> stripes;
  bool any = false;
};

// Single scans of the scenes as one level sees them; draw 1 has other noise than draw 0.
std::vector<Decision> Decisions(const Scenario& scenario, Fidelity fidelity,
                                double inner_shift_m = 0.0, std::uint64_t draw = 0) {
  // What is on board is right, and so is the hardware but for the shift.
  const perception::Triangulator triangulator(
      OnboardStripeCalibration(scenario.drive.sensors.light_stripe, {}));
  Scenario hardware = scenario;
  hardware.drive.sensors.light_stripe.inner_stripe_y_m += inner_shift_m;
  const LevelOfStripes level(hardware, fidelity);
  std::vector<Decision> decisions;
  for (std::uint32_t index = 0; index < kScenes; ++index) {
    StripeScene scene = MakeStripeScene(scenario, SceneKind::kRocks, index);
    constexpr std::uint64_t kOtherSeed = 1000;
    scene.key.seed += draw * kOtherSeed;
    const auto scan = level.Scan(scene);
    const auto report =
        perception::ReportHazards(triangulator.Elevations(scan), scenario.drive.perception.hazard);
    decisions.push_back({report.stripe_hazard, report.any()});
  }
  return decisions;
}

// By the images of scenes in a light without other errors, which several tests compare with.
const std::vector<Decision>& ImageDecisions(const std::string& light) {
  static std::map<std::string, std::vector<Decision>> made;
  const auto [place, is_new] = made.try_emplace(light);
  if (is_new) place->second = Decisions(Light(light), Fidelity::kImage);
  return place->second;
}

struct Disagreement {
  int only_first = 0;
  int only_second = 0;
  int hazards = 0;  // scenes that the first calls hazardous
  int stripes = 0;  // flags that differ

  // Exact test of paired decisions: are those of one kind only as frequent as those of the other?
  double PValue() const { return statistics::McNemarExactPValue(only_first, only_second); }
};

Disagreement Compare(const std::vector<Decision>& first, const std::vector<Decision>& second) {
  Disagreement result;
  for (std::size_t i = 0; i < first.size(); ++i) {
    result.only_first += first[i].any && !second[i].any;
    result.only_second += second[i].any && !first[i].any;
    result.hazards += first[i].any;
    for (std::size_t stripe = 0; stripe < first[i].stripes.size(); ++stripe) {
      result.stripes += first[i].stripes[stripe] != second[i].stripes[stripe];
    }
  }
  return result;
}

int StripesThatDiffer(const Decision& a, const Decision& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.stripes.size(); ++i) count += a.stripes[i] != b.stripes[i];
  return count;
}

// Whether `other` differs from `geometric` as often as another draw of the geometric sensor does.
// Null: given the scene, `other` is one more such draw, so that it and `redrawn` may be exchanged:
// of the scenes in which one of them differs more, each is the one with chance 1/2, whatever the
// scenes hold and however the flags of one scan hang together. Exact sign tests.
struct ShareTest {
  double scenes_p = 1.0;  // scenes that are called hazardous or not
  double flags_p = 1.0;   // scenes by the number of their stripes' flags that differ
};

ShareTest CompareShares(const std::vector<Decision>& other, const std::vector<Decision>& geometric,
                        const std::vector<Decision>& redrawn) {
  int scenes[2] = {0, 0};
  int flags[2] = {0, 0};
  for (std::size_t i = 0; i < geometric.size(); ++i) {
    const bool of_other = other[i].any != geometric[i].any;
    const bool of_redrawn = redrawn[i].any != geometric[i].any;
    if (of_other != of_redrawn) ++scenes[of_other ? 0 : 1];
    const int more =
        StripesThatDiffer(other[i], geometric[i]) - StripesThatDiffer(redrawn[i], geometric[i]);
    if (more != 0) ++flags[more > 0 ? 0 : 1];
  }
  testing::Test::RecordProperty("scenes_other_differs", scenes[0]);
  testing::Test::RecordProperty("scenes_redrawn_differs", scenes[1]);
  testing::Test::RecordProperty("flags_other_differs", flags[0]);
  testing::Test::RecordProperty("flags_redrawn_differs", flags[1]);
  return {statistics::McNemarExactPValue(scenes[0], scenes[1]),
          statistics::McNemarExactPValue(flags[0], flags[1])};
}

class StripeLevelsTest : public testing::TestWithParam<std::string> {};

TEST_P(StripeLevelsTest, HazardDecisionsAgree) {
  const Scenario scenario = Light(GetParam());
  const auto& image = ImageDecisions(GetParam());
  const auto geometric = Decisions(scenario, Fidelity::kGeometric);
  const Disagreement difference = Compare(image, geometric);
  RecordProperty("hazards", difference.hazards);
  RecordProperty("only_image", difference.only_first);
  RecordProperty("only_geometric", difference.only_second);
  RecordProperty("stripe_flags_that_differ", difference.stripes);
  EXPECT_GT(difference.hazards, 10);
  EXPECT_GT(difference.PValue(), kAlpha);
  const ShareTest shares =
      CompareShares(image, geometric, Decisions(scenario, Fidelity::kGeometric, 0.0, 1));
  EXPECT_GT(shares.scenes_p, kAlpha);
  EXPECT_GT(shares.flags_p, kAlpha);
}

TEST_P(StripeLevelsTest, MissedPointsAreAsFrequent) {
  const Scenario scenario = Light(GetParam());
  const auto missed_p = [&](const Scenario& geometric, const PointTally& image) {
    const PointTally tally = TallyPoints(geometric, Fidelity::kGeometric, SceneKind::kFlat, 200);
    return statistics::FisherExactPValue(
        {image.missed, image.visible - image.missed, tally.missed, tally.visible - tally.missed});
  };
  const PointTally image = TallyPoints(scenario, Fidelity::kImage, SceneKind::kFlat, 200);
  EXPECT_GT(missed_p(scenario, image), kAlpha);
  // Negative control: half as many again, and 2 % more.
  Scenario wrong = scenario;
  for (double& probability : wrong.drive.sensors.light_stripe.missed_at) {
    probability = std::min(1.0, 1.5 * probability + 0.02);
  }
  EXPECT_LT(missed_p(wrong, image), kAlpha);
}

INSTANTIATE_TEST_SUITE_P(Lights, StripeLevelsTest,
                         testing::Values("mars_noon", "mars_low_sun", "earth_faint",
                                         "earth_fainter"));

// Negative controls of the comparison of decisions.
TEST(StripeLevelsControlTest, TellsTheErrorsOfAnotherLight) {
  const auto& image = ImageDecisions("mars_noon");
  // The published one point in a hundred where the images misplace none.
  const Scenario published =
      Light("mars_noon", {"sensors.light_stripe.wrong_place_probability=0.01"});
  EXPECT_LT(Compare(image, Decisions(published, Fidelity::kGeometric)).PValue(), kAlpha);
}

TEST(StripeLevelsControlTest, TellsAShiftedStripe) {
  // Light planes that meet the farthest row 3 cm from where the rover believes them to.
  const Scenario scenario = Light("mars_noon");
  const auto& image = ImageDecisions("mars_noon");
  EXPECT_LT(Compare(image, Decisions(scenario, Fidelity::kGeometric, 0.03)).PValue(), kAlpha);
}

// Every tenth decision turned round, hazards and free scenes alike: symmetric, so that McNemar's
// test sees nothing, but ten in a hundred scenes differ.
TEST(StripeLevelsControlTest, TellsDecisionsThatDifferBothWays) {
  const Scenario scenario = Light("mars_noon");
  const auto geometric = Decisions(scenario, Fidelity::kGeometric);
  auto flipped = geometric;
  for (std::size_t i = 0; i < flipped.size(); i += 10) {
    flipped[i].any = !flipped[i].any;
    for (bool& stripe : flipped[i].stripes) stripe = !stripe;
  }
  EXPECT_GT(Compare(flipped, geometric).PValue(), kAlpha);
  const ShareTest shares =
      CompareShares(flipped, geometric, Decisions(scenario, Fidelity::kGeometric, 0.0, 1));
  EXPECT_LT(shares.scenes_p, kAlpha);
  EXPECT_LT(shares.flags_p, kAlpha);
}

// Columns of flat ground against the camera model alone, with light so strong that noise plays no
// part: the renderer and the finder agree on where a stripe lies.
class StripeColumnsTest : public testing::TestWithParam<messages::Lens> {};

TEST_P(StripeColumnsTest, FlatGroundAppearsWhereTheLensProjectsIt) {
  Scenario scenario;
  scenario.drive.sensors.light_stripe.lens = GetParam();
  scenario.drive.sensors.sun.irradiance_w_m2_nm = 0.0;
  const LevelOfStripes level(scenario, Fidelity::kImage);
  const auto scan = level.Scan(MakeStripeScene(scenario, SceneKind::kFlat, 0));
  const auto calibration = OnboardStripeCalibration(scenario.drive.sensors.light_stripe, {});
  for (std::size_t row = 0; row < calibration.size().rows; ++row) {
    for (std::size_t stripe = 0; stripe < calibration.size().stripes; ++stripe) {
      ASSERT_TRUE(scan.pixels[row][stripe].detected) << row << " " << stripe;
      // Where the light plane meets the ground on this scanline, by bisection along the plane.
      const messages::StripeLaser& laser = calibration.lasers[stripe];
      const auto& camera = calibration.cameras[static_cast<std::size_t>(laser.camera)];
      const math::Vector3 along = math::Vector3::UnitZ().cross(laser.normal_R).normalized();
      const auto seen_at = [&](double distance_m) {
        math::Vector3 p_R = laser.p_RoE_R + distance_m * std::copysign(1.0, along.x()) * along;
        p_R.z() = 0.0;
        return *vision::Project(camera, camera.X_RC.inverse() * p_R);
      };
      double near_m = 0.02;
      double far_m = 0.9;
      for (int i = 0; i < 60; ++i) {
        const double middle_m = 0.5 * (near_m + far_m);
        // Farther ground appears higher up.
        (seen_at(middle_m).row_px > calibration.scanline_px[row] ? near_m : far_m) = middle_m;
      }
      EXPECT_NEAR(scan.pixels[row][stripe].column_px, seen_at(near_m).column_px, 1.0)
          << row << " " << stripe;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, StripeColumnsTest,
                         testing::Values(messages::Lens::kEquidistantRows,
                                         messages::Lens::kEquidistant, messages::Lens::kPinhole));

}  // namespace
}  // namespace rockyard::trial
