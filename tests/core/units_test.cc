#include "core/units.h"

#include <memory>

#include "core/provenance.h"
#include "core/refusals.h"
#include "core/result.h"
#include "core/text.h"
#include "math/angles.h"

namespace rockyard::core {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(UnitsTest, SuffixesNameUnits) {
  const std::pair<const char*, const char*> units[] = {
      {"wheel_radius_m", "m"},    {"slope_deg", "deg"},
      {"speed_m_s", "m/s"},       {"radio_bit_s", "bit/s"},
      {"image_bits", "bit"},      {"latency_min", "min"},
      {"x_min_m", "m"},           {"variance_deg2_per_m", "deg2/m"},
      {"rocks_per_m2", "1/m2"},   {"stall_torque_Nm", "Nm"},
      {"damping_Ns_m", "Ns/m"},   {"gravity_m_s2", "m/s2"},
      {"control_rate_hz", "Hz"},  {"error_percent", "%"},
      {"input_power_w", "W"},     {"irradiance_w_m2_nm", "W/m2/nm"},
      {"distance_au", "au"},      {"read_noise_e", "e"},
      {"dark_current_e_s", "e/s"}};
  for (const auto& [name, unit] : units) EXPECT_EQ(UnitOf(name), unit) << name;
}

TEST(UnitsTest, NamesWithoutUnitsHaveUnitOne) {
  EXPECT_EQ(UnitOf("hurst_exponent"), "1");
  EXPECT_EQ(UnitOf("m"), "1");  // a name is no suffix of itself
  EXPECT_EQ(UnitOf(""), "1");
  EXPECT_EQ(UnitOf("_"), "1");
}

TEST(FiniteNumberTest, IsAllOfAWord) {
  const std::pair<const char*, double> numbers[] = {{"0", 0.0},        {"-1.5", -1.5}, {"+2", 2.0},
                                                    {"1e-3", 1e-3},    {".5", 0.5},    {"007", 7.0},
                                                    {"5e-324", 5e-324}};
  for (const auto& [word, number] : numbers) EXPECT_EQ(FiniteNumber(word), number) << word;
  for (const char* word : {"", "+", "+-1", "++1", "nan", "inf", "-infinity", "1e400", "0x10", "1,5",
                           "1m", " 1", "1 ", "one"}) {
    EXPECT_EQ(FiniteNumber(word), std::nullopt) << word;
  }
}

TEST(UnitsTest, DegreesComeBackShortAndExact) {
  for (const double degrees : {0.0, 0.1, 0.7, 5.0, -33.3, 60.0, 123.456, 359.99}) {
    EXPECT_EQ(ExactDegrees(math::DegToRad(degrees)), degrees);
  }
}

TEST(ProvenanceTest, EverythingIsFilled) {
  const Provenance provenance = CurrentProvenance();
  EXPECT_THAT(provenance.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(provenance.commit, MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
  EXPECT_FALSE(provenance.compiler.empty());
  EXPECT_FALSE(provenance.host.empty());
  EXPECT_FALSE(provenance.cpu_model.empty());
  EXPECT_FALSE(provenance.cpu_level.empty());
  EXPECT_GE(provenance.cpu_threads, 0);
}

TEST(ProvenanceTest, FlagsTellHowFloatingPointIsCompiled) {
  EXPECT_THAT(CurrentProvenance().flags, HasSubstr("-ffp-contract=off"));
}

TEST(ProvenanceTest, VersionLineNamesVersionAndCommit) {
  const Provenance provenance = CurrentProvenance();
  EXPECT_THAT(VersionLine(), HasSubstr("rockyard " + provenance.version));
  EXPECT_THAT(VersionLine(), HasSubstr(provenance.commit));
}

Result<int> Parse(const std::string& text) {
  return Attempt([&] {
    if (text.empty()) throw UserError({{"a", "is empty", "say 1"}, {"b", "is empty", ""}});
    return std::stoi(text);
  });
}

TEST(Result, HoldsAValue) {
  const Result<int> result = Parse("7");
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(*result, 7);
  EXPECT_TRUE(result.problems().empty());
}

TEST(Result, HoldsEveryProblem) {
  const Result<int> result = Parse("");
  EXPECT_FALSE(result.ok());
  ASSERT_EQ(result.problems().size(), 2U);
  EXPECT_EQ(result.problems().front().suggestion, "say 1");
}

TEST(Result, ThrowsWhereTheValueIsAskedFor) {
  EXPECT_EQ(Parse("7").OrThrow(), 7);
  EXPECT_EQ(ProblemsIn([] { Parse("").OrThrow(); }).size(), 2U);
}

TEST(Result, MovesWhatCannotBeCopied) {
  auto result = Attempt([] { return std::make_unique<int>(3); });
  EXPECT_EQ(*std::move(result).OrThrow(), 3);
}

TEST(Result, KeepsThatTheMachineFailed) {
  const auto fail = [](auto error) { return Attempt([&]() -> int { throw error; }); };
  EXPECT_EQ(fail(MachineError("disk", "is full", "")).problems()[0].path, "disk");
  EXPECT_THROW(fail(MachineError("disk", "is full", "")).OrThrow(), MachineError);
  try {
    fail(UserError("disk", "is none", "")).OrThrow();
    FAIL();
  } catch (const MachineError&) {
    FAIL() << "the input was wrong, not the machine";
  } catch (const UserError& error) {
    EXPECT_EQ(error.problems()[0].path, "disk");
  }
}

// What is no user's error is nobody's value.
TEST(Result, LetsOtherExceptionsPass) { EXPECT_THROW(Parse("seven"), std::invalid_argument); }

}  // namespace
}  // namespace rockyard::core
