// Mutated scenario files never crash: they give a scenario that reads back to itself, or a
// UserError whose problems name a path and a reason. Deterministic: fixed seeds.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/random.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

constexpr std::uint64_t kSeed = 4242;

std::size_t Below(core::RandomStream& stream, std::size_t bound) {
  return static_cast<std::size_t>(stream.NextU64() % bound);
}

constexpr std::array<std::string_view, 26> kTokens = {
    "{",           "}",        "[",       "]",    ",",
    ":",           "\"",       "null",    "true", "false",
    "NaN",         "Infinity", "-",       "1e9",  "1e999",
    "-1e-999",     "0",        "\\u0000", "\\",   "\xff",
    "\n",          "\"\"",     "{}",      "[[",   "99999999999999999999",
    "\"seed\": 1,"};

// One to four random edits of bytes, tokens or whole pieces.
std::string Mutate(std::string text, core::RandomStream& stream) {
  const std::size_t edits = 1 + Below(stream, 4);
  for (std::size_t i = 0; i < edits && !text.empty(); ++i) {
    const std::size_t at = Below(stream, text.size());
    const std::size_t length = 1 + Below(stream, 40);
    switch (Below(stream, 6)) {
      case 0:
        text[at] = static_cast<char>(stream.NextU32() & 0xffU);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, kTokens[Below(stream, kTokens.size())]);
        break;
      case 3:
        text.replace(at, 1, kTokens[Below(stream, kTokens.size())]);
        break;
      case 4:
        text.insert(at, text.substr(Below(stream, text.size()), length));
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

// True where the text was a scenario; fails the test where neither a scenario nor a good error
// came.
template <typename MakeScenario>
bool IsScenarioOrUserError(const MakeScenario& make) {
  try {
    const Scenario scenario = make();
    const std::string resolved = ResolvedJson(scenario);
    EXPECT_EQ(ResolvedJson(ParseScenario(resolved)), resolved);
    return true;
  } catch (const core::UserError& error) {
    EXPECT_FALSE(error.problems().empty());
    for (const core::Problem& problem : error.problems()) {
      EXPECT_FALSE(problem.path.empty());
      EXPECT_FALSE(problem.reason.empty());
    }
    return false;
  }
}

TEST(ScenarioFuzzTest, MutatedTexts) {
  const std::string defaults = DefaultsJson();
  int valid = 0;
  constexpr int kCases = 3000;
  for (std::uint32_t i = 0; i < kCases; ++i) {
    core::RandomStream stream({kSeed, i}, core::Purpose::kTest);
    const std::string text = Mutate(defaults, stream);
    valid += IsScenarioOrUserError([&text] { return ParseScenario(text); }) ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
  // Both answers occur, or the mutations would test one side only.
  EXPECT_GT(valid, 0);
  EXPECT_LT(valid, kCases);
}

// Valid JSON in which one parameter has an odd value of any type: each of them meets a third of the
// values, and its neighbours the others.
TEST(ScenarioFuzzTest, OddValuesOfEveryParameter) {
  constexpr std::array<std::string_view, 22> kValues = {"null",        "true",
                                                        "0",           "-0.0",
                                                        "1",           "-1",
                                                        "0.5",         "1e308",
                                                        "-1e308",      "5e-324",
                                                        "1e18",        "-1e18",
                                                        "2",           "\"\"",
                                                        "\"x\"",       "[]",
                                                        "{}",          "[1,2]",
                                                        "[null]",      "[1,2,3,4]",
                                                        "{\"a\": {}}", "9223372036854775807"};
  int valid = 0;
  int refused = 0;
  std::size_t number = 0;
  for (const core::ParameterInfo& parameter : ListParameters()) {
    ++number;
    for (std::size_t i = number % 3; i < kValues.size(); i += 3) {
      const std::string_view value = kValues[i];
      core::JsonValue document = core::JsonValue::Object();
      core::SetPath(document, parameter.path, core::ParseJson(value, "value"));
      const bool good = IsScenarioOrUserError([&document] { return ReadScenario(document); });
      ASSERT_FALSE(HasFailure()) << parameter.path << " = " << value;
      (good ? valid : refused) += 1;
    }
  }
  EXPECT_GT(valid, 100);
  EXPECT_GT(refused, 1000);
}

// Several parameters at random places within their bounds: conditions across fields are met or not,
// and what is accepted reads back bit for bit.
TEST(ScenarioFuzzTest, RandomValuesWithinBounds) {
  const std::vector<core::ParameterInfo> parameters = ListParameters();
  int valid = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    core::RandomStream stream({kSeed, i}, core::Purpose::kTest, 1);
    core::JsonValue document = core::JsonValue::Object();
    for (int change = 0; change < 3; ++change) {
      const core::ParameterInfo& parameter = parameters[Below(stream, parameters.size())];
      if (parameter.kind == core::FieldKind::kReal || parameter.kind == core::FieldKind::kAngle) {
        const double value = parameter.min + (parameter.max - parameter.min) * stream.Uniform();
        core::SetPath(document, parameter.path, core::JsonValue(value));
      }
    }
    valid += IsScenarioOrUserError([&document] { return ReadScenario(document); }) ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
  EXPECT_GT(valid, 50);
}

}  // namespace
}  // namespace rockyard::scenario
