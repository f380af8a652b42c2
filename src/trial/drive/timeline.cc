#include "trial/drive/timeline.h"

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace rockyard::trial {

void Timeline::Pass(Activity activity, double duration_s) {
  ledger_.Spend(activity, duration_s);
  double left_s = duration_s;
  while (left_s > 0.0) {
    const double step_s = StepBeside(activity, left_s);
    if (step_s <= 0.0) return;
    left_s -= step_s;
  }
}

double Timeline::StepBeside(Activity activity, double left_s) {
  const bool images =
      cameras_ && cameras_->left_s > 0.0 && (overlap_.imaging || activity == Activity::kImaging);
  const bool computes = computer_ && (overlap_.computing || activity == Activity::kComputing);
  if (!images && !computes) return 0.0;
  double step_s = left_s;
  if (images) step_s = std::min(step_s, cameras_->left_s);
  if (computes) step_s = std::min(step_s, computer_->left_s);
  const auto go_on = [&](UnderWay& look, Activity stage) {
    look.left_s -= step_s;
    // A stage that the rover rests for is spent by the rest itself.
    if (stage != activity) ledger_.SpendBeside(stage, step_s);
  };
  if (images) go_on(*cameras_, Activity::kImaging);
  if (computes) go_on(*computer_, Activity::kComputing);
  Settle();
  return step_s;
}

void Timeline::Begin(std::unique_ptr<SeenLook> look) {
  EXPECT(TakesLook());
  EXPECT(look->percept.time.scanning_s == 0.0);
  const double imaging_s = look->percept.time.imaging_s;
  cameras_ = UnderWay{std::move(look), imaging_s};
  Settle();
}

void Timeline::Drop() {
  cameras_.reset();
  computer_.reset();
  ready_.clear();
}

void Timeline::Settle() {
  if (computer_ && computer_->left_s <= 0.0) {
    ready_.push_back(std::move(computer_->look));
    computer_.reset();
  }
  if (!cameras_ || cameras_->left_s > 0.0 || computer_) return;
  const double computing_s = cameras_->look->percept.time.computing_s;
  computer_ = UnderWay{std::move(cameras_->look), computing_s};
  cameras_.reset();
  // Computing may take no time.
  Settle();
}

std::optional<Timeline::Rest> Timeline::MustRest() const {
  if (cameras_ && cameras_->left_s > 0.0 && !overlap_.imaging) {
    return Rest{Activity::kImaging, cameras_->left_s};
  }
  if (computer_ && !overlap_.computing) return Rest{Activity::kComputing, computer_->left_s};
  return std::nullopt;
}

std::unique_ptr<SeenLook> Timeline::TakeReady() {
  if (ready_.empty()) return nullptr;
  std::unique_ptr<SeenLook> look = std::move(ready_.front());
  ready_.pop_front();
  return look;
}

}  // namespace rockyard::trial
