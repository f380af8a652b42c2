// What holds for options of every command, and for the lines that commands print.

#include <algorithm>
#include <set>
#include <sstream>

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliOptions : public CommandTest {
 protected:
  void ExpectRefused(const Words& words, const std::string& where) {
    const CommandResult result = Run(words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, Says(where, "  try: "));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(NothingWritten());
  }

  std::set<std::string> FilesIn(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(work() / folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

TEST_F(CliOptions, NoNumberIsNanOrInfinite) {
  const std::string nominal = Scenario("nominal");
  for (const char* wrong : {"nan", "NaN", "-nan", "inf", "-inf", "1e999"}) {
    for (const char* option : {"--until-half-width", "--max-faults", "--trial-cpu-limit"}) {
      ExpectRefused({"run", nominal, "--out", "a", option, wrong}, option);
      ExpectRefused({"sweep", "a.json", option, wrong}, option);
    }
    ExpectRefused({"plan", "half-width", "--half-width", wrong}, "--half-width");
    ExpectRefused({"plan", "half-width", "--half-width", "0.1", "--rate", wrong}, "--rate");
    ExpectRefused({"plan", "claim", "--below", wrong}, "--below");
    ExpectRefused({"plan", "claim", "--below", "0.1", "--confidence", wrong}, "--confidence");
    ExpectRefused({"plan", "difference", "--from", "0.1", "--to", "0.2", "--discordant", wrong},
                  "--discordant");
    ExpectRefused({"plan", "equivalence", "--deviation", "1", "--margin", wrong}, "--margin");
    ExpectRefused({"check", "a", "--against", "b", "--alpha", wrong}, "--alpha");
    ExpectRefused({"check", "a", "--against", "b", "--equivalence-alpha", wrong},
                  "--equivalence-alpha");
    ExpectRefused({"terrain", nominal, "--blind-swath", "--width", wrong}, "--width");
    ExpectRefused({"replay", nominal, "--trial", "0", "--step", wrong}, "--step");
  }
  EXPECT_EQ(Run({"plan", "half-width", "--half-width", "0.1", "--rate", "0.3"}).exit_code, 0)
      << "finite numbers are taken";
}

TEST_F(CliOptions, NoValueIsEmpty) {
  const std::string nominal = Scenario("nominal");
  for (const char* option : {"--trials", "--out", "--seed", "--shard", "--set", "--threads"}) {
    ExpectRefused({"run", nominal, option, ""}, option);
    ExpectRefused({"sweep", "a.json", option, ""}, option);
  }
  ExpectRefused({"run", ""}, "SCENARIO");
  ExpectRefused({"merge", "a", "--out", ""}, "--out");
  ExpectRefused({"check", "a", "--against", ""}, "--against");
}

// What is cut off is no answer: programs must see that too.
TEST_F(CliOptions, ASearchThatWasCutOffSaysSo) {
  const Words words = {"plan", "claim", "--below", "1e-7", "--failures", "10000"};
  EXPECT_THAT(Run(words).out, HasSubstr("that many or more"));
  const json cut = json::parse(Run(With(words, {"--json"})).out);
  EXPECT_EQ(cut["trials_or_more"], true);
  EXPECT_FALSE(cut.contains("chance_at_2th")) << "of a number that is no answer";
  const json known = json::parse(Run({"plan", "claim", "--below", "0.01", "--json"}).out);
  EXPECT_FALSE(known.contains("trials_or_more"));
  EXPECT_TRUE(known.contains("chance_at_2th"));
}

TEST_F(CliOptions, ForceOverwritesNothing) {
  fs::create_directories(work() / "a");
  WriteFile(work() / "a" / "summary.json", "keep");
  WriteFile(work() / "a" / "letter.txt", "dear");
  const CommandResult first = RunTo(0, With(QuickRun("a", 1), {"--force"}));
  EXPECT_EQ(ReadFile(work() / "a" / "summary.old-1.json"), "keep");
  EXPECT_EQ(ReadFile(work() / "a" / "letter.txt"), "dear");
  EXPECT_THAT(first.err, HasSubstr("summary.old-1.json"));

  const std::string trials = ReadFile(work() / "a" / "trials.csv");
  const std::string summary = ReadFile(work() / "a" / "summary.json");
  RunTo(0, With(QuickRun("a", 2), {"--force"}));
  EXPECT_EQ(ReadFile(work() / "a" / "summary.old-2.json"), summary);
  EXPECT_EQ(ReadFile(work() / "a" / "trials.old-1.csv"), trials);
}

// Every file that a campaign writes is one that --force knows.
TEST_F(CliOptions, ForceKnowsEveryFileOfEveryCampaign) {
  const std::string scenarios = Source("scenarios/hazard_detection/");
  WriteFile(work() / "s.json", R"({
    "name": "s", "trials": 2, "common_random_numbers": true,
    "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
    "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]},
             {"ablation": "perfect_localization"}]})");
  const std::vector<Words> campaigns = {
      QuickRun("run", 2),
      {"sweep", "s.json", "--out", "sweep"},
      {"run", scenarios + "detection.json", "--trials", "2", "--out", "study", "--set",
       "hazard_detection.scenes_per_run=5"}};
  for (const Words& words : campaigns) {
    SCOPED_TRACE(testing::PrintToString(words));
    const std::string folder = *(std::find(words.begin(), words.end(), "--out") + 1);
    const CommandResult first = RunTo(0, words);
    const std::set<std::string> files = FilesIn(folder);
    RunTo(0, With(words, {"--force"}));
    const std::set<std::string> after = FilesIn(folder);
    for (const std::string& file : files) {
      if (file.ends_with("-wal") || file.ends_with("-shm")) continue;
      const fs::path name = file;
      EXPECT_TRUE(after.contains(name.stem().string() + ".old-1" + name.extension().string()))
          << file;
    }
  }
}

TEST_F(CliOptions, NoLineIsLongerThanAHundredColumns) {
  RunTo(0, QuickRun("a", 2));
  const std::vector<Words> commands = {
      {"metrics"},
      {"plan", "claim", "--below", "1e-7", "--failures", "10000"},
      {"plan", "difference", "--from", "0.85", "--to", "0.86", "--discordant", "0.05"},
      With(QuickRun("b", 100000), {"--dry-run"}),
      With(QuickRun("a", 2), {"--force"}),
      {"run", Scenario("nominal"), "--until-half-width", "0.0123", "--budget", "123456789",
       "--dry-run", "--set", "referee.time_limit_s=1", "--out", "c"}};
  for (const Words& words : commands) {
    SCOPED_TRACE(testing::PrintToString(words));
    const CommandResult result = RunTo(0, words);
    std::istringstream lines(result.out + result.err);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

// Processes that mpirun started beside rank 0 leave the terminal to it.
TEST_F(CliOptions, OnlyRankZeroAnswers) {
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  const std::vector<Words> commands = {{"metrics"},
                                       {"fly"},
                                       {"run", "--bogus"},
                                       {"plan", "claim", "--below", "0.01"},
                                       With(QuickRun("a", 2), {"--dry-run"})};
  for (const Words& words : commands) {
    SCOPED_TRACE(testing::PrintToString(words));
    setenv("OMPI_COMM_WORLD_RANK", "1", 1);
    const CommandResult second = Run(words);
    EXPECT_EQ(second.out + second.err, "");
    EXPECT_TRUE(NothingWritten());
    setenv("OMPI_COMM_WORLD_RANK", "0", 1);
    const CommandResult first = Run(words);
    EXPECT_NE(first.out + first.err, "");
  }
  unsetenv("OMPI_COMM_WORLD_RANK");
  unsetenv("OMPI_COMM_WORLD_SIZE");
}

// The scripts of `rockyard completion`, read and run by the shells themselves.

class CliCompletion : public CommandTest {
 protected:
  void Write(const std::string& shell) {
    const CommandResult script = RunTo(0, {"completion", shell});
    WriteFile(work() / "script", script.out);
  }

  // What bash offers for the last of the words, one each line.
  std::string Offered(const std::string& words) {
    Write("bash");
    const std::string program =
        "source ./script; COMP_WORDS=(" + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _rockyard; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const CommandResult result = Wait(StartProgram({"/bin/bash", "-c", program}));
    EXPECT_EQ(result.err, "");
    return "\n" + result.out;
  }
};

TEST_F(CliCompletion, BashTakesItAndRegistersIt) {
  Write("bash");
  const CommandResult result =
      Wait(StartProgram({"/bin/bash", "-c", "source ./script && complete -p rockyard"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("-F _rockyard rockyard"));
}

TEST_F(CliCompletion, BashCompletesCommandsOptionsAndChoices) {
  EXPECT_THAT(Offered("rockyard ''"), HasSubstr("\nsweep\n"));
  EXPECT_EQ(Offered("rockyard comp"), "\ncompare\ncompletion\n");
  const std::string options = Offered("rockyard run a.json --tr");
  EXPECT_THAT(options, HasSubstr("\n--trials\n"));
  EXPECT_THAT(options, Not(HasSubstr("--seed")));
  EXPECT_EQ(Offered("rockyard run a.json --interval ''"), "\nwilson\nclopper-pearson\n");
  EXPECT_EQ(Offered("rockyard run a.json --interval = cl"), "\nclopper-pearson\n");
  EXPECT_EQ(Offered("rockyard completion z"), "\nzsh\n");
  EXPECT_EQ(Offered("rockyard plan cl"), "\nclaim\n");
  EXPECT_EQ(Offered("rockyard run a.json --trials ''"), "\n\n") << "a number: nothing to offer";
}

TEST_F(CliCompletion, BashAsksTheProgramForSettingsAndNames) {
  const std::string program = ROCKYARD_COMMAND;
  EXPECT_EQ(Offered(program + " run a.json --set terrain.rocks.k_per"),
            "\nterrain.rocks.k_per_m2=\n");
  EXPECT_EQ(Offered(program + " run a.json --set rover.fidelity = ''"),
            "\nmultibody\nquasi_static\n");
  EXPECT_EQ(Offered(program + " run a.json --set rover.fidelity ="), "\nmultibody\nquasi_static\n");
  EXPECT_EQ(Offered(program + " run a.json --set = rover.fidelity = q"), "\nquasi_static\n");
  EXPECT_EQ(Offered(program + " run a.json --set perception.hazard.enabled = t"), "\ntrue\n");
  setenv("ROCKYARD_SCENARIOS", Source("scenarios").c_str(), 1);
  EXPECT_EQ(Offered(program + " run mfex_n"), "\nmfex_nominal\n");
  EXPECT_EQ(Offered(program + " run gestalt/abundance_b"),
            "\ngestalt/abundance_behaviour\ngestalt/abundance_behaviour_stereo\n"
            "gestalt/abundance_behaviour_stereo_stripe\n");
  EXPECT_EQ(Offered(program + " sweep attr"), "\nattribution\n");
  setenv("ROCKYARD_SCENARIOS", "/nowhere", 1);
  EXPECT_EQ(Offered(program + " sweep attr"), "\n\n") << "nothing to offer, and no complaint";
  unsetenv("ROCKYARD_SCENARIOS");
}

// A library that the line names is asked for its parameters; a scenario file is only read.
TEST_F(CliCompletion, BashOffersParametersOfPlugins) {
  const std::string program = ROCKYARD_COMMAND;
  const std::string plugin = COUNTING_NAVIGATOR;
  for (const std::string given : {" --plugin ", " --plugin = "}) {
    EXPECT_EQ(Offered(program + " run nominal" + given + plugin + " --set navigation.counter.s"),
              "\nnavigation.counter.stretch_m=\n");
  }
  WriteFile(work() / "theirs.json", R"({"plugins": [{"process": "touch opened"}],
      "navigation": {"navigator": "theirs", "theirs": {"boldness": 1}}})");
  EXPECT_EQ(Offered(program + " run theirs.json --set navigation.theirs."),
            "\nnavigation.theirs.boldness=\n");
  EXPECT_FALSE(fs::exists(work() / "opened"));
  EXPECT_EQ(Offered(program + " run nominal --plugin nowhere.so --set terrain.rocks.k_per"),
            "\nterrain.rocks.k_per_m2=\n");
}

TEST_F(CliCompletion, BashOffersRunFolders) {
  RunTo(0, QuickRun("results/runs/first", 1));
  EXPECT_THAT(Offered(std::string(ROCKYARD_COMMAND) + " report results/runs/f"),
              HasSubstr("\nresults/runs/first\n"));
}

TEST_F(CliCompletion, LookUpsOfNoKindOfferNothing) {
  for (const std::string asked : {"nonsense", "nonsense:", ":", "settings"}) {
    const CommandResult result = Run({"completion", "--offer", asked});
    EXPECT_EQ(result.exit_code, 0) << asked;
    EXPECT_EQ(result.out + result.err, "") << asked;
  }
}

TEST_F(CliCompletion, BashCompletesFiles) {
  WriteFile(work() / "my scenario.json", "{}");
  WriteFile(work() / "other.json", "{}");
  EXPECT_EQ(Offered("rockyard run my"), "\nmy scenario.json\n");
  EXPECT_EQ(Offered("rockyard run a.json --out o"), "\nother.json\n");
}

TEST_F(CliCompletion, OtherShellsReadTheirs) {
  for (const std::string shell : {"zsh", "fish"}) {
    Write(shell);
    const std::string program = "/usr/bin/" + shell;
    if (!fs::exists(program)) continue;
    const CommandResult result = Wait(StartProgram({program, "-n", "./script"}));
    EXPECT_EQ(result.exit_code, 0) << shell << result.err;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_THAT(Run({"completion", "zsh"}).out, StartsWith("#compdef rockyard\n"));
  EXPECT_THAT(Run({"completion", "fish"}).out, HasSubstr("complete -c rockyard"));
}

TEST_F(CliCompletion, UnknownShell) {
  EXPECT_THAT(RunTo(2, {"completion", "tcsh"}).err, HasSubstr("bash"));
}

}  // namespace
}  // namespace rockyard::app
