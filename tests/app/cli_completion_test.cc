// The scripts of `rockyard completion`, read and run by the shells themselves.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class CliCompletion : public CommandTest {
 protected:
  void Write(const std::string& shell) {
    const CommandResult script = Run({"completion", shell});
    ASSERT_EQ(script.exit_code, 0) << script.err;
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
  setenv("ROCKYARD_SCENARIOS", (std::string(ROCKYARD_SOURCE_DIR) + "/scenarios").c_str(), 1);
  EXPECT_EQ(Offered(program + " run mfex_n"), "\nmfex_nominal\n");
  EXPECT_EQ(Offered(program + " run gestalt/abundance_b"),
            "\ngestalt/abundance_behaviour\ngestalt/abundance_behaviour_stereo\n"
            "gestalt/abundance_behaviour_stereo_stripe\n");
  EXPECT_EQ(Offered(program + " sweep attr"), "\nattribution\n");
  setenv("ROCKYARD_SCENARIOS", "/nowhere", 1);
  EXPECT_EQ(Offered(program + " sweep attr"), "\n\n") << "nothing to offer, and no complaint";
  unsetenv("ROCKYARD_SCENARIOS");
}

TEST_F(CliCompletion, BashOffersRunFolders) {
  ASSERT_EQ(Run(QuickRun("results/runs/first", 1)).exit_code, 0);
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
    if (!std::filesystem::exists(program)) continue;
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
