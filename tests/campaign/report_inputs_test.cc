#include "campaign/report_inputs.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "campaign/report_replays.h"
#include "campaign/shell_word.h"

namespace rockyard::campaign {
namespace {

using testing::ElementsAre;

TEST(UniqueLabels, AreAsShortAsTheyCanBe) {
  EXPECT_THAT(UniqueLabels({{"a", "x/a"}, {"b", "x/b"}}), ElementsAre("a", "b"));
  EXPECT_THAT(UniqueLabels({{"a", "x/a"}, {"a", "y/a"}, {"b", "y/b"}}),
              ElementsAre("x/a", "y/a", "b"));
}

TEST(UniqueLabels, GetANumberWhereNothingElseTellsThemApart) {
  EXPECT_THAT(UniqueLabels({{"a"}, {"a"}, {"a (2)"}}), ElementsAre("a", "a (2)", "a (2) (2)"));
  EXPECT_TRUE(UniqueLabels({}).empty());
}

// The longer name of one may be the short name of another.
TEST(UniqueLabels, DifferWhateverTheNames) {
  const auto labels = UniqueLabels({{"a", "b"}, {"a", "c"}, {"b", "d"}});
  EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), 3u);
}

TEST(ShellWord, IsQuotedWhereAShellWouldReadMore) {
  EXPECT_EQ(ShellWord("results/runs/a-1_b.json"), "results/runs/a-1_b.json");
  EXPECT_EQ(ShellWord("k=0.004,n=a"), "k=0.004,n=a");
  EXPECT_EQ(ShellWord("my run"), "'my run'");
  EXPECT_EQ(ShellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(ShellWord("$(rm -r x)"), "'$(rm -r x)'");
  EXPECT_EQ(ShellWord(""), "''");
  EXPECT_EQ(ShellWord("-x"), "-x");
  EXPECT_EQ(ShellWord("caf\u00e9"), "'caf\u00e9'");
}

TEST(ShellWord, OfWhatATerminalWouldNotShowIsWrittenInNumbers) {
  EXPECT_EQ(ShellWord("a\u202eb"), "$'a\\342\\200\\256b'");
  EXPECT_EQ(ShellWord("\n'\\ \x7f"), "$'\\012\\047\\134 \\177'");
}

TEST(ShellPath, IsNoOption) {
  EXPECT_EQ(ShellPath("-x"), "./-x");
  EXPECT_EQ(ShellPath("--help me"), "'./--help me'");
  EXPECT_EQ(ShellPath("a-x"), "a-x");
  EXPECT_EQ(ShellPath("/-x"), "/-x");
}

TEST(WorstTrials, OfSeveralCellsTheFurthestFromTheGoalComeFirst) {
  const auto trial = [](std::uint64_t number, double distance_m) {
    ChosenTrial worst;
    worst.record.trial = number;
    worst.goal_distance_m = distance_m;
    return worst;
  };
  const auto worst = Worst({trial(1, 2.0), trial(2, 5.0), trial(3, 5.0), trial(4, 1.0)}, 3);
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].record.trial, 2u);
  EXPECT_EQ(worst[1].record.trial, 3u);
  EXPECT_EQ(worst[2].record.trial, 1u);
}

}  // namespace
}  // namespace rockyard::campaign
