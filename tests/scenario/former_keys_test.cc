#include "scenario/former_keys.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string EstimatorOf(const std::string& json, const std::vector<std::string>& overrides = {}) {
  return std::string(ParseScenario(json, overrides).drive.localization.estimators.chosen().name());
}

constexpr const char* kFormerOracle = R"({"sensors": {"localization": "oracle"}})";

TEST(FormerKeys, FilesWithThemAreReadAsTheyWere) {
  EXPECT_EQ(EstimatorOf("{}"), "dead_reckoning");
  EXPECT_EQ(EstimatorOf(kFormerOracle), "oracle");
  EXPECT_EQ(Fingerprint(ParseScenario(kFormerOracle)),
            Fingerprint(ParseScenario(R"({"localization": {"estimator": "oracle"}})")));
}

TEST(FormerKeys, AreNotWritten) {
  const std::string text = ResolvedJson(ParseScenario(kFormerOracle));
  EXPECT_THAT(text, HasSubstr(R"("estimator": "oracle")"));
  EXPECT_THAT(text, Not(HasSubstr(R"("localization": "oracle")")));
}

TEST(FormerKeys, WhatIsSetLastCounts) {
  EXPECT_EQ(EstimatorOf("{}", {"sensors.localization=oracle"}), "oracle");
  EXPECT_EQ(EstimatorOf(kFormerOracle, {"localization.estimator=dead_reckoning"}),
            "dead_reckoning");
  EXPECT_EQ(EstimatorOf(R"({"localization": {"estimator": "oracle"}})",
                        {"sensors.localization=dead_reckoning"}),
            "dead_reckoning");
  EXPECT_EQ(
      EstimatorOf("{}", {"localization.estimator=oracle", "sensors.localization=dead_reckoning"}),
      "dead_reckoning");
}

TEST(FormerKeys, BothWithDifferentValuesAreRefused) {
  EXPECT_THAT(core::RefusalOf([] {
                ParseScenario(R"({"sensors": {"localization": "oracle"},
                                  "localization": {"estimator": "dead_reckoning"}})");
              }),
              AllOf(StartsWith("sensors.localization: "),
                    HasSubstr("former name of localization.estimator")));
  EXPECT_EQ(EstimatorOf(R"({"sensors": {"localization": "oracle"},
                            "localization": {"estimator": "oracle"}})"),
            "oracle");
}

TEST(FormerKeys, WrongValuesAreNamedByTheKeyOfToday) {
  for (const char* wrong :
       {R"({"sensors": {"localization": "oracel"}})", R"({"sensors": {"localization": 7}})",
        R"({"sensors": {"localization": {"estimator": "oracle"}}})"}) {
    EXPECT_THAT(core::RefusalOf([&] { ParseScenario(wrong); }),
                StartsWith("localization.estimator: "))
        << wrong;
  }
  // What holds groups now is no group in these files.
  EXPECT_THROW(ParseScenario(R"({"sensors": {"localization": "oracle"}, "localization": 3})"),
               core::UserError);
  EXPECT_THROW(ParseScenario(R"({"sensors": 3})"), core::UserError);
}

TEST(FormerKeys, AreAxesAndSettingsOfSweeps) {
  const Sweep axis = ParseSweep(
      R"({"axes": [{"path": "sensors.localization", "values": ["dead_reckoning", "oracle"]}]})");
  ASSERT_EQ(axis.cells.size(), 2U);
  EXPECT_EQ(axis.cells[1].scenario.drive.localization.estimators.chosen().name(), "oracle");
  const Sweep setting = ParseSweep(
      R"({"set": {"sensors": {"localization": "oracle"}},
          "axes": [{"path": "course.goal_x_m", "values": [5, 6]}]})");
  EXPECT_EQ(setting.cells[0].scenario.drive.localization.estimators.chosen().name(), "oracle");
  // Whichever name the base has, the setting lies over it.
  for (const char* base : {R"({"sensors": {"localization": "oracle"}})",
                           R"({"localization": {"estimator": "oracle"}})"}) {
    for (const char* key : {"sensors.localization", "localization.estimator"}) {
      const Sweep over = ParseSweep(
          std::string(R"({"scenario": )") + base + R"(, "set": {")" + key +
          R"(": "dead_reckoning"}, "axes": [{"path": "course.goal_x_m", "values": [5, 6]}]})");
      EXPECT_EQ(over.cells[0].scenario.drive.localization.estimators.chosen().name(),
                "dead_reckoning")
          << base << key;
    }
  }
}

}  // namespace
}  // namespace rockyard::scenario
