// Paths from motions against keyframes, against poses put together by hand.
#include "campaign/odometry/path_tracker.h"

#include <gtest/gtest.h>

namespace rockyard::campaign {
namespace {

using math::MakePose;
using math::Transform;

const Transform kStep = MakePose({0.5, 0.1, 0.0}, 0.2, 0.05, 0.0);

vision::OdometryStep Found(std::int64_t number, std::int64_t reference, bool keyframe,
                           const std::optional<Transform>& X_FS) {
  vision::OdometryStep step;
  step.number = number;
  step.reference = reference;
  step.keyframe = keyframe;
  if (X_FS) {
    step.result.motion.emplace();
    step.result.motion->X_FS = *X_FS;
    step.result.motion->covariance = vision::MotionCovariance::Identity();
  } else if (number != reference) {
    step.result.reason = vision::NoMotion::kFewMatches;
  }
  return step;
}

PathStep Place(PathTracker& tracker, const vision::OdometryStep& found,
               const std::optional<Transform>& predicted = std::nullopt) {
  PathStep step;
  tracker.Place(found, predicted, step);
  return step;
}

TEST(PathTracker, MotionsCountFromTheirKeyframe) {
  PathTracker tracker;
  EXPECT_TRUE(Place(tracker, Found(0, 0, true, {})).X_AB.isApprox(Transform::Identity()));
  EXPECT_TRUE(Place(tracker, Found(1, 0, false, kStep)).X_AB.isApprox(kStep));
  EXPECT_TRUE(Place(tracker, Found(2, 0, true, kStep * kStep)).X_AB.isApprox(kStep * kStep));
  const PathStep last = Place(tracker, Found(3, 2, false, kStep));
  EXPECT_TRUE(last.X_AB.isApprox(kStep * kStep * kStep));
  ASSERT_TRUE(last.covariance);
  // Two motions of unit covariance one after the other, with a lever: more than twice one.
  EXPECT_DOUBLE_EQ((*last.covariance)(5, 5), 2.0);
  EXPECT_GT((*last.covariance)(0, 0), 2.0);
}

TEST(PathTracker, TheCovarianceOfAKeyframeCountsOnce) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  Place(tracker, Found(1, 0, false, kStep));
  Place(tracker, Found(2, 0, false, kStep));
  EXPECT_DOUBLE_EQ((*Place(tracker, Found(3, 0, false, kStep)).covariance)(5, 5), 1.0);
}

TEST(PathTracker, GapsAreFilledByThePredictionAndLoseTheCovariance) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  Place(tracker, Found(1, 0, true, kStep));
  const Transform predicted = MakePose({0.4, 0.0, 0.0}, 0.0, 0.0, 0.0);
  const PathStep gap = Place(tracker, Found(2, 1, true, {}), predicted);
  EXPECT_TRUE(gap.X_AB.isApprox(kStep * predicted));
  EXPECT_FALSE(gap.covariance);
  const PathStep after = Place(tracker, Found(3, 2, false, kStep));
  EXPECT_TRUE(after.X_AB.isApprox(kStep * predicted * kStep));
  EXPECT_FALSE(after.covariance);

  PathTracker without;
  Place(without, Found(0, 0, true, {}));
  Place(without, Found(1, 0, false, kStep));
  EXPECT_TRUE(Place(without, Found(2, 0, true, {})).X_AB.isApprox(kStep));
}

TEST(PathTracker, PredictionsAreToldInTheKeyframe) {
  PathTracker tracker;
  Place(tracker, Found(0, 0, true, {}));
  EXPECT_FALSE(tracker.Predict(Prediction::kSteady, {}));
  EXPECT_TRUE(tracker.Predict(Prediction::kFile, kStep)->isApprox(kStep));
  EXPECT_FALSE(tracker.Predict(Prediction::kFile, {}));
  Place(tracker, Found(1, 0, false, kStep));
  // The keyframe is still the first pair: two steps from it.
  EXPECT_TRUE(tracker.Predict(Prediction::kSteady, {})->isApprox(kStep * kStep));
  EXPECT_FALSE(tracker.Predict(Prediction::kNone, kStep));
  Place(tracker, Found(2, 0, true, kStep * kStep));
  EXPECT_TRUE(tracker.Predict(Prediction::kSteady, {})->isApprox(kStep));
  const Transform other = MakePose({0.1, 0.0, 0.0}, 0.0, 0.0, 0.0);
  EXPECT_TRUE(tracker.Predict(Prediction::kFile, other)->isApprox(other));
  // A gap that nobody predicted says nothing of the next step.
  Place(tracker, Found(3, 2, true, {}));
  EXPECT_FALSE(tracker.Predict(Prediction::kSteady, {}));
}

}  // namespace
}  // namespace rockyard::campaign
