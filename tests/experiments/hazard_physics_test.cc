// Studies of hazard detection, "precision" too, against what follows without a simulation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "experiments/hazard_detection/hazard_judge.h"
#include "experiments/hazard_scenarios.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_layout_params.h"
#include "statistics/proportions.h"

namespace rockyard::experiments {
namespace {

constexpr double kAlpha = 1e-4;  // of each statistical statement below

const std::vector<std::string> kNoNoise{"sensors.light_stripe.wrong_place_probability=0"};

// Without a rock nothing is caused by one, whatever the noise.
TEST(HazardPhysicsTest, NoRockIsNeverDetected) {
  const std::vector<std::string> none{"hazard_detection.heights_m=[0]"};
  for (const char* study : {"detection", "approach"}) {
    EXPECT_EQ(Count(HazardScenario(study, none), "detected_single"), 0.0) << study;
    EXPECT_EQ(Count(HazardScenario(study, none), "detected_double"), 0.0) << study;
  }
}

// Elevation 0.12 m is over t_dh = 5 cm, and a rock of 1.2 m that begins 3 cm before the rover and
// spans the array leaves no two neighbours to compare but on its flank: the array sees either its
// flank or a range of at least the height of the lowest point that it covers. That takes a round
// rock: a cone of this size rises by a third of its way, less than the threshold from one row to
// the next.
TEST(HazardPhysicsTest, ARockLargerThanTheArrayIsAlwaysSeenOnTheWay) {
  const scenario::Scenario scenario = HazardScenario(
      "approach",
      With(kNoNoise, {"hazard_detection.heights_m=[0.2]", "hazard_detection.diameters_m=[1.2]",
                      "hazard_detection.lateral_offsets_m=[0]", "terrain.rocks.pointedness=0"}));
  const double scenes = Count(scenario, "scenes");
  EXPECT_EQ(Count(scenario, "detected_single"), scenes);
  EXPECT_EQ(Count(scenario, "detected_double"), scenes);
}

// Negative control of the test above: a rock of 3.5 cm lacks 1.5 cm to the threshold. One pixel
// stands for 11 mm of range in the farthest row (2.4 mrad (0.45 m)^2 / 5 cm), so that rounding
// moves each of two points by 5.5 mm at most, along a ray that falls by less than its length.
TEST(HazardPhysicsTest, ARockBelowTheThresholdIsNoStepForACleanSensor) {
  const scenario::Scenario scenario = HazardScenario(
      "detection",
      With(kNoNoise,
           {"hazard_detection.heights_m=[0.035]", "hazard_detection.diameters_m=[0.4]",
            "hazard_detection.lateral_offsets_m=[0.05]", "hazard_detection.distances_m=[0.09]"}));
  EXPECT_EQ(Count(scenario, "by_neighbour"), 0.0);
  EXPECT_EQ(Count(scenario, "by_range"), 0.0);
}

// One look's chance to see a rock does not fall with its height, all else drawn alike. Runs of
// equal index share their noise only; cells of one run index differ in height, so compare rates:
// Wilson intervals at 1 - kAlpha of neighbours must not be apart in the wrong order.
TEST(HazardPhysicsTest, DetectionGrowsWithHeight) {
  const auto experiment = MakeExperiment(HazardScenario(
      "approach",
      {"hazard_detection.heights_m=[0.03, 0.05, 0.06, 0.075, 0.09, 0.12, 0.2]",
       "hazard_detection.diameters_m=[0.25]", "hazard_detection.lateral_offsets_m=[0.15]",
       "hazard_detection.scenes_per_run=400"}));
  statistics::Interval before{0.0, 0.0};
  double first_rate = 1.0;
  double last_rate = 0.0;
  for (std::uint64_t cell = 0; cell < 7; ++cell) {
    const truth::Record record = experiment->Run(3, cell);
    const auto count =
        static_cast<std::int64_t>(ValueOf(experiment->schema(), record, "detected_double"));
    const statistics::Proportion rate = statistics::MakeProportion(count, 400, 1.0 - kAlpha);
    EXPECT_GE(rate.interval.high, before.low) << "cell " << cell;
    before = rate.interval;
    if (cell == 0) first_rate = rate.rate;
    last_rate = rate.rate;
  }
  EXPECT_LT(first_rate, 0.3);
  EXPECT_GT(last_rate, 0.95);
}

// Chance that a scan of flat sand with exactly one point in a wrong place, at a column of its
// searched part, raises an alarm: counted over all points and columns.
double AlarmShareOfOneWrongPoint(const scenario::Scenario& scenario) {
  const HazardJudge judge(scenario.drive);
  const sensing::LightStripe sensor(scenario.drive.sensors.light_stripe);
  const perception::Triangulator triangulator(sensor.calibration());
  const terrain::Terrain sand(terrain::Ground(), {}, {});
  const messages::ElevationScan clean = judge.Scan(sand, math::Transform::Identity(), {1, 0}, 0);
  double share = 0.0;
  for (std::size_t row = 0; row < clean.points.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < clean.points.stripes(); ++stripe) {
      const auto range = sensor.searched(row, stripe);
      int alarms = 0;
      for (int column = range.first; column <= range.last; ++column) {
        messages::ElevationScan scan = clean;
        scan.points[row][stripe] = triangulator.Elevation(row, stripe, column);
        if (perception::ReportHazards(scan, judge.hazard()).any()) ++alarms;
      }
      share += alarms / static_cast<double>(range.last - range.first + 1);
    }
  }
  return share / static_cast<double>(clean.points.points().size());
}

// P(alarm) lies between P(one wrong point) q and the same plus P(two or more), with q from above
// and 20 independent points: 20 p (1 - p)^19 q <= P <= that + 1 - (1 - p)^20 - 20 p (1 - p)^19.
TEST(HazardPhysicsTest, FalseAlarmsFollowTheArithmeticOfWrongPoints) {
  const scenario::Scenario clean = HazardScenario("false_alarm", kNoNoise);
  const double q = AlarmShareOfOneWrongPoint(clean);
  EXPECT_GT(q, 0.5);
  EXPECT_LT(q, 1.0);
  const double p = 0.001;
  const scenario::Scenario scenario =
      HazardScenario("false_alarm", {"hazard_detection.wrong_place_probabilities=[0.001]",
                                     "hazard_detection.scenes_per_run=100000"});
  const auto experiment = MakeExperiment(scenario);
  double alarms = 0.0;
  for (std::uint64_t run = 0; run < 4; ++run) {
    alarms += ValueOf(experiment->schema(), experiment->Run(1, run), "alarm_single");
  }
  const statistics::Interval measured =
      statistics::ProportionInterval(std::llround(alarms), 400000, 1.0 - kAlpha);
  const double none = std::pow(1.0 - p, 20);
  const double one = 20.0 * p * std::pow(1.0 - p, 19);
  EXPECT_GE(measured.high, one * q);
  EXPECT_LE(measured.low, one * q + 1.0 - none - one);
  // Negative control: the bare chance of a wrong point is told apart from that of an alarm.
  EXPECT_LT(measured.high, 1.0 - none);
}

TEST(HazardPhysicsTest, NoWrongPointsNoAlarms) {
  const scenario::Scenario scenario =
      HazardScenario("false_alarm", {"hazard_detection.wrong_place_probabilities=[0]"});
  EXPECT_EQ(Count(scenario, "alarm_single"), 0.0);
  EXPECT_EQ(Count(scenario, "alarm_believed"), 0.0);
  EXPECT_EQ(Count(scenario, "scans"), Count(scenario, "scenes"));
}

// A wrong point that always stays is as good as a rock: with persistence r two alarms agree at
// least with r; without it hardly ever.
TEST(HazardPhysicsTest, PersistentOutliersPassTheTwoScanRule) {
  const scenario::Scenario scenario = HazardScenario(
      "persistence",
      {"hazard_detection.outlier_persistences=[0, 0.9]", "hazard_detection.scenes_per_run=4000"});
  const double alarms = Count(scenario, "alarm_single", 1);
  EXPECT_LT(Count(scenario, "alarm_pair", 0), 0.02 * Count(scenario, "alarm_single", 0));
  // All 20 points keep their lot with 0.9 each; the one that matters and no new one: over 0.7.
  EXPECT_GT(Count(scenario, "alarm_pair", 1), 0.7 * alarms);
}

TEST(RockSceneTest, RocksHaveTheirHeightAndBeginAtZero) {
  const terrain::RockFieldParams law;
  core::RandomStream stream({1, 0}, core::Purpose::kSceneRock);
  for (const RockProportions proportions : {RockProportions::kListed, RockProportions::kNatural}) {
    const terrain::Rock rock = DrawSceneRock({0.1, 0.3, 0.0}, proportions, law, 0.05, stream);
    const terrain::Terrain terrain = SceneTerrain(rock);
    EXPECT_NEAR(terrain.Height(rock.center_W.x(), rock.center_W.y()), 0.1, 1e-12);
    EXPECT_NEAR(rock.center_W.x() - 0.5 * rock.diameter_m, 0.0, 1e-12);
    EXPECT_EQ(rock.center_W.y(), 0.05);
    if (proportions == RockProportions::kListed) {
      EXPECT_EQ(rock.diameter_m, 0.3);
    }
  }
}

TEST(RockSceneTest, TheFrontStandsTheGapBeforeZero) {
  const double heading_rad = 0.2;
  const math::Transform X_WR = PoseBefore(0.25, heading_rad, 0.325);
  const math::Vector3 front_W = X_WR * math::Vector3(0.325, 0.0, 0.0);
  EXPECT_NEAR(front_W.x(), -0.25, 1e-12);
  // Straight on, the front passes the origin.
  EXPECT_NEAR(front_W.y() + 0.25 * std::tan(heading_rad), 0.0, 1e-12);
}

// Uniform rounding of a column: the error's root mean square is one pixel's range over the root of
// 12. One pixel's range is pitch r^2 / baseline within the obliqueness of the fans.
TEST(HazardPrecisionTest, RangeErrorsAreThoseOfRoundedColumns) {
  const auto experiment = MakeExperiment(HazardScenario(
      "precision",
      {"hazard_detection.baselines_m=[0.05, 0.12]", "hazard_detection.rows=[0, 3]",
       "hazard_detection.plane_heights_m=[0]", "hazard_detection.scenes_per_run=2000"}));
  const truth::RecordSchema& schema = experiment->schema();
  for (std::uint64_t cell = 0; cell < 4; ++cell) {
    const truth::Record record = experiment->Run(1, cell);
    const double found = ValueOf(schema, record, "found");
    EXPECT_EQ(found, ValueOf(schema, record, "points"));
    const double rms = std::sqrt(ValueOf(schema, record, "range_error_m") / found);
    const double step = ValueOf(schema, record, "range_step_m") / found;
    EXPECT_NEAR(rms * std::sqrt(12.0) / step, 1.0, 0.05) << "cell " << cell;
    const double bias = ValueOf(schema, record, "range_bias_m") / found;
    EXPECT_LT(std::abs(bias), 0.05 * step) << "cell " << cell;
    EXPECT_GT(step, 0.0);
  }
}

// Range that one column stands for, brought to 0.3 m: in the triangle of camera, emitter and lit
// point a turn dt of the camera's ray moves the point along the light by r dt / sin g, of which
// dr = r dt / tan g lies along the ray, g the angle at the point. With a column of `pitch`,
// (0.3 m / r)^2 dr = pitch (0.3 m)^2 / (r tan g); for light square to the baseline B that is
// equation 2's pitch (0.3 m)^2 / B. Positions follow from the layout alone.
double ColumnAt30Centimetres(const sensing::LightStripeParams& params, std::size_t row,
                             std::size_t stripe, double ground_z_m, double pitch_rad) {
  const messages::StripeCalibration layout = sensing::TrueCalibration(params);
  const messages::StripeLaser& laser = layout.lasers[stripe];
  const math::Vector3 camera =
      layout.cameras[static_cast<std::size_t>(laser.camera)].X_RC.translation();
  const double depression_rad =
      params.camera_pitch_rad + layout.scanline_px[row] * params.row_pitch_rad();
  math::Vector3 point(camera.x() + (camera.z() - ground_z_m) / std::tan(depression_rad), 0.0,
                      ground_z_m);
  point.y() =
      laser.p_RoE_R.y() - laser.normal_R.x() / laser.normal_R.y() * (point.x() - laser.p_RoE_R.x());
  const math::Vector3 to_camera = camera - point;
  const math::Vector3 to_emitter = laser.p_RoE_R - point;
  const double tan_apex = to_camera.cross(to_emitter).norm() / to_camera.dot(to_emitter);
  return pitch_rad * 0.09 / (to_camera.norm() * tan_apex);
}

// Mean over the stripes but the centre one and over ground at -w / 2 to w / 2.
double MeanColumnAt30Centimetres(sensing::LightStripeParams params, std::size_t row,
                                 double baseline_m, double width_m, double pitch_rad) {
  params.inner_emitter_y_m = 0.5 * params.camera_separation_m + baseline_m;
  params.outer_emitter_y_m = params.inner_emitter_y_m;
  constexpr int kHeights = 200;
  double sum_m = 0.0;
  for (int i = 0; i < kHeights; ++i) {
    const double ground_z_m = width_m * ((i + 0.5) / kHeights - 0.5);
    for (const std::size_t stripe : {0u, 1u, 3u, 4u}) {
      sum_m += ColumnAt30Centimetres(params, row, stripe, ground_z_m, pitch_rad);
    }
  }
  return sum_m / (4.0 * kHeights);
}

// Measured errors of 2000 scans against the closed form. Four times the magnitude of a rounding
// error has mean 1 and deviation 0.58 columns; stripes on both sides mirror each other, so that
// 4000 are independent and 3.9 standard errors (1e-4 two-sided) are 0.036. A plane over 19 columns
// or more leaves parts of two columns that hold up to 1/8 column too much each: 0.013.
TEST(HazardPrecisionTest, ResolutionAtThirtyCentimetres) {
  constexpr double kBound = 0.05;
  const double width_m = 0.1;
  const double pitch_rad = 0.0089 / 768.0 / 0.004;  // table 3: 2.897 mrad
  const double baselines_m[] = {0.05, 0.1, 0.12};
  const std::size_t rows[] = {0, 3};
  const std::vector<std::string> cells{
      "hazard_detection.baselines_m=[0.05, 0.1, 0.12]", "hazard_detection.rows=[0, 3]",
      "hazard_detection.plane_heights_m=[0]", "hazard_detection.plane_width_m=0.1",
      "hazard_detection.scenes_per_run=2000"};
  const scenario::Scenario table_3 = HazardScenario("precision", cells);
  const scenario::Scenario rocky =
      HazardScenario("precision", With(cells, {"sensors.light_stripe.focal_length_m=0.0048"}));
  for (std::uint64_t cell = 0; cell < 6; ++cell) {
    const auto ratio = [&](const scenario::Scenario& scenario) {
      const double expected_m =
          MeanColumnAt30Centimetres(scenario.drive.sensors.light_stripe, rows[cell % 2],
                                    baselines_m[cell / 2], width_m, pitch_rad);
      return Count(scenario, "resolution_30cm_m", cell) / Count(scenario, "found", cell) /
             expected_m;
    };
    EXPECT_NEAR(ratio(table_3), 1.0, kBound) << "cell " << cell;
    // Negative control: with Rocky's 4.8 mm lens the same scans show columns of 4 / 4.8 of it.
    EXPECT_NEAR(ratio(rocky), 4.0 / 4.8, kBound) << "cell " << cell;
    EXPECT_LT(ratio(rocky), 1.0 - kBound) << "cell " << cell;
  }
}

}  // namespace
}  // namespace rockyard::experiments
