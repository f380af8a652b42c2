#include "experiments/dead_reckoning/dead_reckoning.h"

#include <gmock/gmock.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "core/refusals.h"
#include "experiments/dead_reckoning/dead_reckoning_walk_params.h"
#include "experiments/hazard_scenarios.h"
#include "scenario/load.h"
#include "statistics/closed_forms.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using statistics::DriftMoments;
using statistics::ExactMoments;
using statistics::StraightDrift;
using testing::HasSubstr;

const std::string kFolder = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/localization";

scenario::Scenario SandScenario(const std::vector<std::string>& overrides) {
  return scenario::LoadScenario(kFolder + "/straight_sand.json", overrides);
}

std::string ProblemsWith(const std::vector<std::string>& overrides) {
  return core::RefusalOf([&] { SandScenario(overrides); });
}

TEST(DeadReckoningParamsTest, BadScenariosSayWhatIsWrong) {
  EXPECT_EQ(ProblemsWith({}), "");
  EXPECT_THAT(ProblemsWith({"dead_reckoning.distances_m=[]"}), HasSubstr("list of cells is empty"));
  EXPECT_THAT(ProblemsWith({"dead_reckoning.rests_s=[]"}), HasSubstr("list of cells is empty"));
  EXPECT_THAT(ProblemsWith({"dead_reckoning.distances_m=[5, 0.06]"}),
              HasSubstr("shorter than step_m"));
  EXPECT_EQ(ProblemsWith({"dead_reckoning.distances_m=[5, 0.06]", "dead_reckoning.step_m=0.06"}),
            "");
  EXPECT_THAT(ProblemsWith({"dead_reckoning.walks_per_run=1"}), HasSubstr("walks_per_run"));
  EXPECT_THAT(ProblemsWith({"dead_reckoning.heading_variances_deg2_per_m=[-1]"}),
              HasSubstr("heading_variances_deg2_per_m"));
  EXPECT_THAT(ProblemsWith({"localization.estimator=oracle"}),
              HasSubstr("the experiment dead_reckoning measures (use dead_reckoning"));
  std::string many = "[0";
  for (int i = 0; i < 61; ++i) many += ", 0";
  EXPECT_THAT(ProblemsWith({"dead_reckoning.rests_s=" + many + "]"}),
              HasSubstr("more than 2000 cells"));
}

TEST(DeadReckoningParamsTest, ShippedTablesHaveWholeRounds) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
    if (file.path().extension() != ".json") continue;
    const scenario::Scenario scenario = scenario::LoadScenario(file.path().string());
    if (scenario.experiment.chosen().name() != "dead_reckoning") continue;
    ++files;
    const auto cells =
        static_cast<std::int64_t>(scenario.experiment.params<DeadReckoningWalkParams>().Cells());
    EXPECT_EQ(scenario.trials % cells, 0) << file.path() << ": every cell gets as many runs";
    // The printed equations.
    EXPECT_EQ(scenario.drive.perception.dead_reckoning.step_heading,
              localization::StepHeading::kStart);
    EXPECT_EQ(scenario.experiment.params<DeadReckoningWalkParams>().step_m, 0.067);
  }
  EXPECT_GE(files, 3U);
}

TEST(DeadReckoningTest, RunsGoRoundTheCellsAndNameTheirFactors) {
  const auto experiment = MakeExperiment(SandScenario(
      {"dead_reckoning.distances_m=[1, 2]", "dead_reckoning.heading_variances_deg2_per_m=[3, 4]",
       "dead_reckoning.distance_variances_m2_per_m=[0.005]",
       "dead_reckoning.scale_deviations=[0.06]", "dead_reckoning.rests_s=[7, 8]",
       "dead_reckoning.walks_per_run=4"}));
  const truth::RecordSchema& schema = experiment->schema();
  EXPECT_TRUE(truth::IsMeasurement(schema));
  for (std::uint64_t run = 0; run < 10; ++run) {
    const truth::Record record = Measure(*experiment, 1, run);
    ASSERT_EQ(record.values.size(), schema.size());
    const auto cell = static_cast<double>(run % 8);
    EXPECT_EQ(record.values[0], cell);
    EXPECT_EQ(ValueOf(schema, record, "rest_s"), 7.0 + std::fmod(cell, 2.0));
    EXPECT_EQ(ValueOf(schema, record, "scale_deviation"), 0.06);
    EXPECT_EQ(ValueOf(schema, record, "distance_variance_m2_per_m"), 0.005);
    EXPECT_EQ(ValueOf(schema, record, "heading_variance_deg2_per_m"),
              3.0 + std::fmod(std::floor(cell / 2.0), 2.0));
    const double distance_m = 1.0 + std::floor(cell / 4.0);
    EXPECT_EQ(ValueOf(schema, record, "distance_m"), distance_m);
    EXPECT_EQ(ValueOf(schema, record, "walks"), 4.0);
    EXPECT_NEAR(ValueOf(schema, record, "way_m"), 4.0 * 0.067 * std::round(distance_m / 0.067),
                1e-12);
  }
}

TEST(DeadReckoningTest, ARunIsAFunctionOfSeedAndIndexAlone) {
  const auto experiment = MakeExperiment(SandScenario({"dead_reckoning.walks_per_run=2"}));
  const truth::Record first = experiment->Run(1, 5);
  experiment->Run(1, 6);
  EXPECT_EQ(experiment->Run(1, 5).values, first.values);
  EXPECT_NE(experiment->Run(2, 5).values, first.values);
  EXPECT_NE(experiment->Run(1, 5 + 33).values, first.values);
  EXPECT_EQ(experiment->Run(1, 5000000000u).outcome, truth::TrialOutcome::kSimulatorFault);
}

// One statistic of the end of a walk, a value a run.
struct Statistic {
  const char* name;
  double (*of_run)(const truth::RecordSchema&, const truth::Record&);
  double expected;
};

double PerWalk(const truth::RecordSchema& schema, const truth::Record& record,
               const std::string& name) {
  return ValueOf(schema, record, name) / ValueOf(schema, record, "walks");
}

std::vector<Statistic> Expected(const StraightDrift& drift) {
  const DriftMoments moments = ExactMoments(drift);
  // Squared deviations of a run's walks are unbiased; deviations themselves are not.
  return {
      {"along bias", [](const auto& s, const auto& r) { return PerWalk(s, r, "along_bias_m"); },
       moments.along_bias_m},
      {"across bias", [](const auto& s, const auto& r) { return PerWalk(s, r, "across_bias_m"); },
       0.0},
      {"along variance",
       [](const auto& s, const auto& r) { return std::pow(PerWalk(s, r, "along_deviation_m"), 2); },
       std::pow(moments.along_m, 2)},
      {"across variance",
       [](const auto& s, const auto& r) {
         return std::pow(PerWalk(s, r, "across_deviation_m"), 2);
       },
       std::pow(moments.across_m, 2)},
      {"across squares",
       [](const auto& s, const auto& r) { return PerWalk(s, r, "across_error_m"); },
       std::pow(moments.across_m, 2)},
      {"heading growth",
       [](const auto& s, const auto& r) {
         return ValueOf(s, r, "heading_error_deg") / ValueOf(s, r, "way_m");
       },
       drift.heading_variance_deg2_per_m}};
}

// How many statistics of `runs` runs differ from the closed forms, Student's t over the runs. All
// tests of this file together raise a false alarm with a chance of 1e-3 (Bonferroni over 60).
int Differences(const std::vector<std::string>& overrides, const StraightDrift& drift,
                std::uint64_t runs = 30) {
  constexpr double kAlpha = 1e-3 / 60.0;
  const auto experiment =
      MakeExperiment(SandScenario(With({"dead_reckoning.walks_per_run=500"}, overrides)));
  std::vector<truth::Record> records;
  for (std::uint64_t run = 0; run < runs; ++run) records.push_back(experiment->Run(24, run));
  const auto n = static_cast<double>(runs);
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - 0.5 * kAlpha);
  int differences = 0;
  for (const Statistic& statistic : Expected(drift)) {
    double sum = 0.0, squares = 0.0;
    for (const truth::Record& record : records) {
      const double value = statistic.of_run(experiment->schema(), record);
      sum += value;
      squares += value * value;
    }
    const double mean = sum / n;
    const double error = std::sqrt((squares / n - mean * mean) / (n - 1.0));
    if (std::abs(mean - statistic.expected) > t * error + 1e-12) {
      ++differences;
      std::cout << statistic.name << ": " << mean << " +- " << error << ", expected "
                << statistic.expected << "\n";
    }
  }
  return differences;
}

std::vector<std::string> Cell(double distance_m, double heading_deg2_per_m) {
  return {
      "dead_reckoning.distances_m=[" + std::to_string(distance_m) + "]",
      "dead_reckoning.heading_variances_deg2_per_m=[" + std::to_string(heading_deg2_per_m) + "]"};
}

TEST(DeadReckoningTest, AgreesWithTheExactMoments) {
  for (const double heading_deg2_per_m : {0.70, 16.0}) {
    for (const double distance_m : {1.0, 10.0}) {
      const StraightDrift drift{0.067, distance_m, 0.0039, heading_deg2_per_m, 0.0};
      EXPECT_EQ(Differences(Cell(distance_m, heading_deg2_per_m), drift), 0)
          << distance_m << " m, " << heading_deg2_per_m << " deg2/m";
    }
  }
  EXPECT_EQ(Differences(With(Cell(7.0, 0.70), {"dead_reckoning.distance_variances_m2_per_m=[0]",
                                               "dead_reckoning.scale_deviations=[0.0236]"}),
                        {0.067, 7.0, 0.0, 0.70, 0.0236}),
            0);
}

// Noise in time: 20 s at rest for the 10 s of a step at 0.67 cm/s, three times 16 deg2/m.
TEST(DeadReckoningTest, NoiseAtRestCountsByItsTime) {
  const std::vector<std::string> resting =
      With(Cell(5.0, 16.0), {"dead_reckoning.speed_m_s=0.0067", "dead_reckoning.rests_s=[20]"});
  EXPECT_EQ(Differences(resting, {0.067, 5.0, 0.0039, 48.0, 0.0}), 0);
  EXPECT_GT(Differences(resting, {0.067, 5.0, 0.0039, 16.0, 0.0}), 0);  // negative control
}

// Negative controls: what a wrong walk looks like. Over 1 m an order of half a step is 10 %.
TEST(DeadReckoningTest, AWrongWalkIsSeen) {
  const StraightDrift right{0.067, 1.0, 0.0039, 16.0, 0.0};
  EXPECT_EQ(Differences(Cell(1.0, 16.0), right), 0);
  EXPECT_GT(Differences(With(Cell(1.0, 16.0), {"perception.dead_reckoning.step_heading=midpoint"}),
                        right),
            0);
  EXPECT_GT(Differences(With(Cell(1.0, 16.0), {"dead_reckoning.step_m=0.2"}), right), 0);
  EXPECT_GT(Differences(Cell(1.0, 16.0), {0.067, 1.0, 0.0039, 1.1 * 16.0, 0.0}), 0);
  EXPECT_GT(Differences(Cell(1.0, 16.0), {0.067, 1.0, 1.1 * 0.0039, 16.0, 0.0}), 0);
  EXPECT_GT(Differences(Cell(10.0, 16.0), {0.067, 10.0, 0.0039, 0.9 * 16.0, 0.0}), 0);
}

// Errors of calibration are those of the drive's.
TEST(DeadReckoningTest, WheelsBelievedTooLargeReadTooLong) {
  const std::vector<std::string> quiet{"dead_reckoning.distances_m=[6.7]",
                                       "dead_reckoning.heading_variances_deg2_per_m=[0]",
                                       "dead_reckoning.distance_variances_m2_per_m=[0]"};
  const auto bias_m = [&](const std::vector<std::string>& overrides) {
    return Count(SandScenario(With(quiet, overrides)), "distance_bias_m") / 1000.0;
  };
  EXPECT_NEAR(bias_m({}), 0.0, 1e-9);
  EXPECT_NEAR(bias_m({"perception.calibration.drive.wheel_radius_percent=2"}), 0.134, 1e-9);
}

// An odometer does not mind where it goes: of its own the distance's noise alone, an equal amount
// whatever the heading's.
TEST(DeadReckoningTest, TheOdometerCountsTheWayNotThePlace) {
  const auto column = [](const std::string& name, const std::string& variance_m2_per_m) {
    return Count(SandScenario(With(
                     Cell(10.0, 400.0),
                     {"dead_reckoning.distance_variances_m2_per_m=[" + variance_m2_per_m + "]"})),
                 name) /
           1000.0;
  };
  EXPECT_NEAR(column("distance_error_m", "0"), 0.0, 1e-18);
  EXPECT_LT(column("along_bias_m", "0"), -1.0);
  // alpha = 1e-4: 3.9 deviations of the variance of 1000 normal errors.
  EXPECT_NEAR(column("distance_error_m", "0.0039") / (0.0039 * 149 * 0.067), 1.0,
              3.9 * std::sqrt(2.0 / 1000.0));
}

TEST(DeadReckoningTest, CountsWalksWithinReach) {
  const auto within = [](double reach_m) {
    return Count(
        SandScenario(With(Cell(10.0, 0.7), {"dead_reckoning.reach_m=" + std::to_string(reach_m)})),
        "within_reach");
  };
  EXPECT_EQ(within(0.0), 0.0);
  EXPECT_EQ(within(10.0), 1000.0);
  // Sides of 0.197 and 0.264 m, hardly correlated: two normals by a sum over one of them.
  const double reach_m = 0.24;
  double chance = 0.0;
  const double step_m = 1e-4;
  for (double x_m = -reach_m + 0.5 * step_m; x_m < reach_m; x_m += step_m) {
    const double y_m = std::sqrt(reach_m * reach_m - x_m * x_m);
    chance += step_m * std::exp(-0.5 * std::pow(x_m / 0.1972, 2)) /
              (0.1972 * std::sqrt(2.0 * M_PI)) * std::erf(y_m / (0.2641 * std::sqrt(2.0)));
  }
  // alpha = 1e-4: 3.9 deviations; the bias of 5 mm along is far below.
  EXPECT_NEAR(within(reach_m), 1000.0 * chance, 3.9 * std::sqrt(1000.0 * chance * (1.0 - chance)));
  EXPECT_GT(std::abs(within(0.30) - 1000.0 * chance),
            3.9 * std::sqrt(1000.0 * chance * (1.0 - chance)));  // negative control
}

}  // namespace
}  // namespace rockyard::experiments
