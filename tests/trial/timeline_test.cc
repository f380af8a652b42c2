#include "trial/drive/timeline.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

constexpr OverlapParams kAll = {.imaging = true, .computing = true, .steering = true};

// 1 W whatever happens; images add 2 W, computing 4 W, steering 8 W, driving 16 W.
constexpr PowerBudget kPowers = {.base_W = 1.0,
                                 .driving_W = 16.0,
                                 .steering_W = 8.0,
                                 .stereo_imaging_W = 2.0,
                                 .computing_W = 4.0};

class TimelineTest : public testing::Test {
 protected:
  static std::unique_ptr<SeenLook> Look(std::int64_t number, double imaging_s, double computing_s) {
    auto look = std::make_unique<SeenLook>();
    look->percept.time = {.imaging_s = imaging_s, .computing_s = computing_s};
    look->moment.number = number;
    return look;
  }
  static std::optional<std::int64_t> Number(Timeline& timeline) {
    const auto look = timeline.TakeReady();
    if (!look) return std::nullopt;
    return look->moment.number;
  }
  double energy_J() const { return 3600.0 * ledger_.energy_wh(); }

  Ledger ledger_{kPowers, 0.0};
};

TEST_F(TimelineTest, WithoutALookItIsTheLedger) {
  Timeline timeline(kAll, ledger_);
  timeline.Pass(Activity::kDriving, 3.0);
  EXPECT_EQ(ledger_.time_s(), 3.0);
  EXPECT_DOUBLE_EQ(energy_J(), 3.0 * 17.0);
  EXPECT_EQ(Number(timeline), std::nullopt);
  EXPECT_FALSE(timeline.MustRest());
}

// Images from 0 to 1 s, computing from 1 to 3 s, while the rover drives.
TEST_F(TimelineTest, StagesFollowOneAnotherBesideTheDrive) {
  Timeline timeline(kAll, ledger_);
  timeline.Begin(Look(7, 1.0, 2.0));
  EXPECT_FALSE(timeline.TakesLook());
  timeline.Pass(Activity::kDriving, 0.75);
  EXPECT_FALSE(timeline.TakesLook());
  timeline.Pass(Activity::kDriving, 0.75);
  EXPECT_TRUE(timeline.TakesLook());
  EXPECT_EQ(ledger_.time_s(Activity::kImaging), 1.0);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 0.5);
  EXPECT_DOUBLE_EQ(energy_J(), 1.5 * 17.0 + 1.0 * 2.0 + 0.5 * 4.0);
  timeline.Pass(Activity::kDriving, 1.25);
  EXPECT_EQ(Number(timeline), std::nullopt);
  timeline.Pass(Activity::kDriving, 1.25);
  EXPECT_EQ(Number(timeline), 7);
  EXPECT_EQ(Number(timeline), std::nullopt);
  EXPECT_EQ(ledger_.time_s(), 4.0);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 2.0);
  EXPECT_DOUBLE_EQ(3600.0 * ledger_.energy_wh(Activity::kImaging), 2.0);
  EXPECT_DOUBLE_EQ(3600.0 * ledger_.energy_wh(Activity::kComputing), 8.0);
}

// The second look's images, from 1 to 2 s, wait for the computer, which is free at 4 s.
TEST_F(TimelineTest, ImagesWaitInTheCamerasForTheComputer) {
  Timeline timeline(kAll, ledger_);
  timeline.Begin(Look(0, 1.0, 3.0));
  timeline.Pass(Activity::kDriving, 1.0);
  timeline.Begin(Look(1, 1.0, 3.0));
  timeline.Pass(Activity::kDriving, 2.5);  // to 3.5 s
  EXPECT_FALSE(timeline.TakesLook());
  EXPECT_EQ(ledger_.time_s(Activity::kImaging), 2.0);
  timeline.Pass(Activity::kDriving, 3.25);  // to 6.75 s
  EXPECT_TRUE(timeline.TakesLook());
  EXPECT_EQ(Number(timeline), 0);
  EXPECT_EQ(Number(timeline), std::nullopt);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 5.75);
  timeline.Pass(Activity::kDriving, 0.25);
  EXPECT_EQ(Number(timeline), 1);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 6.0);
}

TEST_F(TimelineTest, LooksThatTakeNoTimeAreReadyAtOnceAndInOrder) {
  Timeline timeline(kAll, ledger_);
  timeline.Begin(Look(0, 0.0, 0.0));
  timeline.Begin(Look(1, 0.0, 0.0));
  EXPECT_EQ(Number(timeline), 0);
  EXPECT_EQ(Number(timeline), 1);
}

// Its time stands still until the rover rests for it, and then the rest pays for it.
TEST_F(TimelineTest, WhatMayNotOverlapWaitsForARest) {
  Timeline timeline({.imaging = true}, ledger_);
  timeline.Begin(Look(0, 1.0, 2.0));
  EXPECT_FALSE(timeline.MustRest());
  timeline.Pass(Activity::kDriving, 5.0);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 0.0);
  ASSERT_TRUE(timeline.MustRest());
  EXPECT_EQ(timeline.MustRest()->activity, Activity::kComputing);
  EXPECT_EQ(timeline.MustRest()->duration_s, 2.0);
  timeline.Pass(Activity::kOverhead, 1.0);  // another rest
  EXPECT_EQ(timeline.MustRest()->duration_s, 2.0);
  timeline.Pass(Activity::kComputing, 2.0);
  EXPECT_FALSE(timeline.MustRest());
  EXPECT_EQ(Number(timeline), 0);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 2.0);
  EXPECT_DOUBLE_EQ(energy_J(), 5.0 * 17.0 + 1.0 * 2.0 + 3.0 * 5.0);
}

TEST_F(TimelineTest, ImagesThatMayNotOverlapAreRestedForFirst) {
  Timeline timeline({.computing = true}, ledger_);
  timeline.Begin(Look(0, 1.0, 2.0));
  timeline.Pass(Activity::kDriving, 5.0);
  ASSERT_TRUE(timeline.MustRest());
  EXPECT_EQ(timeline.MustRest()->activity, Activity::kImaging);
  EXPECT_EQ(timeline.MustRest()->duration_s, 1.0);
  timeline.Pass(Activity::kImaging, 1.0);
  EXPECT_FALSE(timeline.MustRest());
  // The next images: the computer works on while the rover rests for them.
  timeline.Begin(Look(1, 1.5, 2.0));
  EXPECT_EQ(timeline.MustRest()->activity, Activity::kImaging);
  timeline.Pass(Activity::kImaging, 1.5);
  EXPECT_EQ(ledger_.time_s(Activity::kComputing), 1.5);
  EXPECT_EQ(ledger_.time_s(), 7.5);
  // They wait for the computer, and no rest would hasten that.
  EXPECT_FALSE(timeline.TakesLook());
  EXPECT_FALSE(timeline.MustRest());
  timeline.Pass(Activity::kDriving, 0.5);
  EXPECT_EQ(Number(timeline), 0);
}

TEST_F(TimelineTest, WhatIsDroppedIsNeverReady) {
  Timeline timeline(kAll, ledger_);
  timeline.Begin(Look(0, 0.0, 0.0));
  timeline.Begin(Look(1, 0.0, 1.0));
  timeline.Begin(Look(2, 1.0, 1.0));
  timeline.Drop();
  EXPECT_TRUE(timeline.TakesLook());
  timeline.Pass(Activity::kDriving, 5.0);
  EXPECT_EQ(Number(timeline), std::nullopt);
  EXPECT_DOUBLE_EQ(energy_J(), 5.0 * 17.0);
}

}  // namespace
}  // namespace rockyard::trial
