// What a navigator shows, as a watcher of its drive is told.
#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "navigation/navigator_fault.h"
#include "navigation/showing_navigator.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using messages::Overlay;
using navigation::LineTo;
using navigation::ShowingParams;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Told {
  double time_s = 0.0;
  math::Pose2 pose;
  messages::PoseEstimate believed;
  Overlay overlay;
  std::string failure;
};

struct WatchedDrive {
  DriveResult result;
  truth::Trace trace;
  std::vector<Told> told;
  int begun = 0;
};

WatchedDrive Watch(const ShowingParams& params) {
  WatchedDrive drive;
  const DriveParams with = WithShowing(params).drive;
  drive.result = RunTrial(
      with, {1, 0}, &drive.trace,
      {.overlay =
           [&](const WatchedOverlay& watched) {
             drive.told.push_back({watched.time_s, math::ToPose2(watched.X_WR), watched.believed,
                                   watched.overlay, std::string(watched.failure)});
           },
       .begin = [&] { ++drive.begun; }});
  return drive;
}

// Ends of the lines that were told; -1 where nothing is shown any more.
std::vector<double> EndsOf(const WatchedDrive& drive) {
  std::vector<double> ends;
  for (const Told& told : drive.told) {
    ends.push_back(told.overlay.lines.empty() ? -1.0 : told.overlay.lines[0].points.back().x_m);
  }
  return ends;
}

std::vector<std::string> DifferencesFromUnwatched(const ShowingParams& params,
                                                  const WatchedDrive& watched) {
  ShowingParams other = params;
  other.seen = std::make_shared<ShowingParams::Seen>();
  const DriveResult alone = RunTrial(WithShowing(other).drive, {1, 0});
  EXPECT_EQ(other.seen->shows, 0);
  EXPECT_EQ(other.seen->decisions, params.seen->decisions);
  return Differences(alone, watched.result);
}

TEST(OverlayOfADrive, IsAskedForOnlyWhereSomebodyWatches) {
  const ShowingParams params{.shows = [](int) { return LineTo(1.0); }};
  TracedTrial traced = RunTraced(WithShowing(params).drive, 0);
  EXPECT_EQ(params.seen->decisions, 9);
  EXPECT_EQ(params.seen->shows, 0);
}

TEST(OverlayOfADrive, IsAskedForOnceADecisionAndNotAtTheTicksBetween) {
  const ShowingParams params{.shows = [](int decision) { return LineTo(decision); }};
  const WatchedDrive drive = Watch(params);
  EXPECT_EQ(params.seen->shows, params.seen->decisions);
  EXPECT_GT(drive.trace.samples.size(), 10 * drive.told.size());
  EXPECT_THAT(EndsOf(drive), ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0));
  EXPECT_THAT(DifferencesFromUnwatched(params, drive), IsEmpty());
  EXPECT_EQ(drive.begun, 1);
}

TEST(OverlayOfADrive, IsToldWithTheMomentAndWhereTheRoverIs) {
  const ShowingParams params{.shows = [](int decision) { return LineTo(decision); }};
  const WatchedDrive drive = Watch(params);
  ASSERT_EQ(drive.told.size(), params.seen->believed.size());
  for (std::size_t i = 0; i < drive.told.size(); ++i) {
    const Told& told = drive.told[i];
    EXPECT_EQ(told.time_s, params.seen->times_s[i]);
    EXPECT_EQ(told.believed.x_m, params.seen->believed[i].x_m);
    // The last moment of the trace up to then; the first decision comes before all samples.
    math::Pose2 pose = drive.trace.rests.front().sample.pose;
    for (const truth::TraceSample& sample : drive.trace.samples) {
      if (sample.time_s <= told.time_s) pose = sample.pose;
    }
    EXPECT_EQ(told.pose.x_m, pose.x_m) << i;
    EXPECT_EQ(told.pose.heading_rad, pose.heading_rad) << i;
  }
  EXPECT_NE(drive.told.back().pose.x_m, drive.told.back().believed.x_m);
}

TEST(OverlayOfADrive, IsToldOnlyWhereItIsAnotherOne) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ShowingParams params{.shows = [](int decision) {
    const double value = decision < 5 ? 0.25 : 0.5;
    return Overlay{.lines = LineTo(decision / 3).lines,
                   .grids = {{"cost", 0.0, 0.0, 0.5, 2, 1, {kNan, value}}}};
  }};
  const WatchedDrive drive = Watch(params);
  EXPECT_THAT(EndsOf(drive), ElementsAre(0.0, 1.0, 1.0, 2.0));
  EXPECT_EQ(drive.told[1].overlay.grids[0].values[1], 0.25);
  EXPECT_EQ(drive.told[2].overlay.grids[0].values[1], 0.5);
}

// Null and empty say the same, and at the start nothing is shown anyway.
TEST(OverlayOfADrive, NothingIsToldOnceWhereItNoLongerShowsAnything) {
  const ShowingParams params{.shows = [](int decision) -> std::optional<Overlay> {
    if (decision < 2) return std::nullopt;
    if (decision < 4) return LineTo(2.0);
    if (decision < 6) return Overlay{};
    return std::nullopt;
  }};
  EXPECT_THAT(EndsOf(Watch(params)), ElementsAre(2.0, -1.0));
  EXPECT_THAT(EndsOf(Watch({.shows = [](int) { return std::nullopt; }})), IsEmpty());
}

// Whether it throws or shows what is none: the drive is the one that nobody watches.
TEST(OverlayOfADrive, AFailureIsToldOnceAndTheDriveGoesOn) {
  const auto fails = [](const std::function<Overlay()>& how) {
    const ShowingParams params{.shows = [how](int decision) -> std::optional<Overlay> {
      return decision < 3 ? LineTo(decision) : how();
    }};
    const WatchedDrive drive = Watch(params);
    EXPECT_THAT(EndsOf(drive), ElementsAre(0.0, 1.0, 2.0, -1.0));
    EXPECT_EQ(params.seen->shows, 4);
    EXPECT_THAT(DifferencesFromUnwatched(params, drive), IsEmpty());
    EXPECT_EQ(drive.told[0].failure, "");
    return drive.told.back().failure;
  };
  EXPECT_EQ(fails([]() -> Overlay { throw std::runtime_error("no paint"); }), "no paint");
  EXPECT_EQ(fails([]() -> Overlay {
              throw navigation::NavigatorFault(navigation::FaultKind::kNonsense, "too large");
            }),
            "too large");
  EXPECT_THAT(fails([] {
                return Overlay{.lines = {}, .grids = {{"cost", 0, 0, 0.5, 2, 2, {1.0}}}};
              }),
              HasSubstr("\"cost\" of its overlay has 1 values for 2 x 2 cells"));
  EXPECT_THAT(fails([] {
                return Overlay{.lines = {}, .grids = {{"cost", 0, 0, 0.0, 1, 1, {1.0}}}};
              }),
              HasSubstr("cells of 0 m"));
}

// A fault that may be the machine's is tried twice: what was shown of the first drive is void.
TEST(OverlayOfADrive, ADriveThatBeginsAgainSaysSo) {
  class Silent final : public navigation::Navigator {
   public:
    navigation::NavigatorDecision Decide(const navigation::NavigatorInput&) override {
      throw navigation::NavigatorFault(navigation::FaultKind::kSilent, "nothing");
    }
    void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
    void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
  };
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<ShowingParams>(
      {.name = "silent",
       .doc = "says nothing",
       .traits = [](const ShowingParams&) -> navigation::NavigatorTraits {
         return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {"tolerance_m", 0.1}};
       },
       .make = [](const ShowingParams&, const navigation::NavigatorSetup&)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Silent>(); }},
      {});
  const DriveParams drive =
      scenario::Shipped("pathfinder/nominal", {"navigation.navigator=silent"}, defaults).drive;
  int begun = 0;
  const DriveResult result = RunTrial(drive, {1, 0}, nullptr, {.begin = [&] { ++begun; }});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNavigatorFault);
  EXPECT_EQ(begun, 2);
}

}  // namespace
}  // namespace rockyard::trial
