// The rows of rovers' speeds: which of them hold, and that they compute with the program's times.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "report/comparison_reference.h"
#include "statistics/published_comparison.h"
#include "trial/compute_profile.h"
#include "trial/compute_tables.h"

namespace rockyard::report {
namespace {

using statistics::Verdict;

constexpr double kStep_m = 0.75;  // the longest motion with GESTALT and visual odometry

const statistics::PublishedReference& Reference() {
  static const statistics::PublishedReference reference =
      LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/howard2012_speed.json");
  return reference;
}

std::vector<double> InputsOf(const std::string& id) {
  for (const auto& value : Reference().values) {
    if (value.id == id) return value.inputs;
  }
  ADD_FAILURE() << "no row " << id;
  return std::vector<double>(3, 0.0);
}

// Ten metres an hour ask for more than 160 s a step: for the longest times and shorter steps.
TEST(HowardSpeedReference, VisualOdometryIsSlowerThanItsTimesAlone) {
  std::set<std::string> differ;
  for (const auto& value : statistics::Compare(Reference(), {}).values) {
    if (value.verdict == Verdict::kDiffers) {
      differ.insert(value.published.id);
    } else {
      EXPECT_EQ(value.verdict, Verdict::kHolds) << value.published.id;
    }
  }
  EXPECT_EQ(differ, (std::set<std::string>{"speed.mer_vision"}));
}

TEST(HowardSpeedReference, InputsAreThoseOfTheProgram) {
  trial::ComputeParams mer;
  mer.computer = trial::Computer::kMer;
  const trial::ComputeTimes times = trial::MakeComputeTimes(
      mer, {.cell_m = trial::kAthenaCell_m, .area_m2 = trial::kTable3Area_m2});
  const std::vector<double> blind = InputsOf("speed.mer_blind");
  const double wheels_m_h = blind[0] * blind[1];

  const std::vector<double> autonav = InputsOf("speed.mer_autonav");
  EXPECT_EQ(autonav[0], kStep_m);
  EXPECT_NEAR(autonav[1], wheels_m_h, 1e-9);
  EXPECT_NEAR(3600.0 * autonav[2], times.acquisition_s + times.stereo_s + times.navigation_s, 1e-5);

  const std::vector<double> vision = InputsOf("speed.mer_vision");
  EXPECT_EQ(vision[0], kStep_m);
  EXPECT_NEAR(vision[1], wheels_m_h, 1e-9);
  EXPECT_NEAR(3600.0 * vision[2], times.acquisition_s + trial::VisualTimeOf(mer).computing_s, 1e-5);

  // Three minutes are 1.125 of the printed 160 s.
  mer.visual_time_factor = 1.125;
  mer.acquisition_s = 10.0;
  const trial::VisualTime slow = trial::VisualTimeOf(mer);
  EXPECT_NEAR(3600.0 * InputsOf("speed.mer_vision_slow")[2], slow.imaging_s + slow.computing_s,
              1e-5);
  EXPECT_EQ(InputsOf("speed.voting")[0], trial::kPowerPcG4OverPowerPc750);
}

}  // namespace
}  // namespace rockyard::report
