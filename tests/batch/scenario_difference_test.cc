#include "batch/scenario_difference.h"

#include <gmock/gmock.h>

namespace rockyard::batch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Paths(std::string_view stored, std::string_view wanted) {
  std::vector<std::string> paths;
  for (const core::Problem& problem : ScenarioDifferences(stored, wanted)) {
    paths.push_back(problem.path);
  }
  return paths;
}

TEST(ScenarioDifferences, NamesThePathsThatDiffer) {
  EXPECT_THAT(Paths(R"({"a": {"b": 1, "c": [1, 2], "d": "x"}, "e": true})",
                    R"({"a": {"b": 2, "c": [1, 3], "d": "x"}, "f": true})"),
              ElementsAre("a.b", "a.c", "e", "f"));
}

TEST(ScenarioDifferences, LeavesOutWhatNoRecordDependsOn) {
  EXPECT_THAT(Paths(R"({"name": "a", "description": "b", "trials": 1})",
                    R"({"name": "c", "description": "d", "trials": 2})"),
              IsEmpty());
  // Only at the top: a rock type may have a name that matters.
  EXPECT_THAT(Paths(R"({"rock": {"name": "a"}})", R"({"rock": {"name": "b"}})"),
              ElementsAre("rock.name"));
}

// Of an earlier version of the program.
TEST(ScenarioDifferences, TakesFormerKeysForThoseOfToday) {
  const char* former = R"({"sensors": {"localization": "oracle", "gyro": 1}})";
  EXPECT_THAT(Paths(former, R"({"sensors": {"gyro": 1}, "localization": {"estimator": "oracle"}})"),
              IsEmpty());
  EXPECT_THAT(Paths(R"({"sensors": {"gyro": 1}, "localization": {"estimator": "oracle"}})", former),
              IsEmpty());
  EXPECT_THAT(Paths(former, R"({"sensors": {"gyro": 1}, "localization": {"estimator": "x"}})"),
              ElementsAre("localization.estimator"));
}

TEST(ScenarioDifferences, SeesTheLastBitAndEndsAtTheLimit) {
  EXPECT_THAT(Paths(R"({"a": 0.1})", R"({"a": 0.10000000000000002})"), ElementsAre("a"));
  const auto few = ScenarioDifferences(R"({"a": 1, "b": 1, "c": 1})", R"({})", 2);
  ASSERT_EQ(few.size(), 3U);
  EXPECT_EQ(few.back().reason, "differs in 1 more places");
}

TEST(ScenarioDifferences, TextThatIsNoJson) {
  EXPECT_EQ(ScenarioDifferences("{", "{}").size(), 1U);
}

}  // namespace
}  // namespace rockyard::batch
