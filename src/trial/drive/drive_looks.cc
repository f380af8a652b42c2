// How a drive looks at the terrain, at rest or on the move, and takes images for visual odometry:
// the second half of Drive.
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "trial/clock/compute_profile.h"
#include "trial/drive/drive.h"

namespace rockyard::trial {

bool Drive::LooksOnTheMove(const navigation::NavigatorDecision& decision) const {
  const OverlapParams& overlap = params_.clock.overlap;
  return decision.looks_on_the_move && onboard_.terrain_sensing().LooksOnTheMove() &&
         (overlap.imaging || overlap.computing);
}

std::optional<Verdict> Drive::Look(messages::LookDirection direction) {
  // Looks under way were taken from farther back, and are dropped.
  timeline_.Drop();
  observer_.OnLook();
  if (auto verdict = Move({}, stop_)) return verdict;
  onboard_.terrain_sensing().Begin();
  do {
    seen_ = See(direction);
    const LookTime& time = seen_->percept.time;
    Rest(Activity::kScanning, time.scanning_s);
    Rest(Activity::kImaging, time.imaging_s);
    Rest(Activity::kComputing, time.computing_s);
    PropagateAtRest(time.total_s());
  } while (seen_->percept.look_again);
  tracer_.Look(direction, seen_->percept);
  const messages::HazardReport* report = seen_->report();
  const bool hazard = report != nullptr && report->any();
  observer_.OnReport(hazard, seen_->moment.number);
  return AskReferee(Activity::kScanning, 0, seen_->percept.time.total_s());
}

std::optional<Verdict> Drive::LookOnTheMove(messages::LookDirection direction) {
  if (!timeline_.TakesLook()) return std::nullopt;
  if (rolling_ && !params_.clock.overlap.imaging) {
    if (auto verdict = Move({}, stop_)) return verdict;
  }
  onboard_.terrain_sensing().Begin();
  std::unique_ptr<SeenLook> seen = See(direction);
  tracer_.Look(direction, seen->percept);
  timeline_.Begin(std::move(seen));
  return std::nullopt;
}

std::unique_ptr<SeenLook> Drive::See(messages::LookDirection direction) {
  const LookOrder order = onboard_.OrderLook(direction);
  observer_.OnSeen(order.number);
  return onboard_.TakeLook(order, world_.Look(order.direction, order.number), time_s());
}

std::optional<Verdict> Drive::RestFor(const Timeline::Rest& rest) {
  if (rolling_) Move({}, stop_);
  Rest(rest.activity, rest.duration_s);
  PropagateAtRest(rest.duration_s);
  return AskReferee(rest.activity, 0, rest.duration_s);
}

std::optional<Verdict> Drive::SeeMotion() {
  const OverlapParams& overlap = params_.clock.overlap;
  const bool rests = !overlap.imaging || !overlap.computing;
  if (rests && rolling_) {
    if (auto verdict = Move({}, stop_)) return verdict;
  }
  const double imaging_s = onboard_.vision().imaging_s();
  const double computing_s = onboard_.vision().computing_s();
  const double now_s = time_s();
  const VisualStep step = onboard_.ReadMotion(world_.LookForMotion());
  observer_.OnMotionSeen(step);
  const bool compares = onboard_.TakeMotion(step, now_s, now_s + imaging_s + computing_s);
  if (compares) tracer_.Vision(step);
  double rest_s = SpendOnVision(Activity::kImaging, imaging_s, overlap.imaging);
  // The first images have no others to be compared with.
  if (compares) rest_s += SpendOnVision(Activity::kComputing, computing_s, overlap.computing);
  if (rest_s <= 0.0) return std::nullopt;
  PropagateAtRest(rest_s);
  UseAids();
  return AskReferee(Activity::kComputing, 0, rest_s);
}

double Drive::SpendOnVision(Activity activity, double duration_s, bool beside) {
  if (!beside) {
    Rest(activity, duration_s);
    return duration_s;
  }
  ledger_.SpendBeside(activity, duration_s);
  return 0.0;
}

void Drive::ShowStep() {
  const messages::NavigationView* view = onboard_.navigator().view();
  if (!seen_ || seen_->cloud() == nullptr || view == nullptr) return;
  if (step_watcher_) {
    step_watcher_({params_, world_.field().terrain, observer_.LookedFrom(seen_->moment.number),
                   world_.key(), *view, *seen_->cloud(), seen_->moment});
  }
  tracer_.Votes(*view);
}

}  // namespace rockyard::trial
