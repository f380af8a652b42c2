// Goals designated in the lander's stereo images: Matthies 1995, section 4 and figure 4.
#include "experiments/designation/designation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/refusals.h"
#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using math::Vector3;
using testing::HasSubstr;

scenario::Scenario Study(const std::vector<std::string>& overrides = {}) {
  return scenario::Shipped("localization/designation", overrides);
}

// One run of one cell, seed 1.
class Cell {
 public:
  explicit Cell(double range_m, const std::vector<std::string>& overrides = {},
                std::int64_t count = 40000) {
    const auto experiment =
        MakeExperiment(Study(With({"designation.ranges_m=[" + std::to_string(range_m) + "]",
                                   "designation.designations_per_run=" + std::to_string(count)},
                                  overrides)));
    schema_ = experiment->schema();
    record_ = Measure(*experiment, 1, 0);
  }

  double operator[](const std::string& column) const { return ValueOf(schema_, record_, column); }
  double Mean(const std::string& column) const { return (*this)[column] / (*this)["found"]; }
  // Standard deviation from a column of sums and one of squares.
  double Sd(const std::string& sum, const std::string& squares) const {
    return std::sqrt(Mean(squares) - Mean(sum) * Mean(sum));
  }
  double Skewness() const {
    const double mean = Mean("downrange_m");
    const double square = Mean("downrange_error_m");
    const double third =
        Mean("downrange_cubes_m3") - 3.0 * mean * square + 2.0 * mean * mean * mean;
    return third / std::pow(square - mean * mean, 1.5);
  }

 private:
  truth::RecordSchema schema_;
  truth::Record record_;
};

struct RangeMoments {
  double bias = 0.0;  // of the mean, as a share of the range
  double sd = 0.0;    // the same
  double skewness = 0.0;
};

// What a normal error x of disparity with standard deviation s makes of a range, whose share
// 1 / (1 + x) is measured. With E[x^2] = s^2, E[x^4] = 3 s^4 and E[x^6] = 15 s^6 the series of
// 1 / (1 + x) and of its powers give these, asymptotically. 0 <= s: up to 0.1 within 5 %.
RangeMoments SecondOrderMoments(double s) {
  const double s2 = s * s;
  return {s2 + 3.0 * s2 * s2, std::sqrt(s2 + 8.0 * s2 * s2), 6.0 * s};
}

// Moments of 1 / (1 + x) - 1 by the midpoint rule over 12 standard deviations of a normal x.
RangeMoments ByQuadrature(double s) {
  constexpr int kSteps = 40000;
  double mass = 0.0;
  double sums[3] = {};
  const double step = 24.0 / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double z = -12.0 + (i + 0.5) * step;
    if (1.0 + s * z <= 0.05) continue;
    const double weight = std::exp(-0.5 * z * z) * step;
    const double share = 1.0 / (1.0 + s * z) - 1.0;
    mass += weight;
    sums[0] += weight * share;
    sums[1] += weight * share * share;
    sums[2] += weight * share * share * share;
  }
  const double mean = sums[0] / mass;
  const double square = sums[1] / mass;
  const double variance = square - mean * mean;
  const double third = sums[2] / mass - 3.0 * mean * square + 2.0 * mean * mean * mean;
  return {mean, std::sqrt(variance), third / std::pow(variance, 1.5)};
}

TEST(RangeLawTest, IsWhatQuadratureGives) {
  for (const double s : {0.005, 0.01, 1.0 / 30.0}) {
    const RangeMoments law = SecondOrderMoments(s);
    const RangeMoments exact = ByQuadrature(s);
    EXPECT_NEAR(law.bias, exact.bias, 0.03 * exact.bias) << s;
    EXPECT_NEAR(law.sd, exact.sd, 0.003 * exact.sd) << s;
    EXPECT_NEAR(law.skewness, exact.skewness, 0.05 * exact.skewness) << s;
  }
  // The first order alone, eq. (2), is off by more than that.
  EXPECT_GT(ByQuadrature(1.0 / 30.0).sd, 1.0 / 30.0 * 1.003);
}

// A place that is imaged and triangulated comes back, wherever it lies.
TEST(LanderPairTest, TriangulatesWhatItSees) {
  const LanderCameras cameras;
  for (const Vector3& p_L :
       {Vector3(1.0, 0.0, 0.0), Vector3(10.0, -3.0, 0.4), Vector3(-20.0, 30.0, 1.5)}) {
    const LanderPair pair(cameras, p_L);
    const auto seen = pair.See(p_L);
    ASSERT_TRUE(seen.has_value());
    EXPECT_LT((pair.Place(*seen).value() - p_L).norm(), 1e-9);
    // Half the disparity to the right of the left image's middle, on its middle row.
    EXPECT_NEAR(seen->left_px.x(), 127.5 + 0.5 * seen->disparity_px, 1e-9);
    EXPECT_NEAR(seen->left_px.y(), 127.5, 1e-9);
    // f B / Z along the line of sight.
    const double slant_m = (p_L - Vector3(0.0, 0.0, 1.5)).norm();
    EXPECT_NEAR(seen->disparity_px, 1000.0 * 0.15 / slant_m, 1e-9);
  }
}

// Left is left and down is down: a pixel is R / f wide.
TEST(LanderPairTest, PixelsPointWhereTheyShould) {
  const LanderPair pair({.mast_height_m = 0.0}, {10.0, 0.0, 0.0});
  const StereoPick seen = pair.See({10.0, 0.0, 0.0}).value();
  const auto moved = [&](double columns, double rows) {
    return pair.Place({seen.left_px + vision::Pixel(columns, rows), seen.disparity_px}).value();
  };
  EXPECT_NEAR(moved(1.0, 0.0).y(), -0.01, 1e-9);
  EXPECT_NEAR(moved(0.0, 1.0).z(), -0.01, 1e-9);
  EXPECT_FALSE(pair.Place({seen.left_px, 0.0}).has_value());
  EXPECT_FALSE(pair.Place({seen.left_px, -1.0}).has_value());
  EXPECT_FALSE(pair.See({-10.0, 0.0, 0.0}).has_value());
}

TEST(LanderPairTest, APanErrorTurnsToTheLeft) {
  const Vector3 p_L = Panned({10.0, 0.0, 0.3}, 0.1);
  EXPECT_NEAR(p_L.x(), 10.0 * std::cos(0.1), 1e-12);
  EXPECT_NEAR(p_L.y(), 10.0 * std::sin(0.1), 1e-12);
  EXPECT_EQ(p_L.z(), 0.3);
}

TEST(DesignationColumnsTest, EverySumHasItsColumnAndEveryBaseIsOne) {
  EXPECT_EQ(DesignationColumns().size(), DesignationSums::kSize + 1);
  for (const truth::ValueInfo& column : DesignationColumns()) {
    if (column.of.empty()) continue;
    EXPECT_NE(truth::FindColumn(DesignationColumns(), column.of), nullptr) << column.name;
  }
}

// Without errors every goal is told where it lies.
TEST(DesignationTest, NoErrorsNoMiss) {
  const Cell cell(20.0,
                  {"course.designation.pixel_sd_px=0", "course.designation.disparity_sd_px=0",
                   "course.designation.pan_error_deg=0"},
                  100);
  EXPECT_EQ(cell["found"], 100.0);
  EXPECT_EQ(cell["near_enough"], 100.0);
  EXPECT_NEAR(cell["miss_m"], 0.0, 1e-7);
  EXPECT_NEAR(cell["height_error_m"], 0.0, 1e-12);
}

// Standard deviations of 40000 values are known to 0.35 %; alpha 1e-4 is 3.9 of these, 1.4 %.
// Geometry: with the slant range r and the depression angle d of the goal the downrange error is
// that of range times cos d, and of row times sin d; crossrange goes by r.
TEST(DesignationTest, SpreadIsThatOfTheGeometry) {
  for (const double range_m : {1.0, 5.0, 20.0, 50.0}) {
    const Cell cell(range_m);
    const double slant_m = std::hypot(range_m, 1.5);
    const double s = 0.1 * slant_m / 150.0;
    const double along_m = SecondOrderMoments(s).sd * slant_m;
    const double pixel_m = 0.001 * slant_m;
    const double downrange_m = std::hypot(along_m * range_m / slant_m, pixel_m * 1.5 / slant_m);
    const double height_m = std::hypot(along_m * 1.5 / slant_m, pixel_m * range_m / slant_m);
    EXPECT_NEAR(cell.Sd("downrange_m", "downrange_error_m"), downrange_m, 0.014 * downrange_m);
    EXPECT_NEAR(cell.Sd("crossrange_m", "crossrange_error_m"), pixel_m, 0.014 * pixel_m);
    EXPECT_NEAR(cell.Sd("height_m", "height_error_m"), height_m, 0.014 * height_m);
  }
  // Negative control: at 1 m eq. (2) knows nothing of the mast.
  const Cell near(1.0);
  EXPECT_GT(near.Sd("downrange_m", "downrange_error_m"), 2.0 * near["equation_2_m"] / 40000.0);
}

// Alpha 1e-4, 3.9 standard errors: sd / 200 of the mean, root(6 / n) of the skewness.
TEST(DesignationTest, FarGoalsAreBiasedAndSkewed) {
  const Cell cell(50.0);
  const double slant_m = std::hypot(50.0, 1.5);
  const RangeMoments law = SecondOrderMoments(0.1 * slant_m / 150.0);
  const double sd_m = law.sd * slant_m;
  EXPECT_NEAR(cell.Mean("downrange_m"), law.bias * slant_m, 3.9 * sd_m / 200.0);
  EXPECT_NEAR(cell.Skewness(), law.skewness, 0.01 + 3.9 * std::sqrt(6.0 / 40000.0));
  // Negative control: the errors of a drive's course have neither.
  EXPECT_GT(cell.Mean("downrange_m"), 3.9 * sd_m / 200.0);
  EXPECT_GT(cell.Skewness(), 3.0 * 3.9 * std::sqrt(6.0 / 40000.0));
}

TEST(DesignationTest, StandsBesideEquationsAndCourse) {
  const Cell cell(20.0);
  const double n = cell["designations"];
  EXPECT_EQ(n, 40000.0);
  EXPECT_NEAR(cell["equation_1_m"] / n, 0.001 * 20.0, 1e-9);
  EXPECT_NEAR(cell["equation_2_m"] / n, 0.0001 * 400.0 / 0.15, 1e-9);
  EXPECT_NEAR(cell["equation_3_m"] / n, std::numbers::pi / 180.0 * 20.0, 1e-9);
  EXPECT_NEAR(std::sqrt(cell["course_downrange_error_m"] / n), 0.2667, 0.014 * 0.2667);
  const double mean_m = cell["course_crossrange_m"] / n;
  EXPECT_NEAR(mean_m, 0.349, 0.001);
  EXPECT_NEAR(std::sqrt(cell["course_crossrange_error_m"] / n - mean_m * mean_m), 0.02, 0.0003);
  // The pan error turns what was triangulated.
  EXPECT_NEAR(cell.Mean("panned_crossrange_m"), 20.0 * std::sin(std::numbers::pi / 180.0), 0.003);
  EXPECT_NEAR(cell.Mean("crossrange_m"), 0.0, 0.001);
  EXPECT_LT(cell.Mean("panned_downrange_m"), cell.Mean("downrange_m"));
  // A normal error's spread is its standard deviation.
  EXPECT_NEAR(cell.Mean("downrange_spread_m"), cell.Sd("downrange_m", "downrange_error_m"), 0.003);
  EXPECT_NEAR(cell.Mean("crossrange_spread_m"), 0.02, 0.0003);
  EXPECT_NEAR(cell.Sd("panned_downrange_m", "panned_downrange_error_m"),
              cell.Sd("downrange_m", "downrange_error_m"), 0.001);
  EXPECT_GT(cell.Mean("miss_m"), 0.349);
  EXPECT_LT(cell.Mean("miss_m"), 0.349 + 0.2667);
}

// Uniform from -1 to 1 deg: no mean, and a root mean square of 1 / root 3.
TEST(DesignationTest, APanErrorMayBeAnything) {
  const Cell cell(20.0, {"course.designation.pan_kind=uniform"});
  const double bound_m = 20.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(cell.Mean("panned_crossrange_m"), 0.0, 3.9 * bound_m / std::sqrt(3.0) / 200.0);
  EXPECT_NEAR(std::sqrt(cell.Mean("panned_crossrange_error_m")),
              std::hypot(bound_m / std::sqrt(3.0), 0.02), 0.003);
}

// The pan error alone is 17.45 cm at 10 m and 24 cm at 13.75 m.
TEST(DesignationTest, CountsWhatIsToldNearEnough) {
  const Cell near(10.0);
  // |downrange| < root(0.24^2 - 0.1745^2) = 0.165 m = 2.44 standard deviations: 98.5 %.
  EXPECT_NEAR(near["near_enough"] / near["designations"], 0.985, 0.005);
  const Cell far(15.0);
  EXPECT_LT(far["near_enough"] / far["designations"], 0.1);
  const Cell wide(15.0, {"designation.near_enough_m=10"});
  EXPECT_EQ(wide["near_enough"], wide["designations"]);
}

// 1500 m off the disparity is 0.1 px, one standard deviation: 15.9 % have none; and twice the range
// or more is told below half the disparity, another 15.0 %.
TEST(DesignationTest, DisparitiesWithoutPlaceAreCounted) {
  const Cell cell(1500.0);
  const double n = cell["designations"];
  EXPECT_EQ(cell["found"] + cell["beyond"], n);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  // Four standard errors.
  EXPECT_NEAR(cell["beyond"] / n, below(-1.0), 0.0075);
  EXPECT_NEAR(cell["doubled"] / n, below(-0.5) - below(-1.0), 0.0075);
  const Cell near(50.0);
  EXPECT_EQ(near["beyond"], 0.0);
  EXPECT_EQ(near["doubled"], 0.0);
}

TEST(DesignationTest, GoesByCellSeedAndNothingElse) {
  const auto experiment = MakeExperiment(Study({"designation.designations_per_run=50"}));
  const truth::Record a = experiment->Run(3, 14);
  experiment->Run(3, 5);
  EXPECT_EQ(a.values, experiment->Run(3, 14).values);
  // 12 cells: run 14 is of the third, 3 m.
  EXPECT_EQ(a.values.at(0), 2.0);
  EXPECT_EQ(a.values.at(1), 3.0);
  EXPECT_NE(experiment->Run(4, 14).values.at(8), a.values.at(8));
  EXPECT_EQ(experiment->Run(1, std::uint64_t{1} << 33).outcome,
            truth::TrialOutcome::kSimulatorFault);
}

std::string ProblemsWith(const std::vector<std::string>& overrides) {
  return core::RefusalOf([&] { Study(overrides); });
}

TEST(DesignationStudyParamsTest, BadScenariosSayWhatIsWrong) {
  EXPECT_EQ(ProblemsWith({}), "");
  EXPECT_THAT(ProblemsWith({"designation.ranges_m=[]"}), HasSubstr("is empty"));
  // Half of 150 px / 0.6 m is 125 px off the middle, and 127.5 px are there.
  EXPECT_THAT(ProblemsWith({"designation.ranges_m=[0.6]", "designation.mast_height_m=0"}),
              HasSubstr("leaves an image"));
  EXPECT_EQ(ProblemsWith({"designation.ranges_m=[0.62]", "designation.mast_height_m=0"}), "");
  EXPECT_THAT(ProblemsWith({"designation.image_side_px=64"}), HasSubstr("image_side_px"));
}

}  // namespace
}  // namespace rockyard::experiments
