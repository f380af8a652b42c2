#include "experiments/three_rock_run/three_rock_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/json_file.h"
#include "core/json_value.h"
#include "core/refusals.h"
#include "experiments/drive/drive_experiment.h"
#include "experiments/hazard_scenarios.h"
#include "experiments/scenario_experiment.h"
#include "experiments/three_rock_traces.h"
#include "math/angles.h"
#include "scenario/shipped.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

constexpr core::TrialKey kKey{3, 7};

scenario::Scenario ThreeRocks(const std::vector<std::string>& overrides = {}) {
  return scenario::Shipped("localization/three_rock_run", overrides);
}

TEST(RockLayoutTest, PlacesTheFirstRockBeforeTheRoversFront) {
  // The near end is 0.1 m before a front that is 0.3 m before the centre at 2.6 m.
  const PlacedRock rock = PlaceFirstRock({0.1, -0.2, 0.4, 0.3}, 2.6, 0.3);
  EXPECT_NEAR(rock.x_m - 0.5 * rock.diameter_m, 3.0, 1e-12);
  EXPECT_EQ(rock.y_m, -0.2);
  EXPECT_EQ(rock.height_m, 0.3);
}

TEST(RockLayoutTest, PlacesRocksToTheLeftOfTheWay) {
  TraceByHand drive;
  drive.Drive(1.0).Turn(90.0).Drive(2.0);
  const RunHistory history(drive.trace(), {}, {}, {});
  const auto rock = PlaceOnPath({0.0, 0.3, 0.2, 0.1}, 2.0, history);
  ASSERT_TRUE(rock.has_value());
  // A metre up along y, where left is -x.
  EXPECT_NEAR(rock->x_m, 0.7, 1e-9);
  EXPECT_NEAR(rock->y_m, 1.0, 1e-9);
  EXPECT_FALSE(PlaceOnPath({}, 3.1, history).has_value());
}

TEST(RockLayoutTest, DrawsUniformlyFromTheRangesOfThePrior) {
  const RockPrior prior{{1.0, 2.0}, {-0.5, 0.5}, {0.1, 0.3}, {0.2, 0.6}};
  constexpr int kDraws = 2000;
  std::vector<double> along_m;
  for (int i = 0; i < kDraws; ++i) {
    core::RandomStream stream = StreamOf(DrawnPart::kSecondRock, i, kKey);
    const DrawnRock rock = DrawRock(prior, stream);
    along_m.push_back(rock.along_m);
    EXPECT_TRUE(rock.along_m > 1.0 && rock.along_m < 2.0);
    EXPECT_LT(std::abs(rock.offset_m), 0.5);
    EXPECT_TRUE(rock.height_m > 0.1 && rock.height_m < 0.3);
    EXPECT_TRUE(rock.diameter_m > 0.2 && rock.diameter_m < 0.6);
  }
  // Kolmogorov and Smirnov at alpha 1e-3: 1.95 / sqrt(n).
  std::sort(along_m.begin(), along_m.end());
  const auto distance_from = [&](double low) {
    double largest = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const double law = (along_m[static_cast<std::size_t>(i)] - low) / (2.0 - low);
      largest = std::max(largest, std::abs((i + 0.5) / kDraws - law));
    }
    return largest;
  };
  const double critical = 1.95 / std::sqrt(static_cast<double>(kDraws));
  EXPECT_LT(distance_from(1.0), critical);
  EXPECT_GT(distance_from(0.9), critical);  // another law is told apart
}

TEST(RockLayoutTest, EveryTryHasAStreamOfItsOwn) {
  std::set<double> first{StreamOf(DrawnPart::kStart, 0, kKey).Uniform()};
  for (int i = 0; i < 50; ++i) {
    first.insert(StreamOf(DrawnPart::kSecondRock, i, kKey).Uniform());
    first.insert(StreamOf(DrawnPart::kThirdRock, i, kKey).Uniform());
  }
  EXPECT_EQ(first.size(), 101U);
}

TEST(ThreeRockParamsTest, RefuseARangeThatEndsBelowItsStart) {
  EXPECT_THAT(core::RefusalOf([] { ThreeRocks({"three_rock_run.prior.b.height_m=[0.2, 0.1]"}); }),
              testing::HasSubstr("three_rock_run.prior.b.height_m"));
}

TEST(ThreeRockParamsTest, RefuseADriveThatIsNotThePublishedOne) {
  for (const std::string change :
       {"terrain.rocks.kind=moore", "terrain.arena.kind=virtual_reflected", "course.start_x_m=1",
        "course.goal_y_m=1", "terrain.ground.slope_deg=3", "three_rock_run.prior.goal_m=[7, 40]",
        "terrain.rocks.mobility=movable", "navigation.navigator=gestalt",
        "sensors.terrain_sensor=stereo"}) {
    EXPECT_THROW(ThreeRocks({change}), core::UserError) << change;
  }
  EXPECT_NO_THROW(ThreeRocks({"three_rock_run.prior.goal_m=[7, 12]"}));
}

// Rows that compute take the program's own constants, and every row is of columns that there are.
TEST(ThreeRockReferenceTest, RowsAndScenarioAgree) {
  const scenario::Scenario scenario = ThreeRocks();
  const core::JsonValue reference =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/results/reference/matthies1995_rocks.json");
  const sensing::GyroParams& gyro = scenario.drive.sensors.gyro;
  int rows = 0;
  for (const core::JsonValue& row : reference.Find("values")->list()) {
    if (row.Find("scenario")->text() != "three_rock_run") continue;
    ++rows;
    const std::string& id = row.Find("id")->text();
    if (id == "turning.underestimated") {
      EXPECT_EQ(row.Find("inputs")->list().at(1).number(), -gyro.scale);
    } else if (id == "scrape.jump") {
      EXPECT_NEAR(row.Find("inputs")->list().at(1).number(), math::RadToDeg(gyro.scrape.jump_rad),
                  1e-12);
    } else {
      for (const char* key : {"column", "of"}) {
        EXPECT_NE(truth::FindColumn(ThreeRockColumns(), row.Find(key)->text()), nullptr) << id;
      }
    }
    if (id == "three_rocks.length") {
      EXPECT_EQ(row.Find("value")->number(),
                scenario.experiment.params<ThreeRockRunParams>().told.length_m);
    }
  }
  EXPECT_EQ(rows, 10);
}

TEST(ThreeRockRunTest, StopsWhereADriveDoesNotGoAsTold) {
  const auto experiment = MakeExperiment(
      ThreeRocks({"three_rock_run.told.a_path_m=2.6", "three_rock_run.told.a_path_tolerance_m=0"}));
  const truth::Record record = experiment->Run(1, 0);
  ASSERT_EQ(record.outcome, truth::TrialOutcome::kMeasured) << record.detail;
  const auto value = [&](const std::string& name) {
    return ValueOf(experiment->schema(), record, name);
  };
  EXPECT_EQ(value("runs"), 1.0);
  EXPECT_EQ(value("a_turned"), 1.0);
  EXPECT_EQ(value("a_as_told"), 0.0);
  EXPECT_EQ(value("b_tries"), 0.0);
  EXPECT_TRUE(std::isnan(value("b_x_m")));
  EXPECT_FALSE(std::isnan(value("a_x_m")));
}

// The few tries make a run short; conditions that hold anyhow let it be accepted.
const std::vector<std::string> kEasy{"three_rock_run.prior.tries=400",
                                     "three_rock_run.told.length_tolerance_m=2",
                                     "three_rock_run.told.c_turn_tolerance_deg=180"};

TEST(ThreeRockRunTest, TheLastDriveIsAPlainDriveAmongAllThreeRocks) {
  const scenario::Scenario scenario = ThreeRocks(kEasy);
  const auto experiment = MakeExperiment(scenario);
  truth::Record record;
  std::uint64_t index = 0;
  const auto value = [&](const std::string& name) {
    return ValueOf(experiment->schema(), record, name);
  };
  do {
    ASSERT_LT(index, 8U) << "no run is accepted";
    record = experiment->Run(1, index++);
    ASSERT_EQ(record.outcome, truth::TrialOutcome::kMeasured) << record.detail;
  } while (value("accepted") == 0.0);
  EXPECT_EQ(record.values[0], 0.0);
  EXPECT_GE(value("b_scrapes"), 1.0);
  EXPECT_GE(value("c_scrapes"), 1.0);
  EXPECT_EQ(value("heading_below"), value("heading_error_deg") < 15.3 ? 1.0 : 0.0);
  EXPECT_EQ(value("position_below"), value("position_error_m") < 1.0 ? 1.0 : 0.0);
  EXPECT_EQ(value("at_c_below"), value("at_c_deg") < 10.0 ? 1.0 : 0.0);

  trial::DriveParams drive = scenario.drive;
  drive.course.goal_x_m = value("goal_m");
  drive.terrain.rocks.kind = terrain::RockFieldKind::kListed;
  for (const std::string rock : {"a", "b", "c"}) {
    drive.terrain.rocks.listed.x_m.push_back(value(rock + "_x_m"));
    drive.terrain.rocks.listed.y_m.push_back(value(rock + "_y_m"));
    drive.terrain.rocks.listed.diameter_m.push_back(value(rock + "_diameter_m"));
    drive.terrain.rocks.listed.height_m.push_back(value(rock + "_height_m"));
  }
  const DriveExperiment plain(drive);
  const truth::Record driven = plain.Run(1, index - 1);
  const auto of_drive = [&](const std::string& name) {
    return ValueOf(plain.schema(), driven, name);
  };
  EXPECT_EQ(value("heading_error_deg"), of_drive("heading_error_deg"));
  EXPECT_NEAR(std::abs(value("final_deg")), of_drive("heading_error_deg"), 1e-6);
  EXPECT_EQ(value("position_error_m"), of_drive("position_error_m"));
  EXPECT_EQ(value("length_m"), of_drive("true_distance_m"));
  EXPECT_EQ(value("b_scrapes") + value("c_scrapes"), of_drive("scrapes"));
  // Whatever ran before, on another experiment, the same bits.
  EXPECT_EQ(MakeExperiment(scenario)->Run(1, index - 1).values[20], record.values[20]);
}

}  // namespace
}  // namespace rockyard::experiments
