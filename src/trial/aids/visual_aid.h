// Visual odometry of one drive, on board: when it takes images, when a motion is ready, and what
// becomes of the motion. Onboard keeps it beside the reader of its images (sight/visual_reader.h).
// Records depend on it where visual odometry is enabled: on when images are due, and on when the
// computer (clock.compute) has a motion ready.
#pragma once

#include <cstdint>
#include <optional>

#include "localization/estimator.h"
#include "perception/visual_motion.h"
#include "trial/aids/aid_suite.h"
#include "trial/drive_params.h"
#include "trial/sight/visual_reader.h"

namespace rockyard::trial {

// Counts, columns of truth/drive_record.h but for `used`.
struct VisualCounts {
  std::int64_t steps = 0;      // pairs of images that were compared with others
  std::int64_t failures = 0;   // steps without a motion
  std::int64_t keyframes = 0;  // pairs that others were compared with
  std::int64_t used = 0;       // motions that the estimator took
  std::int64_t gated_out = 0;  // motions that the estimator turned away
};

// What the check of slip made of one motion, between two looks.
struct SlipReading {
  perception::MeasuredSlip seen;
  Eigen::Vector2d rolled_m = Eigen::Vector2d::Zero();  // by the wheels (perception::RolledWay)
  std::int64_t from = 0;                               // number of the first look
  std::int64_t to = 0;                                 // number of the second look
};

// A pair of images is due at the start, and then by way, turn or time since the last one
// (sensors.visual_odometry.schedule), whatever the navigator does. While the computer still works
// on one, no other is taken.
class VisualAid {
 public:
  // `captures` outlives it.
  VisualAid(const DriveParams& drive, CaptureCounter& captures);

  // Returns whether images are to be taken now.
  bool IsDue(const messages::LocalizationEstimate& believed, double time_s) const;

  // Return what a look takes (clock.compute). The first pair of a path takes no computing.
  double imaging_s() const { return imaging_s_; }
  double computing_s() const { return computing_s_; }

  // Returns where R is believed to be now, in R of the keyframe.
  math::Transform Expected(const messages::LocalizationEstimate& believed) const;
  // Takes what comes of a pair of images that is taken now; it is ready at `ready_s`. Returns
  // whether a motion is worked out, which takes computing_s.
  bool Take(const VisualStep& step, double time_s, double ready_s,
            localization::Estimator& estimator);

  // Hands in a motion that is ready. Returns whether the estimate was corrected.
  bool Tick(double time_s, localization::Estimator& estimator);

  // Drops what was seen before operators moved the rover.
  void OnPlaced();

  // Begins a new keyframe after an alarm of slip, with images that are due at once: the way that
  // raised the alarm counts once. No images are under way; callers renew the eyes as well.
  void BeginAnew(localization::Estimator& estimator);

  // Returns the slip of the last motion that was handed in, once; nothing where slip is not
  // checked.
  std::optional<SlipReading> TakeSlip();

  const VisualCounts& counts() const { return counts_; }

 private:
  // A pair of images whose moment the estimator keeps, and what was believed then.
  struct Moment {
    std::int64_t look = 0;
    messages::CaptureNumber capture = 0;
    messages::AttitudeEstimate attitude;
    messages::PoseEstimate odometry;
  };
  struct Waiting {
    double ready_s = 0.0;
    VisualStep step;
    Moment from;
    Moment to;
  };

  bool HandIn(const Waiting& waiting, localization::Estimator& estimator);
  void CheckSlip(const Waiting& waiting, const messages::RelativeMotion& seen);

  sensing::VisualMotionParams params_;
  perception::SlipCheckParams slip_params_;
  double tilt_sd_rad_;
  double imaging_s_;
  double computing_s_;
  CaptureCounter* captures_;

  std::optional<Moment> keyframe_;
  std::optional<Waiting> waiting_;
  messages::PoseEstimate last_odometry_;  // at the last look
  double last_time_s_ = 0.0;
  VisualCounts counts_;
  std::optional<SlipReading> slip_;
};

}  // namespace rockyard::trial
