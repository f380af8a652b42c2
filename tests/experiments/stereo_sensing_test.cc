#include "experiments/stereo_sensing/stereo_sensing.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/refusals.h"
#include "experiments/look_factors.h"
#include "experiments/stereo_scenarios.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using testing::HasSubstr;

const std::string kFolder = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/stereo_sensing";

std::string ProblemsWith(const std::vector<std::string>& overrides) {
  return core::RefusalOf([&] { StereoScenario("range", overrides); });
}

TEST(StereoSensingParamsTest, BadScenariosSayWhatIsWrong) {
  EXPECT_EQ(ProblemsWith({}), "");
  EXPECT_THAT(ProblemsWith({"stereo_sensing.distances_m=[1]"}), HasSubstr("fewer than two edges"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.distances_m=[]"}), HasSubstr("fewer than two edges"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.distances_m=[1, 2, 2]"}), HasSubstr("does not ascend"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.distances_m=[1, 5]"}),
              HasSubstr("beyond sensors.stereo.max_range_m"));
  EXPECT_EQ(ProblemsWith({"stereo_sensing.distances_m=[1, 5]", "sensors.stereo.max_range_m=5"}),
            "");
  EXPECT_THAT(ProblemsWith({"sensors.stereo.fidelity=ideal"}), HasSubstr("no errors to measure"));
  EXPECT_THAT(ProblemsWith({"sensors.stereo.field_of_view=stripe"}), HasSubstr("every pixel"));
  EXPECT_THAT(ProblemsWith({"sensors.terrain_sensor=light_stripe"}),
              HasSubstr("the experiment stereo_sensing measures (use stereo"));
  EXPECT_THAT(ProblemsWith({"navigation.navigator=pathfinder"}), HasSubstr("use gestalt"));
  EXPECT_THAT(ProblemsWith({"terrain.ground.slope_deg=5"}), HasSubstr("level ground"));
  EXPECT_THAT(ProblemsWith({"terrain.rocks.pointedness=0.5"}), HasSubstr("ellipsoids only"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.baselines_m=[0.12, 1.9]"}),
              HasSubstr("with which sensors.stereo cannot work"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.soil_graininess=[0, 1.1]"}),
              HasSubstr("stereo_sensing.soil_graininess"));
  EXPECT_THAT(ProblemsWith({"stereo_sensing.sun_elevations_deg=[91]"}),
              HasSubstr("stereo_sensing.sun_elevations_deg"));
  std::string many = "[0.1";
  for (int i = 0; i < 300; ++i) many += ", 0.1";
  EXPECT_THAT(ProblemsWith({"stereo_sensing.soil_graininess=" + many + "]"}),
              HasSubstr("more than 2000 cells"));
}

TEST(StereoSensingParamsTest, ShippedTablesHaveWholeRounds) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
    if (file.path().extension() != ".json") continue;
    ++files;
    const scenario::Scenario scenario = StereoScenario(file.path().stem().string());
    EXPECT_EQ(scenario.experiment.chosen().name(), "stereo_sensing") << file.path();
    const auto cells =
        static_cast<std::int64_t>(scenario.experiment.params<StereoSensingParams>().Cells());
    EXPECT_LE(cells, 100) << file.path();
    EXPECT_EQ(scenario.trials % cells, 0) << file.path() << ": every cell gets as many runs";
    EXPECT_EQ(scenario.drive.sensors.stereo.fidelity, sensing::StereoFidelity::kImage);
  }
  EXPECT_GE(files, 4U);
}

// Over the first runs of a sensor that errs in what the overrides say, and in nothing else.
StereoCounts CountsOf(const std::vector<std::string>& overrides, std::uint64_t runs) {
  return {StereoScenario("range", With(kWithoutErrors, overrides)), runs};
}

TEST(StereoSensingTest, RunsGoRoundTheCellsAndNameTheirFactors) {
  const auto experiment = MakeExperiment(StereoScenario(
      "range",
      With(kWithoutErrors,
           {"stereo_sensing.distances_m=[0.5, 1, 4]", "stereo_sensing.soil_graininess=[0, 1]",
            "stereo_sensing.sun_elevations_deg=[20, 60]", "stereo_sensing.baselines_m=[0.06, 0.12]",
            "sensors.stereo.columns=32", "sensors.stereo.rows=32"})));
  const truth::RecordSchema& schema = experiment->schema();
  EXPECT_TRUE(truth::IsMeasurement(schema));
  std::set<std::vector<double>> met;
  for (std::uint64_t run = 0; run < 16; ++run) {
    const truth::Record record = Measure(*experiment, 1, run);
    EXPECT_EQ(record.values.front(), static_cast<double>(run));
    ASSERT_EQ(record.values.size(), schema.size());
    std::vector<double> factors;
    for (const char* name : {"soil_graininess", "sun_elevation_deg", "baseline_m", "nearest_m"}) {
      factors.push_back(ValueOf(schema, record, name));
    }
    EXPECT_EQ(ValueOf(schema, record, "farthest_m"), factors.back() == 0.5 ? 1.0 : 4.0);
    met.insert(factors);
  }
  EXPECT_EQ(met.size(), 16U);
  EXPECT_EQ(experiment->Run(1, 16).values.front(), 0.0);
}

TEST(StereoSensingTest, WithoutErrorsEveryPixelIsMatchedAsItIs) {
  const StereoCounts counts = CountsOf({}, 4);
  EXPECT_EQ(counts["looks"], 4.0);
  EXPECT_GT(counts["pixels"], 4.0 * 3000.0);
  EXPECT_EQ(counts["good"], counts["pixels"]);
  EXPECT_EQ(counts["wrong"], 0.0);
  EXPECT_NEAR(counts["error_px"], 0.0, 1e-18 * counts["pixels"]);
  EXPECT_NEAR(counts["range_error_m"], 0.0, 1e-18 * counts["pixels"]);
  EXPECT_EQ(counts["plain_pixels"] + counts["front_pixels"] + counts["behind_pixels"] +
                counts["shadow_pixels"],
            counts["pixels"]);
  EXPECT_GT(counts["front_pixels"], 100.0);
  EXPECT_GT(counts["behind_pixels"], 100.0);
  EXPECT_GT(counts["shadow_pixels"], 100.0);
  EXPECT_GT(counts["hidden_pixels"], 100.0);
  EXPECT_EQ(counts["hidden_matched"], 0.0);
  EXPECT_EQ(counts["margin_matched"], counts["margin_pixels"]);
  // GESTALT makes the same of both clouds.
  EXPECT_GT(counts["clear_cells"], 100.0);
  EXPECT_EQ(counts["clear_known"], counts["clear_cells"]);
  EXPECT_EQ(counts["imagined"], 0.0);
  EXPECT_EQ(counts["hazard_found"], counts["hazard_cells"]);
  for (const char* height : {"05", "10", "15", "20"}) {
    EXPECT_EQ(counts[std::string("found_") + height], counts[std::string("perfect_") + height]);
  }
}

// sigma comes back, and r Z sigma / (f B) with it. Errors of neighbours are those of windows of 5:
// 1 - k / 5.
TEST(StereoSensingTest, GivesBackTheNoiseOfTheErrorModel) {
  const StereoCounts counts =
      CountsOf({"sensors.stereo.disparity_noise_px=0.1", "sensors.stereo.noise_window_px=5"}, 12);
  // 12 looks of some 7000 pixels, of which 25 count as one: the deviation of a variance is
  // sqrt(2 / 3400) = 2.4 %, and more by overlapping windows; alpha = 1e-4 is 3.9 of 3.5 %.
  const double variance = counts["error_px"] / counts["good"];
  EXPECT_GT(counts["good"], 12.0 * 5000.0);
  EXPECT_NEAR(variance / 0.01, 1.0, 0.14);
  EXPECT_GT(std::abs(variance / 0.0144 - 1.0), 0.14);  // negative control: 0.12 px
  const double range2_m2 = counts["range_error_m"] / counts["good"];
  const double predicted_m2 = variance * counts["range_step_m"] / counts["good"];
  // Errors of 0.1 px at disparities from 1.4 px on add some per cent by their second order.
  EXPECT_NEAR(range2_m2 / predicted_m2, 1.0, 0.08);
  for (int lag = 1; lag <= 7; ++lag) {
    const std::string name = std::to_string(lag);
    const double correlation = counts["product_px2_" + name] / counts["pairs_" + name] / variance;
    EXPECT_NEAR(correlation, std::max(1.0 - lag / 5.0, 0.0), 0.08) << lag;
  }
}

TEST(StereoSensingTest, GivesBackDropoutsByTheirPlace) {
  const StereoCounts counts = CountsOf(
      {"sensors.stereo.dropout_probability=0.1", "sensors.stereo.edge_dropout_probability=0.5",
       "sensors.stereo.shadow_dropout_probability=0.4", "sensors.stereo.margin_px=3",
       // The end of the range is a jump to the model.
       "stereo_sensing.distances_m=[0.5, 3.5]"},
      12);
  const auto lost = [&](const std::string& kind) {
    return 1.0 - counts[kind + "_good"] / counts[kind + "_pixels"];
  };
  // Binomial shares, 3.9 deviations: alpha = 1e-4 each.
  const auto limit = [&](const std::string& kind, double share) {
    return 3.9 * std::sqrt(share * (1.0 - share) / counts[kind + "_pixels"]);
  };
  EXPECT_NEAR(lost("plain"), 0.1, limit("plain", 0.1));
  EXPECT_NEAR(lost("shadow"), 0.46, limit("shadow", 0.46));
  EXPECT_GT(lost("shadow"), 0.4 + limit("shadow", 0.4));  // negative control
  // Beside a jump, some of it in shadow: between 0.5 and 0.7.
  EXPECT_GT(lost("front"), 0.5 - limit("front", 0.5));
  EXPECT_LT(lost("front"), 0.7);
  EXPECT_GT(lost("behind"), 0.5 - limit("behind", 0.5));
  EXPECT_LT(lost("behind"), 0.7);
  // Beyond the reach of 3 columns nothing of that is left.
  const double beyond = 1.0 - counts["front_matched_5"] / counts["front_pixels_5"];
  EXPECT_LT(beyond, 0.46);
  EXPECT_LT(counts["margin_matched"], 0.5 * counts["margin_pixels"]);
}

// A share of what lies beside an edge takes the disparity across: a jump of 1 px and more.
TEST(StereoSensingTest, GivesBackHowEdgesAreMixedUp) {
  const StereoCounts counts = CountsOf(
      {"sensors.stereo.edge_mismatch_probability=0.4", "stereo_sensing.distances_m=[0.5, 3.5]"},
      12);
  for (const std::string side : {"front", "behind"}) {
    const double limit = 3.9 * std::sqrt(0.24 / counts[side + "_pixels"]);  // alpha = 1e-4
    const double share = counts[side + "_wrong"] / counts[side + "_pixels"];
    EXPECT_LT(limit, 0.08);
    EXPECT_LT(share, 0.4 + limit) << side;
    // Before the sky and what is out of range nothing goes wrong.
    EXPECT_GT(share, side == "front" ? 0.3 : 0.4 - limit) << side;
    EXPECT_EQ(counts[side + "_wrong_4"], 0.0);  // beyond the reach
  }
  EXPECT_EQ(counts["plain_wrong"], 0.0);
}

TEST(StereoSensingTest, WrongMatchesAreCountedApart) {
  const StereoCounts counts = CountsOf({"sensors.stereo.mismatch_probability=0.05"}, 6);
  // Uniform over 15.5 px: 2 px of it are within 1 px of the truth, less where its end is near.
  const double share = counts["wrong"] / counts["matched"];
  EXPECT_GT(share, 0.05 * (1.0 - 2.0 / 15.5) - 0.004);
  EXPECT_LT(share, 0.05);
  EXPECT_LT(counts["error_px"] / counts["good"], 0.01);
  EXPECT_GT(counts["imagined"], 0.0);
}

TEST(StereoSensingTest, ARunIsAFunctionOfSeedAndIndexAlone) {
  const scenario::Scenario scenario =
      StereoScenario("range", {"sensors.stereo.fidelity=error_model"});
  const auto experiment = MakeExperiment(scenario);
  const truth::Record first = experiment->Run(1, 5);
  experiment->Run(1, 6);
  EXPECT_EQ(experiment->Run(1, 5).values, first.values);
  EXPECT_EQ(MakeExperiment(scenario)->Run(1, 5).values, first.values);
  EXPECT_NE(experiment->Run(2, 5).values, first.values);
  EXPECT_EQ(experiment->Run(1, 5000000000u).outcome, truth::TrialOutcome::kSimulatorFault);
}

// Looks of a run are those of as many runs of one look each: terrains and places of their own.
TEST(StereoSensingTest, EveryLookHasASceneOfItsOwn) {
  const StereoCounts two = CountsOf({"stereo_sensing.looks_per_run=2"}, 1);
  const StereoCounts first = CountsOf({}, 1);
  const StereoCounts both = CountsOf({}, 2);
  EXPECT_EQ(two["pixels"], both["pixels"]);
  EXPECT_NE(two["pixels"], 2.0 * first["pixels"]);
}

// On bare ground every look has the same truth; its noise is another one.
TEST(StereoSensingTest, EveryLookHasNoiseOfItsOwn) {
  const auto looks = [](const std::string& number) {
    return CountsOf({"sensors.stereo.disparity_noise_px=0.1", "terrain.rocks.kind=none",
                     "stereo_sensing.looks_per_run=" + number},
                    1);
  };
  const StereoCounts one = looks("1");
  const StereoCounts two = looks("2");
  EXPECT_EQ(two["pixels"], 2.0 * one["pixels"]);
  EXPECT_GT(std::abs(two["error_px"] / (2.0 * one["error_px"]) - 1.0), 1e-6);
}

TEST(StereoSensingTest, FactorsReachTheCameras) {
  // A pixel stands for r^2 / (f B): of half the baseline twice as much, four times its square. The
  // bins are those that both search.
  const auto step2 = [&](const std::string& baseline_m) {
    const StereoCounts of = CountsOf(
        {"stereo_sensing.baselines_m=[" + baseline_m + "]", "stereo_sensing.distances_m=[1, 1.5]"},
        4);
    return of["axis_step_m"] / of["good"];
  };
  EXPECT_NEAR(step2("0.06") / step2("0.12"), 4.0, 0.4);
  // Shadows of a low sun are longer.
  const auto shaded = [&](const std::string& elevation_deg) {
    const StereoCounts of =
        CountsOf({"stereo_sensing.sun_elevations_deg=[" + elevation_deg + "]"}, 4);
    return of["shadow_pixels"] / of["pixels"];
  };
  EXPECT_GT(shaded("10"), 2.0 * shaded("80"));
}

TEST(StereoSensingTest, TextureReachesTheImages) {
  const auto error_px = [](const std::string& graininess) {
    return StereoCounts(
        StereoScenario(
            "range", {"sensors.stereo.columns=64", "sensors.stereo.rows=64",
                      "sensors.stereo.images.pyramid_level=0", "sensors.stereo.max_disparity_px=8",
                      "stereo_sensing.distances_m=[0.5, 4]", "stereo_sensing.looks_per_run=1",
                      "stereo_sensing.soil_graininess=[" + graininess + "]"}),
        1)["error_px"];
  };
  EXPECT_NE(error_px("0"), error_px("1"));
}

// Both levels stand at the same places and see the same truth.
TEST(StereoSensingTest, LevelsShareTheirScenes) {
  const std::vector<std::string> small{"sensors.stereo.columns=64", "sensors.stereo.rows=64",
                                       "sensors.stereo.images.pyramid_level=1",
                                       "sensors.stereo.max_disparity_px=8",
                                       "stereo_sensing.distances_m=[0.5, 4]"};
  const StereoCounts images(StereoScenario("range", small), 1);
  const StereoCounts rays(
      StereoScenario("range", With(small, {"sensors.stereo.fidelity=error_model"})), 1);
  for (const char* column :
       {"pixels", "front_pixels", "behind_pixels", "shadow_pixels", "margin_pixels",
        "hidden_pixels", "clear_cells", "rocks_05", "perfect_05"}) {
    EXPECT_EQ(images[column], rays[column]) << column;
  }
  EXPECT_NE(images["error_px"], rays["error_px"]);
  // Rendered and matched: most of it, and within a third of a pixel.
  EXPECT_GT(images["matched"], 0.5 * images["pixels"]);
  EXPECT_LT(images["error_px"] / images["good"], 0.33 * 0.33);
}

TEST(RandomPlaceTest, IsFreeOfHighRocksAndAnywhereInTheArena) {
  const scenario::Scenario scenario = StereoScenario("range");
  double least_x_m = 1e9, most_x_m = -1e9;
  std::set<int> quarters;
  int low_rocks_below = 0;
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    const core::TrialKey key{3, trial};
    const terrain::Terrain terrain = SceneTerrainOf(scenario.drive, key);
    const math::Transform X_WR = RandomPlace(scenario.drive, terrain, 0.1, key);
    const math::Vector3 p_W = X_WR.translation();
    for (const terrain::Rock& rock : terrain.rocks()) {
      const double gap_m = (rock.center_W - p_W).head<2>().norm() - rock.semi_axes_m.x();
      if (rock.height_m < 0.1) {
        if (gap_m < 0.0) ++low_rocks_below;
        continue;
      }
      EXPECT_GE(gap_m, 0.5 * scenario.drive.rover.geometry.length_m - 1e-12);
    }
    EXPECT_TRUE(scenario.drive.terrain.arena.HoldsCoursePoint(p_W.x(), p_W.y()));
    EXPECT_EQ(p_W.z(), 0.0);
    least_x_m = std::min(least_x_m, p_W.x());
    most_x_m = std::max(most_x_m, p_W.x());
    quarters.insert(static_cast<int>(std::floor(2.0 * math::Heading(X_WR) / M_PI)));
  }
  EXPECT_LT(least_x_m, 0.0);
  EXPECT_GT(most_x_m, 8.0);
  EXPECT_EQ(quarters.size(), 4U);
  EXPECT_GT(low_rocks_below, 0);
}

TEST(RandomPlaceTest, SaysWhereThereIsNone) {
  const scenario::Scenario scenario = StereoScenario(
      "range", {"sensors.stereo.fidelity=error_model", "terrain.rocks.k_per_m2=0.1",
                "terrain.rocks.k_reference_per_m2=0.1", "terrain.rocks.clear_radius_m=0",
                "stereo_sensing.hazard_height_m=0.01"});
  const truth::Record record = MakeExperiment(scenario)->Run(1, 0);
  EXPECT_EQ(record.outcome, truth::TrialOutcome::kSimulatorFault);
  EXPECT_THAT(record.detail, HasSubstr("free of rocks"));
}

}  // namespace
}  // namespace rockyard::experiments
