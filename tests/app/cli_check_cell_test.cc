// rockyard check of one cell against a baseline, and of trials that are the same.
#include <gmock/gmock.h>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::Not;

class CliCheckCell : public CommandTest {
 protected:
  CliCheckCell() {
    WriteFile(work() / "two.json", R"({
      "name": "two", "trials": 25,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 300},
      "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
  }
  // Long enough that something happens.
  static std::vector<std::string> Drives(const std::string& out, int trials) {
    return With(QuickRun(out, trials),
                {"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=300"});
  }
  CommandResult Check(const std::string& run, const std::vector<std::string>& more) const {
    return Run(With({"check", run, "--against", "base.json"}, more));
  }
  void MakeBaseline(const std::string& run) const {
    const CommandResult made = Run({"baseline", run, "--reason", "test", "--out", "base.json"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
};

TEST_F(CliCheckCell, OnlyThatCellIsCompared) {
  ASSERT_EQ(Run({"sweep", "two.json", "--out", "a"}).exit_code, 0);
  MakeBaseline("a");
  const CommandResult all = Check("a", {});
  EXPECT_THAT(all.out, Says("k_per_m2=0.001", "k_per_m2=0.004"));
  for (const char* cell : {"k_per_m2=0.004", "1"}) {
    const CommandResult one = Check("a", {"--cell", cell});
    EXPECT_THAT(one.out, HasSubstr("k_per_m2=0.004"));
    EXPECT_THAT(one.out, Not(HasSubstr("k_per_m2=0.001")));
  }
  const CommandResult wrong = Check("a", {"--cell", "foo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("\"foo\" is no cell of a"));
  EXPECT_EQ(wrong.out, "");
}

TEST_F(CliCheckCell, ARunOfOneCellHasNoOther) {
  ASSERT_EQ(Run(Drives("a", 2)).exit_code, 0);
  MakeBaseline("a");
  const CommandResult wrong = Check("a", {"--cell", "foo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--cell"));
}

// A run that was interrupted, or that is shorter than the baseline, may still be the same.
TEST_F(CliCheckCell, PairsThatAreTheSameAreCounted) {
  ASSERT_EQ(Run(Drives("long", 30)).exit_code, 0);
  ASSERT_EQ(Run(Drives("short", 21)).exit_code, 0);
  MakeBaseline("long");
  const std::string same = Check("short", {}).out;
  EXPECT_THAT(same, Says("21 pairs with the baseline's trials (seed 1)\n",
                         "records: the same, as far as the baseline keeps them"));
  ASSERT_EQ(Run(With(Drives("other", 21), {"--set", "rover.drive.speed_m_s=0.03"})).exit_code, 0);
  const std::string text = Check("other", {"--allow-scenario-change"}).out;
  EXPECT_THAT(text, Says("21 pairs with the baseline's trials (seed 1)\n", "records: changed"));
}

}  // namespace
}  // namespace rockyard::app
