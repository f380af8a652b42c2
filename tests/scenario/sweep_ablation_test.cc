// Axes of sweeps that take causes of failure away.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "core/refusals.h"
#include "scenario/ablations.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kFactorial = R"({
  "name": "factorial", "seed": 3, "common_random_numbers": true,
  "set": {"course.designation.enabled": true},
  "axes": [{"name": "goal", "ablation": "perfect_designation"},
           {"ablation": "perfect_localization"}]
})";

std::string ProblemsOf(const std::string& axes, const std::string& more = "") {
  return core::RefusalOf([&] { ParseSweep("{" + more + R"("axes": [)" + axes + "]}"); });
}

TEST(SweepAblationTest, AnAxisIsOffAndOn) {
  const Sweep sweep = ParseSweep(kFactorial);
  ASSERT_EQ(sweep.cells.size(), 4u);
  EXPECT_EQ(sweep.axes[0].name, "goal");
  EXPECT_EQ(sweep.axes[0].ablation, "perfect_designation");
  EXPECT_EQ(sweep.axes[1].name, "perfect_localization") << "by default that of the ablation";
  EXPECT_FALSE(sweep.axes[1].numeric);
  EXPECT_EQ(sweep.cells[1].name, "goal=off,perfect_localization=on");
  EXPECT_THAT(AblationsInForce(sweep.cells[0].scenario), IsEmpty());
  EXPECT_THAT(AblationsInForce(sweep.cells[1].scenario), ElementsAre("perfect_localization"));
  EXPECT_THAT(AblationsInForce(sweep.cells[2].scenario), ElementsAre("perfect_designation"));
  EXPECT_THAT(AblationsInForce(sweep.cells[3].scenario),
              ElementsAre("perfect_designation", "perfect_localization"));
}

TEST(SweepAblationTest, CellsAreTheScenariosOfTheOption) {
  const Sweep sweep = ParseSweep(kFactorial);
  const std::vector<std::string> both{"perfect_localization", "perfect_designation"};
  EXPECT_EQ(Fingerprint(sweep.cells[3].scenario),
            Fingerprint(WithAblations(sweep.cells[0].scenario, both).scenario));
  for (const SweepCell& cell : sweep.cells) EXPECT_EQ(cell.scenario.seed, 3);
}

// Settings come first, whichever axis is named first.
TEST(SweepAblationTest, AblationsLieOverSettings) {
  const std::string ablation = R"({"name": "known", "ablation": "perfect_localization"})";
  const std::string levels = R"({"name": "by", "levels": [
      {"name": "wheels", "set": {"localization.estimator": "dead_reckoning"}},
      {"name": "far", "set": {"course.goal_x_m": 6}}]})";
  for (const std::string& axes :
       {fmt::format("{}, {}", ablation, levels), fmt::format("{}, {}", levels, ablation)}) {
    const Sweep sweep = ParseSweep(fmt::format(R"({{"axes": [{}]}})", axes));
    ASSERT_EQ(sweep.cells.size(), 4u);
    const bool ablation_first = sweep.axes[0].name == "known";
    const Scenario& off = sweep.cells[0].scenario;  // by wheels
    const Scenario& on = sweep.cells[ablation_first ? 2 : 1].scenario;
    EXPECT_EQ(off.drive.localization.estimators.chosen().name(), "dead_reckoning");
    EXPECT_EQ(on.drive.localization.estimators.chosen().name(), "oracle");
    EXPECT_EQ(sweep.cells[3].scenario.drive.localization.estimators.chosen().name(), "oracle");
    EXPECT_EQ(sweep.cells[3].scenario.drive.course.goal_x_m, 6.0);
  }
}

TEST(SweepAblationTest, TheDocumentSaysByItselfWhatIsRun) {
  const Sweep sweep = ParseSweep(kFactorial);
  const Sweep again = ParseSweep(sweep.document, {}, "/nowhere");
  ASSERT_EQ(again.cells.size(), sweep.cells.size());
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    EXPECT_EQ(again.cells[i].name, sweep.cells[i].name);
    EXPECT_EQ(ResolvedJson(again.cells[i].scenario), ResolvedJson(sweep.cells[i].scenario));
  }
}

TEST(SweepAblationTest, NamesWhatIsWrong) {
  EXPECT_THAT(ProblemsOf(R"({"ablation": "perfect_localisation"})"),
              HasSubstr("did you mean \"perfect_localization\"?"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": 3})"), HasSubstr("axes[0].ablation"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_slip"}, {"name": "b", "ablation": "no_slip"})"),
              HasSubstr("twice"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_slip", "values": [1]})"),
              HasSubstr("several of values, levels, scenarios and ablation"));
  // In the cell that has both.
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_avoidance"}, {"ablation": "perfect_path_selection"})"),
              HasSubstr("undone by another one"));
  // Without designated goals there are no errors to take away: both cells would be the same.
  EXPECT_THAT(ProblemsOf(R"({"ablation": "perfect_designation"})"),
              HasSubstr("perfect_designation"));
}

}  // namespace
}  // namespace rockyard::scenario
