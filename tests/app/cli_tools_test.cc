// The subcommands beside run.

#include "app/command.h"

namespace rockyard::app {
namespace {

using CliStart = CommandTest;
using CliTools = CommandTest;

TEST_F(CliTools, VersionAndHelp) {
  const CommandResult version = RunTo(0, {"--version"});
  EXPECT_THAT(version.out, StartsWith("rockyard "));
  EXPECT_THAT(version.out, Says("commit", "flags"));
  const CommandResult help = RunTo(0, {"--help"});
  for (const char* name : {"run", "check", "compare", "rover", "terrain", "validate", "defaults",
                           "schema", "list", "parameters"}) {
    EXPECT_THAT(help.out, HasSubstr(name));
    EXPECT_EQ(Run({name, "--help"}).exit_code, 0) << name;
  }
}

TEST_F(CliTools, DefaultsAreAValidScenario) {
  WriteFile(work() / "defaults.json", Run({"defaults"}).out);
  EXPECT_THAT(RunTo(0, {"validate", "defaults.json", Scenario("nominal")}).out,
              HasSubstr("defaults.json: valid"));
  EXPECT_EQ(json::parse(Run({"schema"}).out)["type"], "object");
}

TEST_F(CliTools, ListIsWholeWherePiped) {
  const CommandResult result = RunTo(0, {"list", Source("scenarios")});
  EXPECT_THAT(result.out, Says("/pathfinder\n", "  obstacles_0.28.json "));
  EXPECT_THAT(result.out, Not(HasSubstr("not valid")));
  EXPECT_THAT(result.out, HasSubstr("open towards the start; the goal lies behind it.\n"));
}

TEST_F(CliTools, ParametersAsTableAndCsv) {
  const CommandResult csv =
      RunTo(0, {"parameters", Scenario("nominal"), "--csv", "--origin", "assumed"});
  EXPECT_THAT(csv.out, StartsWith("path,kind,value"));
  EXPECT_THAT(csv.out, HasSubstr("referee.no_path_distance_m"));
  RunTo(2, {"parameters", "--origin", "guessed"});
  const CommandResult found = Run({"parameters", "--csv", "--search", "SLOPE_deg"});
  EXPECT_THAT(found.out, HasSubstr("\nterrain.ground.slope_deg,"));
  EXPECT_THAT(found.out, Not(HasSubstr("referee.no_path_distance_m")));
  EXPECT_THAT(Run({"parameters", "--search", "moore"}).out, HasSubstr("terrain.rocks.k_per_m2"))
      << "in the source alone";
  EXPECT_THAT(RunTo(2, {"parameters", "--search", "blurgh"}).err,
              HasSubstr("no parameter has \"blurgh\""));
  EXPECT_THAT(Run({"parameters"}).out, HasSubstr("| "));
}

TEST_F(CliTools, CompareAndCheck) {
  RunTo(0, QuickRun("runs/a", 3));
  RunTo(0, With(QuickRun("other/b", 3), {"--set", "name=b"}));
  const CommandResult compare = RunTo(0, {"compare", "runs/a", "other/b"});
  EXPECT_THAT(compare.out, Says("3 pairs", "equal rocks and equal noise"));
  Run(With(QuickRun("dense", 3), {"--set", "terrain.rocks.k_per_m2=0.01"}));
  const CommandResult other = Run({"compare", "runs/a", "dense", "--csv", "columns.csv"});
  EXPECT_THAT(other.out, Says("other settings of terrain", "every column: --all"));
  EXPECT_LT(other.out.find("terrain.rocks.k_per_m2"), other.out.find("declared success"));
  EXPECT_EQ(other.out.find("final_x_m"), std::string::npos);
  const CommandResult whole = Run({"compare", "runs/a", "dense", "--all"});
  EXPECT_THAT(whole.out, Says("final_x_m", "true_distance_m"));
  EXPECT_EQ(whole.out.find("every column"), std::string::npos);
  EXPECT_THAT(ReadFile(work() / "columns.csv"), HasSubstr("all,true_distance_m,m,3,"));

  const std::string reference = Source("results/reference/matthies1995.json");
  const CommandResult check = Run({"check", "runs", "other/b", "--against", reference, "--junit",
                                   "junit.xml", "--csv", "table.csv", "--replicates", "200"});
  // Three trials that all end after one second: whether that differs is not the question here.
  EXPECT_THAT((std::vector<int>{0, 1, 4}), testing::Contains(check.exit_code)) << check.err;
  EXPECT_THAT(check.out, HasSubstr("nominal"));
  EXPECT_THAT(check.err, Says("  JUnit report in junit.xml\n", "  table in table.csv\n"));
  EXPECT_THAT(ReadFile(work() / "junit.xml"), HasSubstr("<testsuite"));
  EXPECT_THAT(ReadFile(work() / "table.csv"), StartsWith("id,scenario"));

  RunTo(0, QuickRun("runs/again", 1));
  EXPECT_THAT(RunTo(2, {"check", "runs", "--against", reference}).err,
              HasSubstr("is a run of nominal, and so is"));
}

TEST_F(CliTools, RoverIsDescribed) {
  const CommandResult result =
      RunTo(0, {"rover", Scenario("nominal"), "--set", "rover.mass.wheel_kg=0.6"});
  EXPECT_THAT(result.out, StartsWith("rover of nominal\n"));
  EXPECT_THAT(result.out, Says("0.65 x 0.48 x 0.3 m", "wheels 6 x 0.6", "9.81 m/s2"));
  EXPECT_TRUE(NothingWritten());
  const CommandResult help = Run({"rover", "--help"});
  EXPECT_THAT(help.out, HasSubstr("Examples:\n  rockyard rover"));
}

TEST_F(CliTools, RoverOfAFileOfItsOwn) {
  const std::string file = Source("scenarios/rovers/mfex.json");
  const CommandResult result = RunTo(0, {"rover", file, "--set", "rover.mass.wheel_kg=0.25"});
  EXPECT_THAT(result.out, StartsWith("rover of mfex\n"));
  EXPECT_THAT(result.out, Says("11.5 kg", "wheels 6 x 0.25"));
  WriteFile(work() / "odd.json", "{\"geometry\": {\"legs\": 4}}");
  EXPECT_THAT(Run({"rover", "odd.json"}).err, HasSubstr("rover.geometry.legs"));
}

TEST_F(CliTools, RoverAsUrdf) {
  const CommandResult result = RunTo(0, {"rover", Scenario("nominal"), "--out", "rocky.urdf"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "  URDF in rocky.urdf\n");
  EXPECT_THAT(ReadFile(work() / "rocky.urdf"), StartsWith("<?xml"));
  EXPECT_THAT(ReadFile(work() / "rocky.urdf"), HasSubstr("<robot name=\"rover\">"));
}

// What the file does not say is listed, and may come from another rover.
TEST_F(CliTools, RoverOfAUrdfFile) {
  const std::string mfex = Source("scenarios/rovers/mfex.json");
  RunTo(0, {"rover", mfex, "--out", "mine.urdf"});
  const CommandResult read = RunTo(0, {"rover", "mine.urdf"});
  EXPECT_THAT(read.out, StartsWith("rover of mine\n"));
  EXPECT_THAT(read.out,
              Says("11.5 kg", "0.0067 m/s", "stall at 2.3 Nm",
                   "the file does not say, so that the default stays",
                   "\n  rover.drive.ramp_s = 0.1\n", "rover.contact.stiffness_N_m = 50000"));
  EXPECT_THAT(read.out, Not(HasSubstr("rockyard's rover has not")));
  const CommandResult written =
      RunTo(0, {"rover", "mine.urdf", "--set", "rover.drive.ramp_s=0.2", "--out", "mine.json"});
  EXPECT_EQ(written.err, "  rover in mine.json\n");
  EXPECT_THAT(written.out, Not(HasSubstr("ramp_s")));
  const json group = json::parse(ReadFile(work() / "mine.json"));
  EXPECT_EQ(group["drive"]["ramp_s"], 0.2);
  EXPECT_EQ(group["geometry"]["wheel_radius_m"], 0.065);
  EXPECT_FALSE(group.contains("contact"));
  WriteFile(work() / "both.json", R"({"name": "both", "rover": {"extends": [")" + mfex +
                                      R"(", "mine.json"], "drive": {"ramp_s": 0.1}}})");
  RunTo(0, {"rover", "both.json", "--out", "both.rover.json"});
  RunTo(0, {"rover", mfex, "--out", "mfex.rover.json"});
  EXPECT_EQ(ReadFile(work() / "both.rover.json"), ReadFile(work() / "mfex.rover.json"));
}

TEST_F(CliTools, RoverOfAUrdfFileThatIsNone) {
  RunTo(0, {"rover", Scenario("nominal"), "--out", "mine.urdf"});
  std::string text = ReadFile(work() / "mine.urdf");
  const std::string box = "<box size=\"0.4 ";
  WriteFile(work() / "wide.urdf", text.replace(text.rfind(box), box.size(), "<box size=\"40 "));
  const CommandResult wide = Run({"rover", "wide.urdf", "--out", "wide.json"});
  EXPECT_EQ(wide.exit_code, 2);
  EXPECT_THAT(wide.err, Says("wide.urdf: rover.geometry.belly_length_m", "above the largest",
                             "collision of link \"chassis\""));
  RunTo(0, {"rover", "wide.urdf", "--set", "rover.geometry.belly_length_m=0.4"});
  WriteFile(work() / "none.urdf", "\n<robot><link name=\"a\"/></robot>");
  const CommandResult none = Run({"rover", "none.urdf"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("none.urdf: has 0 wheels"));
  EXPECT_FALSE(fs::exists(work() / "wide.json"));
}

TEST_F(CliTools, OutputsThatCannotBeMeantAreRefusedBeforeTheWork) {
  const std::vector<std::pair<Words, std::string>> refused = {
      {{"rover", Scenario("nominal"), "--out", "rover.xml"}, "does not end in .urdf"},
      {{"rover", Scenario("nominal"), "--out", "no/rover.urdf"}, "in a folder that does not exist"},
      {{"terrain", Scenario("nominal"), "--out", "no/field.svg"},
       "in a folder that does not exist"},
      {{"terrain", Scenario("nominal"), "--out", "field.png"}, "no known extension"}};
  for (const auto& [words, reason] : refused) {
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.err, HasSubstr("--out")) << words[0];
    EXPECT_THAT(result.err, HasSubstr(reason)) << words[0];
    EXPECT_TRUE(NothingWritten());
  }
}

TEST_F(CliTools, Terrain) {
  const CommandResult result = RunTo(0, {"terrain", Scenario("nominal"), "--out", "field.svg"});
  EXPECT_EQ(result.err, "  terrain in field.svg\n");
  EXPECT_THAT(ReadFile(work() / "field.svg"), HasSubstr("<svg"));
}

// What somebody sees who does not know the program yet; the scenarios and rovers that come with it,
// by their names.

TEST_F(CliStart, TheCommandAloneSaysWhatToDo) {
  const CommandResult alone = RunTo(0, {});
  EXPECT_EQ(alone.err, "");
  EXPECT_THAT(alone.out, AllOf(StartsWith("rockyard simulates"), HasSubstr("README.md"),
                               HasSubstr("  rockyard list "), HasSubstr("  rockyard run nominal "),
                               HasSubstr("\n  sweep       Runs scenarios")));
  EXPECT_EQ(Run({"help"}).out, alone.out);
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliStart, ItsFirstRunWorksAnywhere) {
  EXPECT_THAT(
      RunTo(0, {"run", "nominal", "--trials", "20", "--set", "rover.fidelity=quasi_static"}).out,
      HasSubstr("next: "));
}

TEST_F(CliStart, HelpOfACommandIsWhatItsOptionShows) {
  EXPECT_EQ(Run({"help", "run"}).out, Run({"run", "--help"}).out);
  EXPECT_EQ(Run({"help", "plan", "claim"}).out, Run({"plan", "claim", "--help"}).out);
  EXPECT_THAT(RunTo(2, {"help", "rnu"}).err,
              Says("error: help: \"rnu\" is no subcommand of rockyard", "did you mean \"run\"?"));
}

TEST_F(CliStart, PagesOfEveryCommandIntoAFolder) {
  RunTo(0, {"help", "--format", "man", "--out", "man"});
  EXPECT_EQ(ReadFile(work() / "man/rockyard-run.1"), Run({"help", "run", "--format", "man"}).out);
  EXPECT_EQ(ReadFile(work() / "man/rockyard.1"), Run({"help", "--format", "man"}).out);
  RunTo(0, {"help", "--format", "markdown", "--out", "md"});
  EXPECT_EQ(ReadFile(work() / "md/README.md"), Run({"help", "--format", "markdown"}).out);
  for (const Words& words :
       {Words{"help", "--out", "x"}, {"help", "run", "--format", "man", "--out", "x"}}) {
    EXPECT_THAT(RunTo(2, words).err, HasSubstr("error: --out: is for the pages of all commands"));
  }
}

using CliFind = CommandTest;

TEST_F(CliFind, AreTheFilesOfThatName) {
  const std::string file = Source("scenarios/pathfinder/nominal.json");
  const std::string fingerprint = Run({"validate", file}).out.substr(file.size());
  for (const char* name : {"nominal", "pathfinder/nominal", "nominal.json"}) {
    const CommandResult result = RunTo(0, {"validate", name});
    EXPECT_TRUE(result.out.ends_with(fingerprint)) << result.out;
  }
  EXPECT_THAT(Run({"run", "nominal", "--dry-run"}).out, StartsWith("nominal, seed 1: 300 trials"));
  EXPECT_THAT(Run({"trace", "nominal", "--trial", "0", "--set", "rover.fidelity=quasi_static"}).out,
              StartsWith("nominal, seed 1, trial 0"));
  RunTo(0, {"terrain", "vl2", "--out", "field.svg"});
}

TEST_F(CliFind, AMistypedPathSuggestsTheName) {
  for (const char* word : {"nominl", "scenarios/pathfinder/nominl.json", "Nominal"}) {
    EXPECT_THAT(RunTo(2, {"run", word}).err, HasSubstr("did you mean \"nominal\"?")) << word;
  }
}

TEST_F(CliFind, ErrorsNameTheKindThatIsMeant) {
  EXPECT_THAT(Run({"sweep", "nominal"}).err, HasSubstr("is no file, and no name of a sweep\n"));
  EXPECT_THAT(Run({"run", "mfex"}).err, HasSubstr("is no file, and no name of a scenario\n"));
  EXPECT_THAT(Run({"rover", "abc"}).err, HasSubstr("no name of a scenario or rover\n"));
  EXPECT_THAT(Run({"validate", "abc"}).err, HasSubstr("no name of a scenario or sweep\n"));
}

TEST_F(CliFind, ARoverByItsFileAlone) {
  const CommandResult rover = RunTo(0, {"rover", "athena_sdm"});
  EXPECT_THAT(rover.out, StartsWith("rover of athena_sdm\n"));
  EXPECT_THAT(rover.out, HasSubstr("61.8 kg"));
  EXPECT_THAT(Run({"rover", "athena_sdm", "--set", "rover.mass.total_kg=70"}).out,
              HasSubstr("70 kg"));
}

}  // namespace
}  // namespace rockyard::app
