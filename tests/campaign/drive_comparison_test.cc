// Stored drives compared some columns at a time, against all at once.
#include "campaign/drive_comparison.h"

#include <gtest/gtest.h>

#include "campaign/run_views.h"
#include "campaign/small_runs.h"
#include "report/paired_comparison.h"

namespace rockyard::campaign {
namespace {

TEST_F(SmallRuns, ColumnsComparedInPartsAreThoseOfTheWhole) {
  RunRequest other = Request("b", 9);
  other.campaign.overrides.emplace_back("rover.drive.speed_m_s=0.1");
  ASSERT_EQ(campaign::Run(Request("a", 12)).outcome, Outcome::kDone);
  ASSERT_EQ(campaign::Run(other).outcome, Outcome::kDone);
  const StoredRun a = ReadRun(Path("a"));
  const StoredRun b = ReadRun(Path("b"));
  const std::string whole =
      report::RunComparisonCsv(report::CompareRuns(ComparedView(a), ComparedView(b)));
  // All columns, some, and one at a time.
  for (const std::size_t values : {10000, 21 * 7, 1}) {
    const report::RunComparison parts =
        CompareDrives(ReadRun(Path("a"), "", StoredValues::kNone),
                      ReadRun(Path("b"), "", StoredValues::kNone), values);
    EXPECT_EQ(report::RunComparisonCsv(parts), whole) << values;
    EXPECT_EQ(parts.pairs, 9);
    EXPECT_EQ(parts.successes.size(), 2u);
  }
}

TEST_F(SmallRuns, ARunWithoutValuesHasOutcomesAlone) {
  ASSERT_EQ(campaign::Run(Request("a", 3)).outcome, Outcome::kDone);
  const StoredRun run = ReadRun(Path("a"), "", StoredValues::kNone);
  ASSERT_EQ(run.records.size(), 3u);
  EXPECT_EQ(run.records[2].outcome, truth::TrialOutcome::kTimeLimit);
  EXPECT_TRUE(run.records[2].values.empty());
  EXPECT_EQ(run.schema.size(), ReadRun(Path("a")).schema.size());
}

}  // namespace
}  // namespace rockyard::campaign
