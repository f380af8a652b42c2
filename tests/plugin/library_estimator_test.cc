// Estimators of shared libraries: what comes through the C interface, and what one that fails does.
#include "plugin/library_estimator.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "asking.h"
#include "core/refusals.h"
#include "plugin/library.h"
#include "whole_estimator_messages.h"

namespace rockyard::plugin {
namespace {

using localization::AidUse;
using localization::EstimatorSetup;
using navigation::FaultKind;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const OpenedLibrary& Opened() {
  static const OpenedLibrary kOpened = [] {
    const std::filesystem::path file = std::string(PLUGIN_FOLDER) + "/estimators.so";
    return OpenLibrary(file, HashOfLibrary(file));
  }();
  return kOpened;
}
const EstimatorSource& Told() { return *Opened().estimators.at(0); }
const EstimatorSource& Faulty() { return *Opened().estimators.at(1); }

std::unique_ptr<localization::Estimator> Make(const EstimatorSource& source,
                                              std::string_view json = "{}",
                                              const EstimatorSetup& setup = {}) {
  Parameters parameters(source.description());
  core::ReadParams(core::ParseJson(json, "test"), parameters);
  return source.Make(parameters, setup);
}

// Matches own values that are these numbers; NaN is NaN.
auto AreNumbers(const Numbers& numbers) {
  std::vector<testing::Matcher<double>> each;
  for (const double number : numbers) each.push_back(testing::NanSensitiveDoubleEq(number));
  return testing::ElementsAreArray(each);
}

TEST(LibraryEstimatorTest, IsDescribedAsItWasDeclared) {
  ASSERT_THAT(Opened().estimators, SizeIs(2));
  ASSERT_THAT(Opened().navigators, SizeIs(1)) << "a library may hold both";
  EXPECT_EQ(Opened().navigators[0]->description().name, "idle");
  const ForeignEstimatorKind told(Opened().estimators[0]);
  EXPECT_EQ(told.name(), "told");
  EXPECT_EQ(told.doc(), "tells what it is told");
  EXPECT_TRUE(told.foreign());
  EXPECT_TRUE(told.takes_fixes());
  EXPECT_FALSE(told.takes_motions());
  ASSERT_THAT(told.own_values(), SizeIs(kShownNumbers));
  EXPECT_EQ(told.own_values()[7].name, "v7");
  EXPECT_EQ(told.own_values()[7].unit, "1");
  EXPECT_EQ(told.own_values()[7].meaning, "a number that it was told");
  const ForeignEstimatorKind faulty(Opened().estimators[1]);
  EXPECT_EQ(faulty.name(), "faulty");
  EXPECT_FALSE(faulty.takes_fixes());
  EXPECT_TRUE(faulty.takes_motions());
}

// Else a swap of two would not show.
TEST(WholeEstimatorMessages, HaveAnotherNumberInEachMember) {
  const localization::EstimatorMemory memory = WholeMemory();
  for (const Numbers& numbers :
       {NumbersOf(WholeSetup(&memory)), NumbersOf(WholeMotion()), NumbersOf(WholeFelt(), 0.5)}) {
    std::set<double> seen;
    for (const double number : numbers) {
      if (std::isnan(number) || number == std::floor(number)) continue;  // no number; yes or no
      EXPECT_TRUE(seen.insert(number).second) << number;
    }
    EXPECT_GT(seen.size(), 12U);
  }
}

TEST(LibraryEstimatorTest, SetupsArriveWhole) {
  localization::EstimatorMemory memory = WholeMemory();
  const auto expect_arrives = [](const EstimatorSetup& setup) {
    EXPECT_THAT(Make(Told(), "{}", setup)->own_values(), AreNumbers(NumbersOf(setup)));
  };
  expect_arrives(WholeSetup(&memory));
  memory.covariance.reset();
  expect_arrives(WholeSetup(&memory));
  EstimatorSetup setup = WholeSetup(nullptr);
  expect_arrives(setup);
  setup.lander.reset();
  expect_arrives(setup);
  expect_arrives({});
}

TEST(LibraryEstimatorTest, WhatItIsToldArrivesWhole) {
  const auto told = Make(Told());
  told->Propagate(WholeMotion());
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(WholeMotion())));
  messages::VehicleState felt = WholeFelt();
  const std::function<void()> take[] = {
      [] {}, [&] { felt.articulation.reset(); }, [&] { felt.specific_force_R.reset(); },
      [&] { felt.motor_current_A.reset(); }, [&] { felt.contact.reset(); }};
  for (const auto& one : take) {
    one();
    told->Feel(felt, 0.09375);
    EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(felt, 0.09375)));
  }
  for (const bool mirrored : {false, true}) {
    const messages::PoseUpdate update{1.5, 2.5, 0.25, mirrored};
    told->Place(update);
    EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(update)));
  }
  told->Capture(9007199254740993);
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(1, 9007199254740993)));
  told->Forget(12);
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(2, 12)));
  told->Update(WholeFix());
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(WholeFix())));
  told->Update(messages::PoseFix{});
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(messages::PoseFix{})));
  told->Update(WholeRelativeMotion());
  EXPECT_THAT(told->own_values(), AreNumbers(NumbersOf(WholeRelativeMotion())));
}

TEST(LibraryEstimatorTest, WhatItBelievesComesBackWhole) {
  for (const char* covariance : {"true", "false"}) {
    for (const char* world : {"true", "false"}) {
      const auto told = Make(Told(), std::string(R"({"has_covariance": )") + covariance +
                                         R"(, "has_world": )" + world + "}");
      messages::LocalizationEstimate expected = WholeEstimate();
      if (covariance == std::string("false")) expected.covariance.reset();
      if (world == std::string("false")) expected.world.reset();
      EXPECT_TRUE(Same(told->estimate(), expected)) << "at the start";
      told->Propagate({});
      expected.pose.x_m += 1.0;
      EXPECT_TRUE(Same(told->estimate(), expected));
    }
  }
}

TEST(LibraryEstimatorTest, WhatItRemembersComesBackWhole) {
  localization::EstimatorMemory memory = WholeMemory();
  for (const bool has_covariance : {true, false}) {
    if (!has_covariance) memory.covariance.reset();
    NumberList expected;
    NumberList remembered;
    AddMemory(memory, expected);
    AddMemory(Make(Told(), "{}", WholeSetup(&memory))->Remember(), remembered);
    EXPECT_THAT(remembered.Take(), AreNumbers(expected.Take()));
  }
  // Without a memory: that of the interface.
  EXPECT_EQ(Make(Told())->Remember().pose.heading_rad, WholeEstimate().pose.heading_rad);
}

TEST(LibraryEstimatorTest, SaysWhatItMadeOfAids) {
  for (int use = 0; use <= static_cast<int>(AidUse::kNoInterest); ++use) {
    const auto told = Make(Told(), "{\"use\": " + std::to_string(use) + "}");
    EXPECT_EQ(told->Update(messages::PoseFix{}), static_cast<AidUse>(use));
    EXPECT_EQ(told->Update(messages::RelativeMotion{}), static_cast<AidUse>(use));
  }
  for (const char* use : {R"({"use": -1})", R"({"use": 5})"}) {
    const auto told = Make(Told(), use);
    EXPECT_THAT(FaultOf([&] { told->Update(messages::PoseFix{}); }),
                IsFault(FaultKind::kNonsense, "estimator told: its use of an aid is"));
  }
}

TEST(LibraryEstimatorTest, ParametersAreCheckedByHostAndPlugin) {
  const auto problems = [](const char* json) {
    ForeignEstimatorKind kind(Opened().estimators[0]);
    return core::ProblemsIn([&] { core::ReadParams(core::ParseJson(json, "test"), kind); });
  };
  EXPECT_THAT(problems(R"({"low": 1.5})"), IsEmpty());
  EXPECT_THAT(problems(R"({"low": 3})"), core::OneProblem("low", "is above high", "use less"));
  EXPECT_THAT(problems(R"({"low": -3})"), core::OneProblem("low", "below the smallest"));
  ForeignEstimatorKind kind(Opened().estimators[0]);
  core::FieldTable table;
  kind.Visit(table);
  EXPECT_THAT(table.parameters(), SizeIs(5));
}

// A copy has parameters of its own.
TEST(LibraryEstimatorTest, KindsAreCopied) {
  const ForeignEstimatorKind kind(Opened().estimators[0]);
  const auto copy = kind.Clone();
  core::ReadParams(core::ParseJson(R"({"has_world": false})", "test"), *copy);
  EXPECT_TRUE(kind.Make({})->estimate().world.has_value());
  EXPECT_FALSE(copy->Make({})->estimate().world.has_value());
}

struct Failing {
  const char* fault;
  FaultKind kind;
  const char* words;
};

void PrintTo(const Failing& failing, std::ostream* out) { *out << failing.fault; }

class FailingEstimator : public testing::TestWithParam<Failing> {};

constexpr const char* kThrown = "estimator faulty: no way out of here";

INSTANTIATE_TEST_SUITE_P(
    Ways, FailingEstimator,
    testing::Values(
        Failing{"making", FaultKind::kThrew, kThrown},
        Failing{"makes_none", FaultKind::kThrew, "estimator faulty: it made no estimator"},
        Failing{"propagating", FaultKind::kThrew, kThrown},
        Failing{"feeling", FaultKind::kThrew, kThrown},
        Failing{"placing", FaultKind::kThrew, kThrown},
        Failing{"capturing", FaultKind::kThrew, kThrown},
        Failing{"forgetting", FaultKind::kThrew, kThrown},
        Failing{"fixing", FaultKind::kThrew, kThrown},
        Failing{"seeing", FaultKind::kThrew, kThrown},
        Failing{"remembering", FaultKind::kThrew, kThrown},
        Failing{"counting", FaultKind::kThrew, kThrown},
        Failing{"counts_too_few", FaultKind::kThrew, "estimator faulty: own_values() returns 0"},
        Failing{"throws_anything", FaultKind::kThrew, "estimator faulty: it threw something"},
        Failing{"no_number", FaultKind::kNonsense, "estimator faulty: attitude.pitch_rad is nan"},
        Failing{"infinite_variance", FaultKind::kNonsense,
                "estimator faulty: covariance of z and y is inf"},
        Failing{"no_world", FaultKind::kNonsense, "estimator faulty: world.x_m is nan"},
        Failing{"remembers_no_number", FaultKind::kNonsense,
                "estimator faulty: memory.gyro_scale is nan"}),
    [](const auto& way) { return std::string(way.param.fault); });

// Each function once, in the order of a drive.
TEST_P(FailingEstimator, IsAFaultThatNamesIt) {
  const std::string json = std::string(R"({"fault": ")") + GetParam().fault + "\"}";
  std::unique_ptr<localization::Estimator> estimator;
  const auto drive = [&] {
    estimator = Make(Faulty(), json);
    estimator->Propagate({});
    estimator->Feel({}, 0.5);
    estimator->Place({});
    estimator->Capture(0);
    estimator->Update(messages::PoseFix{});
    estimator->Update(messages::RelativeMotion{});
    estimator->Forget(0);
    estimator->own_values();
    estimator->Remember();
  };
  EXPECT_THAT(FaultOf(drive), IsFault(GetParam().kind, GetParam().words));
  // What it believed last can still be looked at: a record is made of it.
  if (estimator == nullptr) return;
  EXPECT_TRUE(std::isfinite(estimator->estimate().attitude.pitch_rad));
}

TEST(LibraryEstimatorTest, OneThatDoesNotFailGoesThroughAllOfIt) {
  const auto estimator = Make(Faulty());
  EXPECT_EQ(FaultOf([&] {
              estimator->Propagate({});
              estimator->own_values();
              estimator->Remember();
            }),
            "");
  EXPECT_THAT(estimator->own_values(), testing::ElementsAre(3.5));
}

// Each tick of `computes` takes 50 ms of the thread's time.
TEST(LibraryEstimatorTest, CpuTimeIsLimitedByCallAndByDrive) {
  EstimatorSetup setup;
  setup.call_cpu_s = 0.02;
  const auto hasty = Make(Faulty(), R"({"fault": "computes"})", setup);
  EXPECT_THAT(FaultOf([&] { hasty->Propagate({}); }),
              IsFault(FaultKind::kCpuTime, "estimator faulty: more than 0.02 s for one answer"));
  setup.call_cpu_s = 10.0;
  setup.drive_cpu_s = 0.07;
  const auto slow = Make(Faulty(), R"({"fault": "computes"})", setup);
  EXPECT_EQ(FaultOf([&] { slow->Propagate({}); }), "");
  EXPECT_THAT(FaultOf([&] { slow->Propagate({}); }),
              IsFault(FaultKind::kCpuTime, "estimator faulty: more than 0.07 s for one drive"));
}

}  // namespace
}  // namespace rockyard::plugin
