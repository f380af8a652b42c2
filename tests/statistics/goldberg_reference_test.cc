// The rows of Goldberg 2002 that take more than one column, or hardly a sample: that they can fail.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "report/comparison_reference.h"
#include "statistics/published_comparison.h"

namespace rockyard::report {
namespace {

using statistics::Verdict;
using truth::Record;
using truth::TrialOutcome;

statistics::PublishedReference RowOf(const std::string& id) {
  statistics::PublishedReference reference =
      LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/goldberg2002.json");
  std::erase_if(reference.values, [&](const auto& value) { return value.id != id; });
  if (reference.values.size() != 1) throw std::logic_error("no row " + id);
  return reference;
}

statistics::ComparedValue Judged(const std::string& id, std::initializer_list<const char*> columns,
                                 const std::vector<Record>& records) {
  truth::RecordSchema schema;
  for (const char* name : columns) schema.push_back({name, "1", "for this test"});
  const statistics::ScenarioRun run{"gestalt_viking_lander_2", schema, records};
  return statistics::Compare(RowOf(id), {&run, 1}).values.front();
}

// Trials of 20 to 29 moves, with the image sets for a move and the times of table 2.
statistics::ComparedValue CycleOf(double imaging_s, double computing_s, double driving_s) {
  std::vector<Record> records;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const double moves = 20.0 + i;
    const double image_sets = std::round(1.467 * moves);
    records.push_back(
        {i,
         TrialOutcome::kMeasured,
         "",
         {image_sets, moves, imaging_s * image_sets, computing_s * image_sets, driving_s * moves}});
  }
  return Judged("viking_lander_2.cycle",
                {"image_sets", "moves", "imaging_time_s", "compute_time_s", "move_time_s"},
                records);
}

// 8.974 s of imaging, 4.634 s of stereo, 13.154 s of navigation and 15 s of driving: 41.762 s, not
// the 54.25 s of a move with its 154 / 105 image sets.
TEST(GoldbergCycle, TheTimesOfTable2AreItsTotal) {
  const statistics::ComparedValue cycle = CycleOf(8.974, 4.634 + 13.154, 15.0);
  EXPECT_NEAR(cycle.pool_value, 41.762, 1e-9);
  EXPECT_EQ(cycle.verdict, Verdict::kAgrees);
  const double error_s = 7.80705 / std::sqrt(105.0);
  EXPECT_NEAR(cycle.published.low, 42.0 - 2.0 * error_s, 0.005);
  EXPECT_NEAR(cycle.published.high, 42.0 + 2.0 * error_s, 0.005);
}

TEST(GoldbergCycle, EveryPartCanMakeItDiffer) {
  EXPECT_EQ(CycleOf(8.974, 17.788, 17.0).verdict, Verdict::kDiffers);
  EXPECT_EQ(CycleOf(8.974, 15.788, 15.0).verdict, Verdict::kDiffers);
  EXPECT_EQ(CycleOf(10.974, 17.788, 15.0).verdict, Verdict::kDiffers);
}

// Of 100 trials, as many read short as told.
Verdict OdometerVerdict(int reading_short) {
  std::vector<Record> records;
  for (int i = 0; i < 100; ++i) {
    const double error_percent = i < reading_short ? -1.0 : 1.0;
    records.push_back(
        {static_cast<std::uint64_t>(i), TrialOutcome::kMeasured, "", {error_percent}});
  }
  return Judged("viking_lander_2.odometer_sign", {"distance_error_percent"}, records).verdict;
}

// One run tells only that its kind is not almost impossible.
TEST(GoldbergOdometer, DiffersWhereNoTrialReadsShort) {
  EXPECT_EQ(OdometerVerdict(0), Verdict::kDiffers);
  EXPECT_EQ(OdometerVerdict(10), Verdict::kUnderpowered);
  EXPECT_EQ(OdometerVerdict(50), Verdict::kUnderpowered);
  EXPECT_EQ(OdometerVerdict(100), Verdict::kUnderpowered);
}

}  // namespace
}  // namespace rockyard::report
