// Navigators of shared libraries: what comes through the C interface, what a library that fails
// does, and that a library which is only asked what it is does no harm.
#include "plugin/library.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "asking.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "whole_messages.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using navigation::FaultKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::string FileOf(const std::string& library) {
  return std::string(PLUGIN_FOLDER) + "/" + library + ".so";
}

std::vector<std::shared_ptr<const NavigatorSource>> Open(const fs::path& file) {
  return OpenLibrary(file, HashOfLibrary(file)).navigators;
}

// Opens a library, and returns the navigator of that name.
std::shared_ptr<const NavigatorSource> Open(const std::string& library,
                                            const std::string& navigator) {
  for (const auto& source : Open(fs::path(FileOf(library)))) {
    if (source->description().name == navigator) return source;
  }
  throw std::runtime_error("no navigator " + navigator);
}

std::shared_ptr<const NavigatorSource> Echo() {
  static const auto kEcho = Open("echo", "echo");
  return kEcho;
}
std::shared_ptr<const NavigatorSource> EveryType() {
  static const auto kEveryType = Open("echo", "every_type");
  return kEveryType;
}

// Those of `members`, with a prefix.
std::map<std::string, double> Named(const std::string& prefix,
                                    const std::map<std::string, double>& members) {
  std::map<std::string, double> named;
  for (const auto& [path, value] : members) named[prefix + path] = value;
  return named;
}

TEST(LibraryTest, HasTheNavigatorsThatItNames) {
  const auto sources = Open(fs::path(FileOf("echo")));
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0]->name(), FileOf("echo"));
  EXPECT_EQ(sources[0]->description().name, "echo");
  EXPECT_EQ(sources[0]->description().doc, "tells what it is told");
  EXPECT_EQ(sources[1]->description().name, "every_type");
  const auto& own = sources[0]->description().own_values;
  ASSERT_EQ(own.size(), 2U);
  EXPECT_EQ(own[1].name, "last_time_s");
  EXPECT_EQ(own[1].unit, "s");
  EXPECT_EQ(own[1].meaning, "when it was asked last");
  EXPECT_TRUE(ForeignKind(sources[0]).foreign());
}

// Else a swap of two would not show.
TEST(WholeMessages, HaveAnotherNumberInEachMember) {
  const WholeInput whole;
  for (const auto& members : {MembersOf(whole.input), MembersOf(WholeSetup())}) {
    std::map<double, std::string> seen;
    for (const auto& [path, value] : members) {
      if (value == 0.0 || value == 1.0 || path.ends_with(".size")) continue;  // yes or no
      // Said twice on purpose: the first place is the goal, and a covariance is symmetric.
      if (path.starts_with("places[0]") || path.starts_with("covariance")) continue;
      EXPECT_TRUE(seen.emplace(value, path).second) << path << " and " << seen[value];
    }
    EXPECT_GT(seen.size(), 30U);
  }
  EXPECT_TRUE(MembersOf(whole.input).contains("covariance[5][5]"));
}

TEST(LibraryTest, SetupsArriveWhole) {
  for (const navigation::NavigatorSetup& setup :
       {WholeSetup(), navigation::NavigatorSetup{.goal = {1.0, 2.0}}}) {
    EXPECT_EQ(Shown(*Make(*Echo(), "{}", setup)), Named("setup.", MembersOf(setup)));
  }
}

// A map of heights, or of rocks, alone.
TEST(LibraryTest, AMapMayLackALayer) {
  navigation::NavigatorSetup setup = WholeSetup();
  for (const bool heights : {true, false}) {
    auto map = std::make_shared<messages::SiteMap>(*WholeSetup().site_map);
    (heights ? map->rock_share : map->height_m).clear();
    setup.site_map = map;
    EXPECT_EQ(Shown(*Make(*Echo(), "{}", setup)), Named("setup.", MembersOf(setup)));
  }
}

TEST(LibraryTest, InputsArriveWhole) {
  const WholeInput whole;
  const auto navigator = Make(*Echo());
  const auto expect_arrives = [&](const navigation::NavigatorInput& input) {
    navigator->Decide(input);
    EXPECT_EQ(Shown(*navigator), Named("input.", MembersOf(input)));
  };
  expect_arrives(whole.input);
  // Each of the parts that may not be there; then none of them.
  using Input = navigation::NavigatorInput;
  const std::function<void(Input&)> take[] = {
      [](Input& input) { input.report = nullptr; },
      [](Input& input) { input.cloud = nullptr; },
      [](Input& input) { input.look = nullptr; },
      [](Input& input) { input.vehicle_hazard = nullptr; },
      [](Input& input) { input.covariance = nullptr; },
      [](Input& input) { input.felt = nullptr; },
      [](Input& input) { std::swap(input.touches_behind, input.notices_stuck); },
      [](Input& input) { input = {}; }};
  for (const auto& one : take) {
    Input input = whole.input;
    one(input);
    expect_arrives(input);
  }
}

TEST(LibraryTest, SensorsThatARoverLacksAreEmpty) {
  WholeInput whole;
  const auto navigator = Make(*Echo());
  using Felt = messages::VehicleState;
  const std::function<void(Felt&)> take[] = {[](Felt& felt) { felt.articulation.reset(); },
                                             [](Felt& felt) { felt.specific_force_R.reset(); },
                                             [](Felt& felt) { felt.motor_current_A.reset(); },
                                             [](Felt& felt) { felt.contact.reset(); }};
  for (const auto& one : take) {
    one(whole.felt);  // one after the other, until none is left
    navigator->Decide(whole.input);
    EXPECT_EQ(Shown(*navigator), Named("input.", MembersOf(whole.input)));
  }
  whole.cloud.points_R.clear();
  whole.cloud.direction = messages::LookDirection::kAhead;
  whole.report.stripe_hazard = messages::PerStripe<bool>(messages::kMaxStripes, true);
  navigator->Decide(whole.input);
  EXPECT_EQ(Shown(*navigator), Named("input.", MembersOf(whole.input)));
}

TEST(LibraryTest, DecisionsComeBackWhole) {
  for (int status = 0; status < 4; ++status) {
    for (int look = 0; look < 3; ++look) {
      for (int kind = 0; kind < 3; ++kind) {
        const std::string json = "{\"status\": " + std::to_string(status) +
                                 ", \"look\": " + std::to_string(look) +
                                 ", \"kind\": " + std::to_string(kind) + "}";
        SCOPED_TRACE(json);
        auto expected = MembersOf(WholeDecision());
        expected["status"] = status;
        expected["look"] = look;
        expected["motion.kind"] = kind;
        EXPECT_EQ(MembersOf(Make(*Echo(), json)->Decide({})), expected);
      }
    }
  }
}

TEST(LibraryTest, JumpsAndGoalsAreTold) {
  const auto navigator = Make(*Echo());
  navigator->Decide({});
  const std::size_t before = Shown(*navigator).size();
  navigator->OnPoseUpdate({1.5, 2.5, 0.25, 3.5}, {4.5, 5.5, 0.5, 6.5});
  navigator->OnCorrection({7.5, 8.5, 0.75, 9.5}, {10.5, 11.5, 1.25, 12.5});
  navigator->SetGoal({13.5, 14.5}, navigation::GoalChange::kNext);
  navigator->SetGoal({15.5, 16.5}, navigation::GoalChange::kMoved);
  MemberList expected;
  expected.AddPose("update.before", {1.5, 2.5, 0.25, 3.5});
  expected.AddPose("update.after", {4.5, 5.5, 0.5, 6.5});
  expected.AddPose("correction.before", {7.5, 8.5, 0.75, 9.5});
  expected.AddPose("correction.after", {10.5, 11.5, 1.25, 12.5});
  expected.AddPlace("next", {13.5, 14.5});
  expected.AddPlace("moved", {15.5, 16.5});
  const auto shown = Shown(*navigator);
  EXPECT_EQ(shown.size(), before + expected.values().size());
  for (const auto& told : expected.values()) EXPECT_THAT(shown, testing::Contains(told));
}

TEST(LibraryTest, CountsItsOwnValues) {
  const auto navigator = Make(*Echo());
  EXPECT_THAT(navigator->own_values(), ElementsAre(0.0, 0.0));
  navigator->Decide({.time_s = 1.25});
  navigator->Decide({.time_s = 2.25});
  EXPECT_THAT(navigator->own_values(), ElementsAre(2.0, 2.25));
  // Another drive begins anew.
  EXPECT_THAT(Make(*Echo())->own_values(), ElementsAre(0.0, 0.0));
}

TEST(LibraryTest, ShowsGrids) {
  const auto navigator = Make(*Echo(), R"({"shows_grid": true})");
  navigator->Decide({});
  const messages::Overlay* overlay = navigator->overlay();
  ASSERT_NE(overlay, nullptr);
  ASSERT_EQ(overlay->grids.size(), 1U);
  const auto& [name, x0_m, y0_m, step_m, nx, ny, values] = overlay->grids[0];
  EXPECT_EQ(name, "cost");
  EXPECT_EQ(x0_m, 1.5);
  EXPECT_EQ(y0_m, 2.5);
  EXPECT_EQ(step_m, 0.25);
  EXPECT_EQ(nx, 2);
  EXPECT_EQ(ny, 1);
  EXPECT_THAT(values, ElementsAre(0.5, testing::IsNan()));
  EXPECT_EQ(Make(*Open("plain", "plain"))->overlay(), nullptr);
}

TEST(LibraryTest, ParametersAreDescribedAsTheyWereDeclared) {
  ForeignKind kind(EveryType());
  core::FieldTable table;
  kind.Visit(table);
  std::map<std::string, core::ParameterInfo> known;
  for (const core::ParameterInfo& each : table.parameters()) known[each.path] = each;
  EXPECT_EQ(known.size(), 11U);

  const core::ParameterInfo& real = known["real"];
  EXPECT_EQ(real.kind, core::FieldKind::kReal);
  EXPECT_EQ(real.min, -2.5);
  EXPECT_EQ(real.max, 2.5);
  EXPECT_EQ(real.origin, core::Origin::kAssumed);
  EXPECT_EQ(real.source, "nobody knows");
  EXPECT_EQ(real.doc, "a real \"number\"");
  EXPECT_EQ(real.study_low, 1.0);
  EXPECT_EQ(real.study_high, 2.0);
  EXPECT_EQ(known["angle_deg"].kind, core::FieldKind::kAngle);
  EXPECT_EQ(known["angle_deg"].max, 180.0);
  EXPECT_EQ(known["angle_deg"].origin, core::Origin::kPublished);
  EXPECT_EQ(known["integer"].kind, core::FieldKind::kInteger);
  EXPECT_EQ(known["integer"].origin, core::Origin::kCalibrated);
  EXPECT_EQ(known["integer"].min, -10.0);
  EXPECT_FALSE(known["integer"].HasStudyRange());
  EXPECT_EQ(known["boolean"].kind, core::FieldKind::kBoolean);
  EXPECT_EQ(known["boolean"].origin, core::Origin::kSetting);
  EXPECT_EQ(known["text"].kind, core::FieldKind::kText);
  EXPECT_EQ(known["reals"].kind, core::FieldKind::kReals);
  EXPECT_EQ(known["fixed"].fixed_length, 3U);
  EXPECT_EQ(known["integers"].kind, core::FieldKind::kIntegers);
  EXPECT_THAT(known["choice"].choices, ElementsAre("first", "second", "third"));
  EXPECT_EQ(known["inner.high"].doc, "upper end");
  EXPECT_EQ(std::ranges::count(table.groups(), "inner", &core::GroupInfo::path), 1);
}

constexpr const char* kAllChanged = R"({"real": -0.1, "angle_deg": 90, "integer": 9,
  "boolean": false, "text": "höher", "reals": [], "fixed": [0.1, 0.2, 0.3],
  "integers": [9007199254740993], "choice": "third", "inner": {"low": -1, "high": 1e300}})";

TEST(LibraryTest, ParametersArriveAsTheyWereSet) {
  EXPECT_EQ(Shown(*Make(*EveryType())),
            (std::map<std::string, double>{{"real", 1.5},
                                           {"angle_rad", 0.5},
                                           {"integer", -7.0},
                                           {"boolean", 1.0},
                                           {"text:a \"quoted\" \\ text\n\tof two lines", 0.0},
                                           {"reals[0]", 1.25},
                                           {"reals[1]", 2.25},
                                           {"reals.size", 2.0},
                                           {"fixed[0]", 3.25},
                                           {"fixed[1]", 4.25},
                                           {"fixed[2]", 5.25},
                                           {"fixed.size", 3.0},
                                           {"integers[0]", 6.0},
                                           {"integers[1]", -5.0},
                                           {"integers.size", 2.0},
                                           {"choice", 1.0},
                                           {"inner.low", 1.0},
                                           {"inner.high", 2.0}}));
  const auto shown = Shown(*Make(*EveryType(), kAllChanged));
  EXPECT_EQ(shown.at("real"), -0.1);
  EXPECT_EQ(shown.at("angle_rad"), math::DegToRad(90.0));
  EXPECT_EQ(shown.at("integer"), 9.0);
  EXPECT_EQ(shown.at("boolean"), 0.0);
  EXPECT_TRUE(shown.contains("text:höher"));
  EXPECT_EQ(shown.at("reals.size"), 0.0);
  EXPECT_EQ(shown.at("fixed[1]"), 0.2);
  EXPECT_EQ(shown.at("integers[0]"), static_cast<double>(std::int64_t{9007199254740993}));
  EXPECT_EQ(shown.at("choice"), 2.0);
  EXPECT_EQ(shown.at("inner.low"), -1.0);
  EXPECT_EQ(shown.at("inner.high"), 1e300);
}

TEST(LibraryTest, TraitsFollowTheParameters) {
  ForeignKind kind(EveryType());
  EXPECT_EQ(kind.traits().reads, navigation::LookReading::kHazardReport);
  EXPECT_TRUE(std::holds_alternative<navigation::CostOfJudgement>(kind.traits().cost));
  EXPECT_EQ(kind.traits().goal.path, "real");
  EXPECT_EQ(kind.traits().goal.tolerance_m, 1.5);
  EXPECT_TRUE(kind.traits().looks_on_the_move);
  EXPECT_FALSE(kind.traits().steers_on_the_move);
  core::ReadParams(core::ParseJson(R"({"real": 0.1, "boolean": false})", "test"), kind);
  EXPECT_EQ(kind.traits().goal.tolerance_m, 0.1);
  EXPECT_FALSE(kind.traits().looks_on_the_move);

  ForeignKind echo(Echo());
  EXPECT_EQ(echo.traits().reads, navigation::LookReading::kPoints);
  const auto cost = std::get<navigation::CostOfMap>(echo.traits().cost);
  EXPECT_EQ(cost.cell_m, 0.5);
  EXPECT_EQ(cost.area_m2, 25.0);
  core::ReadParams(core::ParseJson(R"({"kind": 2})", "test"), echo);
  EXPECT_TRUE(echo.traits().steers_on_the_move);
  EXPECT_FALSE(echo.traits().images);
  core::ReadParams(core::ParseJson(R"({"look": 1})", "test"), echo);
  EXPECT_TRUE(echo.traits().images);
}

// Both conditions of the plugin; bounds are the host's business.
TEST(LibraryTest, ConditionsAcrossParametersAreThePlugins) {
  const auto problems = [](const char* json) {
    ForeignKind kind(EveryType());
    return core::ProblemsIn([&] { core::ReadParams(core::ParseJson(json, "test"), kind); });
  };
  EXPECT_THAT(problems(kAllChanged), IsEmpty());
  EXPECT_THAT(problems(R"({"real": 2.3})"),
              core::OneProblem("real", "is too large", "use less than 2.25"));
  EXPECT_THAT(problems(R"({"inner": {"low": 3}})"),
              core::OneProblem("inner.low", "is above high", "use less"));
  EXPECT_THAT(problems(R"({"real": 2.6})"), core::OneProblem("real", "above the largest"));
  EXPECT_THAT(problems(R"({"choice": "thrid"})"), core::OneProblem("choice", "", "third"));
}

// What a plugin in another language may hand over, wrong or right.
TEST(LibraryTest, DecisionsThatCannotBeDoneAreFaults) {
  const auto plain = Open("plain", "plain");
  const auto fault = [&](const std::string& json) {
    return FaultOf([&] { Make(*plain, json)->Decide({}); });
  };
  EXPECT_EQ(fault("{}"), "");
  const std::pair<const char*, const char*> kWrong[] = {
      {R"({"status": 4})", "status"},       {R"({"status": -1})", "status"},
      {R"({"motion": 3})", "motion"},       {R"({"motion": -1})", "motion"},
      {R"({"direction": 0})", "direction"}, {R"({"direction": 2})", "direction"},
      {R"({"speed": 0})", "speed_share"},   {R"({"speed": 2})", "speed_share"},
      {R"({"ops": -1})", "work_ops"}};
  for (const auto& [json, words] : kWrong) {
    EXPECT_THAT(fault(json), IsFault(FaultKind::kNonsense, words)) << json;
  }
  EXPECT_THAT(fault(R"({"makes_none": true})"), IsFault(FaultKind::kThrew, "made no navigator"));
  // All 512 bytes, and none behind them.
  EXPECT_EQ(fault(R"({"fails": true})"), "threw: " + std::string(512, 'x'));
}

struct Failing {
  const char* navigator;
  FaultKind kind;
  const char* words;
};

void PrintTo(const Failing& failing, std::ostream* out) { *out << failing.navigator; }

class FailingPlugin : public testing::TestWithParam<Failing> {};

INSTANTIATE_TEST_SUITE_P(
    Ways, FailingPlugin,
    testing::Values(Failing{"throws", FaultKind::kThrew, "no way out of here"},
                    Failing{"throws_anything", FaultKind::kThrew, "no std::exception"},
                    Failing{"throws_where_made", FaultKind::kThrew, "no place to begin"},
                    Failing{"none", FaultKind::kThrew, "made no navigator"},
                    Failing{"no_number", FaultKind::kNonsense, "curvature_per_m is nan"},
                    Failing{"one_of_two", FaultKind::kThrew, "declares 2"}),
    [](const auto& way) { return std::string(way.param.navigator); });

TEST_P(FailingPlugin, IsAFaultOfItsNavigator) {
  const auto source = Open("faults", GetParam().navigator);
  const auto drive = [&] {
    const auto navigator = Make(*source);
    navigator->Decide({});
    navigator->own_values();
  };
  EXPECT_THAT(FaultOf(drive), IsFault(GetParam().kind, GetParam().words));
  // It stays what it is: the next drive fails in the same way.
  EXPECT_THAT(FaultOf(drive), IsFault(GetParam().kind, GetParam().words));
}

TEST(LibraryTest, WhatFailsBesideADecisionIsAFaultToo) {
  const auto navigator = Make(*Open("faults", "throws_where_told"));
  navigator->Decide({});
  EXPECT_THAT(FaultOf([&] { navigator->OnPoseUpdate({}, {}); }),
              IsFault(FaultKind::kThrew, "not to be moved"));
  EXPECT_THAT(FaultOf([&] { navigator->OnCorrection({}, {}); }),
              IsFault(FaultKind::kThrew, "not to be moved"));
  EXPECT_THAT(FaultOf([&] { navigator->SetGoal({}, navigation::GoalChange::kNext); }),
              IsFault(FaultKind::kThrew, "not to be sent"));
  EXPECT_THAT(FaultOf([&] { navigator->overlay(); }), IsFault(FaultKind::kThrew, "not to be seen"));
}

// Each decision of `computes` takes 50 ms of the thread's time.
TEST(LibraryTest, CpuTimeIsLimitedByAnswerAndByDrive) {
  const auto computes = Open("faults", "computes");
  navigation::NavigatorSetup setup;
  setup.limits.decision_cpu_s = 0.02;
  const auto hasty = Make(*computes, "{}", setup);
  EXPECT_THAT(FaultOf([&] { hasty->Decide({}); }),
              IsFault(FaultKind::kCpuTime, "more than 0.02 s for one answer"));

  setup.limits = {.decision_cpu_s = 10.0, .drive_cpu_s = 0.12};
  for (int drive = 0; drive < 2; ++drive) {  // each has the whole limit
    const auto navigator = Make(*computes, "{}", setup);
    EXPECT_EQ(FaultOf([&] { navigator->Decide({}); }), "");
    EXPECT_EQ(FaultOf([&] { navigator->Decide({}); }), "");
    EXPECT_THAT(FaultOf([&] { navigator->Decide({}); }),
                IsFault(FaultKind::kCpuTime, "more than 0.12 s for one drive"));
  }
}

// A machine that has too much to do lets plugins wait, and the simulation computes on this thread.
TEST(LibraryTest, WaitingIsNoComputingNorIsTheSimulation) {
  navigation::NavigatorSetup setup;
  setup.limits = {.decision_cpu_s = 0.02, .drive_cpu_s = 0.04};
  const auto navigator = Make(*Open("faults", "sleeps"), "{}", setup);
  const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 10;
  while (std::clock() < end) {
  }
  EXPECT_EQ(FaultOf([&] { navigator->Decide({}); }), "");
}

// Its child would go on with this drive and write into this store.
TEST(LibraryTest, AChildThatAPluginForksEndsThere) {
  auto* went_on = new (mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0)) std::atomic<int>(0);
  const auto navigator = Make(*Open("faults", "forks"));
  EXPECT_EQ(FaultOf([&] { navigator->Decide({}); }), "");
  ++*went_on;
  int status = 0;
  ASSERT_GT(wait(&status), 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  EXPECT_EQ(*went_on, 1);
  munmap(went_on, sizeof(std::atomic<int>));
}

struct Refused {
  const char* library;
  const char* words;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.library; }

class RefusedLibrary : public testing::TestWithParam<Refused> {};

INSTANTIATE_TEST_SUITE_P(
    Ways, RefusedLibrary,
    testing::Values(Refused{"wrong_abi",
                            "version 2 of the plugin interface, and this program has "
                            "version 1"},
                    Refused{"other_library", "no function rockyard_plugin"},
                    Refused{"undefined_symbol", "NobodyHasThis"},
                    Refused{"crashes", "crashed (SIGABRT)"},
                    Refused{"exits", "ended the process (exit code 3)"},
                    Refused{"no_navigators", "has neither navigators nor estimators"},
                    Refused{"no_info", "hands over nothing"},
                    Refused{"broken_description", "line 1"},
                    Refused{"not_there", "cannot be read"}),
    [](const auto& way) { return std::string(way.param.library); });

TEST_P(RefusedLibrary, IsNamedWithWhatIsWrong) {
  const std::string file = FileOf(GetParam().library);
  const auto problems = core::ProblemsIn([&] { Open(fs::path(file)); });
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].path, testing::StartsWith(file));
  EXPECT_THAT(problems[0].reason, HasSubstr(GetParam().words));
  EXPECT_NE(problems[0].suggestion, "");
  // The one that asks is unharmed.
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

// Answers of the command are read by programs.
TEST(LibraryTest, WhatItPrintsAsItIsAskedIsNoOutputOfTheCommand) {
  const core::TestFolder folder;
  const fs::path copy = folder.path() / "copy.so";  // no test has loaded it into this process
  fs::copy_file(FileOf("plain"), copy);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Open(copy);
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_THAT(err, HasSubstr("noise of a plugin that is loaded"));
  EXPECT_THAT(err, HasSubstr("noise of a plugin that is asked"));
}

// Before, its code runs in processes of its own.
TEST(LibraryTest, IsLoadedWhereADriveBegins) {
  const core::TestFolder folder;
  const fs::path copy = folder.path() / "copy.so";  // another file than what other tests load
  fs::copy_file(FileOf("echo"), copy);
  const auto loaded = [&] { return dlopen(copy.c_str(), RTLD_NOW | RTLD_NOLOAD) != nullptr; };
  const auto sources = Open(copy);
  ForeignKind kind(sources[0]);
  kind.traits();
  EXPECT_FALSE(loaded());
  kind.Make({});
  EXPECT_TRUE(loaded());
}

// What was hashed is what drives.
TEST(LibraryTest, ThatIsBuiltAnewMeanwhileDoesNotDrive) {
  const core::TestFolder folder;
  const fs::path copy = folder.path() / "copy.so";
  fs::copy_file(FileOf("echo"), copy);
  const auto source = Open(copy)[0];
  fs::copy_file(FileOf("faults"), copy, fs::copy_options::overwrite_existing);
  EXPECT_THROW(Make(*source), core::MachineError);
  EXPECT_THAT(core::RefusalOf([&] { Make(*source); }),
              testing::AllOf(HasSubstr("built anew"), HasSubstr(HashOfLibrary(copy))));
}

}  // namespace
}  // namespace rockyard::plugin
