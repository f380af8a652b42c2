// Ablations of runs and sweeps, and the blind swath, with the real command.

#include <cmath>
#include <sstream>

#include "app/command.h"

namespace rockyard::app {
namespace {

using testing::IsEmpty;

class CliAblation : public CommandTest {
 protected:
  json Resolved(const std::string& folder) const {
    return json::parse(ReadFile(work() / folder / "scenario.resolved.json"))["scenario"];
  }
  // Goals that operators designate with errors.
  CommandResult RunAblated(const std::string& folder, const Words& more) const {
    return Run(With(With(QuickRun(folder, 3), {"--set", "course.designation.enabled=true", "--set",
                                               "rover.fidelity=quasi_static"}),
                    more));
  }
  void ExpectRefused(const Words& words, const std::string& message) const {
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(words);
    EXPECT_THAT(result.err, HasSubstr(message)) << testing::PrintToString(words);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_TRUE(NothingWritten()) << testing::PrintToString(words);
  }
};

TEST_F(CliAblation, ListTellsEachWithItsSettings) {
  const CommandResult result = RunTo(0, {"list", "--ablations"});
  for (const char* name : {"perfect_designation", "perfect_localization", "perfect_sensing",
                           "perfect_path_selection", "no_avoidance", "no_slip"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string(name) + ": "));
  }
  EXPECT_THAT(result.out, HasSubstr("    localization.estimator=oracle\n"));
}

TEST_F(CliAblation, ChangesTheRunAndIsTold) {
  ASSERT_EQ(RunAblated("plain", {}).exit_code, 0);
  EXPECT_THAT(Summary("plain")["ablations"], IsEmpty());
  const CommandResult result =
      RunAblated("ablated", {"--ablate", "perfect_localization", "--ablate", "no_slip"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Summary("ablated")["ablations"], json({"perfect_localization", "no_slip"}));
  EXPECT_EQ(Resolved("ablated")["localization"]["estimator"], "oracle");
  EXPECT_EQ(Resolved("ablated")["terrain"]["ground"]["soil"]["friction_angle_deg"], 60);
  EXPECT_NE(Summary("ablated")["trial_hash"], Summary("plain")["trial_hash"]);
  EXPECT_THAT(result.out, Says("ablations: no_slip", "perfect localization"));
  EXPECT_THAT(result.err, Not(HasSubstr("changes nothing")));
}

// A run is what its settings are, however they were asked for.
TEST_F(CliAblation, IsTheSameAsItsSettings) {
  ASSERT_EQ(RunAblated("ablated", {"--ablate", "perfect_localization"}).exit_code, 0);
  ASSERT_EQ(RunAblated("set", {"--set", "localization.estimator=oracle"}).exit_code, 0);
  EXPECT_EQ(Summary("set")["ablations"], json({"perfect_localization"}));
  EXPECT_EQ(Summary("set")["trial_hash"], Summary("ablated")["trial_hash"]);
}

TEST_F(CliAblation, TellsWhatHasNoEffect) {
  EXPECT_THAT(RunTo(0, With(QuickRun("idle", 2), {"--ablate", "perfect_designation"})).err,
              HasSubstr("--ablate perfect_designation changes nothing"));
  EXPECT_THAT(RunAblated("told", {"--ablate", "perfect_designation"}).err,
              Not(HasSubstr("changes nothing")));
  EXPECT_THAT(Run(With(QuickRun("quiet", 2), {"--ablate", "perfect_designation", "--quiet"})).err,
              Not(HasSubstr("changes nothing")));
}

TEST_F(CliAblation, RefusesWhatCannotBe) {
  ExpectRefused(With(QuickRun("a", 2), {"--ablate", "perfect_localisation"}),
                "did you mean \"perfect_localization\"?");
  ExpectRefused(With(QuickRun("a", 2), {"--ablate", ""}), "--ablate: is empty");
  ExpectRefused(With(QuickRun("a", 2), {"--ablate"}), "--ablate");
  ExpectRefused(With(QuickRun("a", 2), {"--ablate", "no_slip", "--ablate", "no_slip"}), "twice");
  ExpectRefused(
      With(QuickRun("a", 2), {"--ablate", "no_avoidance", "--ablate", "perfect_path_selection"}),
      "\"no_avoidance\" is undone by another one");
}

TEST_F(CliAblation, GoesOnWithTheSameAblationsAlone) {
  ASSERT_EQ(RunAblated("a", {"--ablate", "perfect_localization"}).exit_code, 0);
  const CommandResult other = RunAblated("a", {"--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("localization.estimator"));
  EXPECT_EQ(RunAblated("a", {"--ablate", "perfect_localization", "--resume"}).exit_code, 0);
}

constexpr const char* kFactorial = R"({
  "name": "factorial", "trials": 4, "seed": 4, "common_random_numbers": true,
  "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 30,
          "course.goal_x_m": 3, "course.designation.enabled": true},
  "axes": [{"name": "goal", "ablation": "perfect_designation"},
           {"name": "pose, <believed>", "ablation": "perfect_localization"}]
})";

TEST_F(CliAblation, ASweepAlongThemAttributesFailures) {
  WriteFile(work() / "factorial.json", kFactorial);
  const CommandResult one = Run({"sweep", "factorial.json", "--out", "one", "--threads", "1"});
  const CommandResult two = Run({"sweep", "factorial.json", "--out", "two", "--threads", "2"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_THAT(one.out, Says("attribution of failures, true success: 4 paired trials",
                            "Shapley share", "these need not sum"));
  const std::string csv = ReadFile(work() / "one" / "attribution.csv");
  EXPECT_THAT(csv, HasSubstr(",true success,share,\"pose, <believed>\","));
  EXPECT_EQ(csv, ReadFile(work() / "two" / "attribution.csv"));
  const json attribution = Summary("one")["attribution"];
  ASSERT_EQ(attribution.size(), 2u);
  EXPECT_EQ(attribution, Summary("two")["attribution"]);
  EXPECT_EQ(Summary("one")["trial_hash"], Summary("two")["trial_hash"]);
  // Without common numbers there are no pairs, and no table.
  std::string independent = kFactorial;
  independent.replace(independent.find(": true"), 6, ": false");
  WriteFile(work() / "independent.json", independent);
  const CommandResult apart = RunTo(0, {"sweep", "independent.json", "--out", "apart"});
  EXPECT_THAT(apart.out, Not(HasSubstr("Shapley share")));
  EXPECT_FALSE(fs::exists(work() / "apart" / "attribution.csv"));
}

TEST_F(CliAblation, SweepsRefuseUnknownAndContraryOnes) {
  WriteFile(work() / "bad.json", R"({"axes": [{"ablation": "no_slp"}]})");
  EXPECT_THAT(RunTo(2, {"sweep", "bad.json", "--out", "a"}).err,
              HasSubstr("did you mean \"no_slip\"?"));
  WriteFile(work() / "bad.json",
            R"({"axes": [{"ablation": "no_avoidance"}, {"ablation": "perfect_path_selection"}]})");
  EXPECT_THAT(RunTo(2, {"sweep", "bad.json", "--out", "a"}).err,
              HasSubstr("undone by another one"));
  EXPECT_FALSE(fs::exists(work() / "a"));
}

// A field that the closed form holds for: round rocks, anywhere, with no clear zones.
Words Swath(const std::string& scenario, const Words& more) {
  Words words{"terrain", scenario, "--blind-swath"};
  for (const char* setting : {"terrain.rocks.overlap=allow", "terrain.rocks.clear_radius_m=0",
                              "terrain.rocks.min_width_ratio=1", "terrain.rocks.max_width_ratio=1",
                              "terrain.rocks.max_diameter_m=1", "terrain.rocks.k_per_m2=0.004"}) {
    words.insert(words.end(), {"--set", setting});
  }
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Moore's law N(D) = k D^-2.66 per m2: with W = 0.5 m, rocks from 0.2 m to 1 m,
// 1 / lambda = k (W (0.2^-2.66 - 1) + 2.66 / 1.66 (0.2^-1.66 - 1)).
TEST_F(CliAblation, BlindSwathPrintsTheClosedFormBesideFields) {
  const double per_m =
      0.004 * (0.5 * (std::pow(0.2, -2.66) - 1.0) + 2.66 / 1.66 * (std::pow(0.2, -1.66) - 1.0));
  const CommandResult result = RunTo(
      0,
      Swath(Scenario("nominal"), {"--width", "0.5", "--min-diameter", "0.2", "--fields", "400"}));
  EXPECT_THAT(result.out, HasSubstr("blind swath of 0.50 m, rocks of 0.200 m and more"));
  const std::string across = " across: ";
  ASSERT_THAT(result.out, HasSubstr(across));
  EXPECT_NEAR(std::stod(result.out.substr(result.out.find(across) + across.size())), per_m, 6e-5);
  std::istringstream lines(result.out);
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(lines, line);
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    double x_m = 0.0;
    double closed = 0.0;
    double fields = 0.0;
    double low = 0.0;
    double high = 0.0;
    std::string dots;
    ASSERT_TRUE(std::istringstream(line) >> x_m >> closed >> fields >> low >> dots >> high) << line;
    EXPECT_NEAR(closed, 100.0 * std::exp(-per_m * x_m), 0.06) << line;
    EXPECT_GE(closed, low - 4.0) << line;
    EXPECT_LE(closed, high + 4.0) << line;
  }
  EXPECT_EQ(rows, 8);
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliAblation, BlindSwathTakesTheRoverByDefault) {
  const CommandResult rover = Run(Swath(Scenario("nominal"), {"--fields", "10"}));
  const CommandResult wide = RunTo(
      0, Swath(Scenario("nominal"), {"--fields", "10", "--set", "rover.geometry.width_m=0.6"}));
  EXPECT_THAT(wide.out, HasSubstr("blind swath of 0.60 m"));
  EXPECT_NE(wide.out, rover.out);
  EXPECT_NE(Run(Swath(Scenario("nominal"), {"--fields", "10", "--seed", "9"})).out, rover.out);
}

// The closed forms are tests/terrain/placement_statistics_test's; here: every rule has its rows,
// and a scenario's own rule does not hide the others.
TEST_F(CliAblation, DensityShowsEveryPlacementRule) {
  const CommandResult result = RunTo(0, {"terrain", Scenario("nominal"), "--density", "--fields",
                                         "50", "--set", "terrain.rocks.mirror_line=keep_off"});
  EXPECT_THAT(result.out, HasSubstr("within 0.5 m of the course, 50 fields"));
  for (const char* row : {"merge       relocate     0.10 .. 0.20", "merge       allow        0.50",
                          "merge       reject       0.30", "keep_off    relocate     0.20",
                          "keep_off    reject       0.10"}) {
    EXPECT_THAT(result.out, HasSubstr(row));
  }
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 2 + 5 * 4);
  const CommandResult counts = Run({"terrain", Scenario("obstacles_0.57"), "--density"});
  EXPECT_THAT(counts.out, HasSubstr("1000 fields"));
  EXPECT_THAT(counts.out, Not(HasSubstr("reject")));
  const CommandResult open = Run({"terrain", Scenario("nominal"), "--density", "--fields", "2",
                                  "--set", "terrain.arena.kind=open"});
  EXPECT_THAT(open.out, HasSubstr("none        relocate"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliAblation, DensityRefusesBadOptions) {
  const std::string nominal = Scenario("nominal");
  ExpectRefused({"terrain", nominal, "--density", "--blind-swath"}, "--blind-swath");
  ExpectRefused({"terrain", nominal, "--density", "--out", "a.svg"}, "--out");
  ExpectRefused({"terrain", nominal, "--fields", "5", "--out", "a.svg"}, "--out");
  ExpectRefused({"terrain", nominal, "--density", "--fields", "0"}, "--fields");
  ExpectRefused({"terrain", nominal, "--density", "--set", "course.goal_y_m=0.4"}, "terrain");
}

TEST_F(CliAblation, BlindSwathRefusesBadOptions) {
  const std::string nominal = Scenario("nominal");
  ExpectRefused({"terrain", nominal}, "--out");
  ExpectRefused({"terrain", nominal, "--blind-swath", "--out", "a.svg"}, "--out");
  ExpectRefused({"terrain", nominal, "--out", "a.svg", "--width", "1"}, "--blind-swath");
  for (const char* option : {"--width", "--min-diameter"}) {
    for (const char* value : {"-1", "1000", "nan", "inf", "wide", ""}) {
      ExpectRefused({"terrain", nominal, "--blind-swath", option, value}, option);
    }
  }
  for (const char* value : {"0", "-5", "1e3", "1000001", ""}) {
    ExpectRefused({"terrain", nominal, "--blind-swath", "--fields", value}, "--fields");
  }
  ExpectRefused({"terrain", nominal, "--blind-swath", "--set", "course.goal_x_m=1"},
                "course.goal_x_m");
  ExpectRefused({"terrain", "none.json", "--blind-swath"}, "none.json");
}

}  // namespace
}  // namespace rockyard::app
