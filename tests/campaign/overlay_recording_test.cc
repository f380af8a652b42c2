// What a navigator shows, from its drive to the data of the replay page.
#include <gmock/gmock.h>

#include <stdexcept>

#include "campaign/replay_payloads.h"
#include "campaign/trial_source.h"
#include "navigation/showing_navigator.h"

namespace rockyard::campaign {
namespace {

using messages::Overlay;
using navigation::LineTo;
using navigation::ShowingParams;
using navigation::WithShowing;
using testing::SizeIs;

TrialSource SourceWith(const ShowingParams& params) {
  TrialSource source;
  source.scenario = WithShowing(params);
  source.seed = 1;
  source.request = "pathfinder/nominal";
  return source;
}

TEST(OverlayRecording, ThePageHasWhatWasShownAndWhen) {
  const ShowingParams params{.shows = [](int decision) { return LineTo(decision / 2); }};
  const Json payload = PayloadOf(SourceWith(params), 0);
  const Json& overlays = payload["overlays"];
  EXPECT_EQ(overlays["every"], 1);
  ASSERT_THAT(overlays["shown"], SizeIs(5));
  for (std::size_t i = 0; i < 5; ++i) {
    const Json& overlay = overlays["shown"][i];
    EXPECT_EQ(overlay["lines"][0]["points"][1][0], static_cast<double>(i));
    EXPECT_NEAR(overlay["t"].get<double>(), params.seen->times_s[2 * i], 1e-4);
    EXPECT_NEAR(overlay["believed"]["x"].get<double>(), params.seen->believed[2 * i].x_m, 1e-4);
  }
}

TEST(OverlayRecording, ADriveThatShowsNothingHasNone) {
  EXPECT_TRUE(
      PayloadOf(SourceWith({.shows = [](int) { return std::nullopt; }}), 0)["overlays"].is_null());
  EXPECT_TRUE(PayloadOf(SourceOf("pathfinder/nominal", {"referee.time_limit_s=20"}), 0)["overlays"]
                  .is_null());
}

TEST(OverlayRecording, AFailureIsAnEventAndTakesWhatWasShownAway) {
  const Json payload = PayloadOf(SourceWith({.shows = [](int decision) -> std::optional<Overlay> {
                                   if (decision == 2) throw std::runtime_error("no paint");
                                   return LineTo(decision);
                                 }}),
                                 0);
  ASSERT_THAT(payload["overlays"]["shown"], SizeIs(3));
  EXPECT_TRUE(payload["overlays"]["shown"][2]["lines"].empty());
  int told = 0;
  for (const Json& event : payload["events"]) {
    if (event["kind"] != "overlay") continue;
    EXPECT_EQ(event["detail"], "no paint");
    EXPECT_EQ(event["t"], payload["overlays"]["shown"][2]["t"]);
    ++told;
  }
  EXPECT_EQ(told, 1);
}

// Nine of 8 MB and some bytes each, of which seven fit.
TEST(OverlayRecording, OfLargeOnesEverySecondIsKept) {
  constexpr int kSide = 1000;
  const DriveRecording recording = RecordDrive(
      WithShowing({.shows =
                       [](int decision) {
                         return Overlay{.lines = LineTo(decision).lines,
                                        .grids = {{"cost", 0, 0, 0.01, kSide, kSide,
                                                   std::vector<double>(kSide * kSide, 0.5)}}};
                       },
                   .decisions = 8}),
      1, 0);
  EXPECT_EQ(recording.overlay_every, 2U);
  ASSERT_THAT(recording.overlays, SizeIs(5));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(recording.overlays[i].shown.lines[0].points[1].x_m, 2.0 * static_cast<double>(i));
  }
}

}  // namespace
}  // namespace rockyard::campaign
