// What is typed or written wrong: exit code 2, a reason with its place, nothing written.

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliErrors : public CommandTest {
 protected:
  void ExpectRefused(const Words& words, const std::string& where) {
    const CommandResult result = Run(words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, Says("error: ", where, "  try: "));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(NothingWritten());
  }
};

TEST_F(CliErrors, Arguments) {
  ExpectRefused({"--quiet"}, "subcommand");
  ExpectRefused({"fly"}, "\"fly\" is no subcommand");
  ExpectRefused({"chekc", "a"}, "did you mean \"check\"");
  ExpectRefused({"run"}, "SCENARIO");
  ExpectRefused({"run", Scenario("nominal"), "--trails", "3"}, "did you mean \"--trials\"?");
  ExpectRefused({"run", "--trails", "3", Scenario("nominal")}, "did you mean \"--trials\"?");
  ExpectRefused({"run", Scenario("nominal"), "--nonsense", "3"}, "rockyard run --help");
  ExpectRefused({"--versoin"}, "did you mean \"--version\"?");
  ExpectRefused({"run", "a.json", "--trials", "3", "--until-half-width", "0.1"}, "--max-trials");
  ExpectRefused({"run", Scenario("nominal"), "--trials", "many"}, "--trials");
  ExpectRefused({"run", Scenario("nominal"), "--trials", "99999999999999999999999"}, "trials");
  ExpectRefused({"run", Scenario("nominal"), "--seed", "9223372036854775808"},
                "9223372036854775808 has too many digits");
  ExpectRefused({"terrain", Scenario("nominal"), "--out", "a.svg", "--seed", "-1"}, "is negative");
  ExpectRefused({"run", Scenario("nominal"), "--trials"}, "--trials");
  ExpectRefused({"run", Scenario("nominal"), "--threads", "0"}, "--threads");
  ExpectRefused({"run", Scenario("nominal"), "--threads", "1000000"}, "--threads");
  ExpectRefused({"run", Scenario("nominal"), "--interval", "wald"}, "--interval");
  ExpectRefused({"run", Scenario("nominal"), "--max-faults", "2"}, "--max-faults");
  ExpectRefused({"run", Scenario("nominal"), "--retry-faults"}, "--retry-faults");
  ExpectRefused({"run", Scenario("nominal"), "--resume", "--retry-faults", "--dry-run"},
                "--dry-run");
  ExpectRefused({"run", Scenario("nominal"), "--json", "--quiet"}, "--quiet");
  ExpectRefused({"check", "somewhere"}, "--against");
  ExpectRefused({"compare", "one"}, "RUN_B");
}

TEST_F(CliErrors, EnumerationsNameTheOptionAndWhatItTakes) {
  const std::vector<std::pair<Words, std::string>> refused = {
      {{"run", "nominal", "--interval", "wilsen"},
       "error: --interval: \"wilsen\" is none of its values\n"
       "  try: did you mean \"wilson\"? one of: wilson, clopper-pearson\n"},
      {{"parameters", "--origin", "guessed"},
       "error: --origin: \"guessed\" is none of its values\n"
       "  try: one of: published, calibrated, assumed, setting\n"},
      {{"completion", "tcsh"},
       "error: SHELL: \"tcsh\" is none of its values\n"
       "  try: did you mean \"bash\"? one of: bash, zsh, fish\n"}};
  for (const auto& [words, message] : refused) {
    const CommandResult result = RunTo(2, words);
    EXPECT_EQ(result.err, message);
  }
  ExpectRefused({"run", "nominal", "--threads", "0"}, "error: --threads: ");
}

TEST_F(CliErrors, ScenarioValues) {
  ExpectRefused({"run", "missing.json"}, "missing.json");
  ExpectRefused({"run", "/dev/null"}, "/dev/null");
  ExpectRefused({"run", work().string()}, "results.sqlite");
  ExpectRefused({"run", Scenario("nominal"), "--trials", "0"}, "trials");
  ExpectRefused({"run", Scenario("nominal"), "--trials", "-5"}, "trials");
  ExpectRefused({"run", Scenario("nominal"), "--trials", "2000000000"}, "trials");
  ExpectRefused({"run", Scenario("nominal"), "--seed", "-1"}, "seed");
  ExpectRefused({"run", Scenario("nominal"), "--set", "terrain"}, "terrain");
  ExpectRefused({"run", Scenario("nominal"), "--set", "terrain.rocks.k=1"}, "terrain.rocks.k");
  ExpectRefused({"run", Scenario("nominal"), "--set", "course.goal_x_m=\"far\""},
                "course.goal_x_m");
  ExpectRefused({"run", Scenario("nominal"), "--set", "course.goal_x_m=1e308"}, "course.goal_x_m");
  ExpectRefused({"run", Scenario("nominal"), "--set", "=3"}, "path");
  ExpectRefused({"validate", "missing.json", Scenario("nominal") + "x"}, "missing.json");
  ExpectRefused({"list", "nowhere"}, "nowhere");
  ExpectRefused({"parameters", "missing.json"}, "missing.json");
}

TEST_F(CliErrors, AllProblemsAtOnce) {
  const CommandResult result =
      RunTo(2, {"run", Scenario("nominal"), "--trials", "0", "--set", "referee.time_limit_s=-1",
                "--set", "terrain.ground.sloap_deg=3"});
  EXPECT_THAT(result.err, Says("error: trials:", "error: referee.time_limit_s:",
                               "error: terrain.ground.sloap_deg:", "slope_deg"));
}

TEST_F(CliErrors, MalformedFiles) {
  const std::string texts[] = {"",
                               "{",
                               "[]",
                               "null",
                               "{\"name\": 1}",
                               "{\"name\": \"a\", \"name\": \"b\"}",
                               "{\"extends\": \"../scenario.json\"}",
                               std::string(100000, '['),
                               std::string("\x00\xff\xfe", 3),
                               "{\"trials\": 1e999}"};
  const auto file = work().parent_path() / "scenario.json";
  for (const std::string& text : texts) {
    WriteFile(file, text);
    ExpectRefused({"run", file.string()}, "error: ");
  }
}

TEST_F(CliErrors, NumbersAreDecimalAndWordsAreText) {
  const auto planned = [&](const std::string& seed) {
    return RunTo(0, {"run", Scenario("nominal"), "--trials", "010", "--dry-run", "--seed", seed})
        .out;
  };
  for (const char* ten : {"10", "010", "+10", "+0010"}) {
    EXPECT_THAT(planned(ten), Says("seed 10", "10 trials")) << ten;
  }
  EXPECT_THAT(planned("000"), Says("seed 0"));
  for (const char* other : {"0x10", "1e1", "1'0", "ten", "+", "-"}) {
    ExpectRefused({"run", Scenario("nominal"), "--out", "a", "--seed", other},
                  std::string(other) + " is no whole decimal number");
  }
  ExpectRefused({"plan", "claim", "--below", "0x1p-4"}, "0x1p-4 is no decimal number");
  for (const char* words : {"name=caf\xe9", "name=\xed\xa0\x80"}) {
    ExpectRefused(With(QuickRun("a", 1), {"--set", words}), "is no text of UTF-8");
  }
  ExpectRefused(QuickRun("caf\xe9", 1), "is no text of UTF-8");
}

TEST_F(CliErrors, ControlCharactersDoNotReachTheTerminal) {
  const CommandResult result = RunTo(2, {"run", "evil\x1b[31m\nname.json"});
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
}

TEST_F(CliErrors, FoldersThatCannotBeWritten) {
  for (const char* folder : {"/proc/run", "/proc", "/dev/null", "/dev/null/run"}) {
    ExpectRefused(QuickRun(folder, 2), folder);
  }
}

TEST_F(CliErrors, CheckAndCompareWithoutRuns) {
  const std::string reference = Source("results/reference/matthies1995.json");
  ExpectRefused({"check", "nowhere", "--against", reference}, "nowhere");
  ExpectRefused({"check", "nowhere", "--against", Scenario("nominal")}, "error: ");
  ExpectRefused({"compare", "nowhere", "elsewhere"}, "nowhere");
}

}  // namespace
}  // namespace rockyard::app
