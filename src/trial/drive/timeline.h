// What goes on at one time in a drive, and what is ready when.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "messages/point_cloud.h"
#include "trial/clock/clock_params.h"
#include "trial/clock/ledger.h"
#include "trial/eyes/terrain_sensing.h"

namespace rockyard::trial {

// A look at the terrain on its way to the navigator.
struct SeenLook {
  // Null where the navigator does not read it.
  const messages::HazardReport* report() const {
    return percept.report ? &*percept.report : nullptr;
  }
  const messages::PointCloud* cloud() const { return percept.cloud ? &*percept.cloud : nullptr; }

  Percept percept;
  messages::LookMoment moment;
};

// The rover as a whole does one thing at a time: it drives, steers, rests. Looks may be under way
// beside that: the cameras take images, then the computer works on them. Each has place for one
// look; images wait in the cameras until the computer is free. The clock goes by what the rover as
// a whole does; what goes on beside it draws its own power for as long as it lasts, to the end of
// it within a tick. What may not overlap (OverlapParams) goes on only while the rover rests for it.
class Timeline {
 public:
  // `ledger` outlives it.
  Timeline(const OverlapParams& overlap, Ledger& ledger) : overlap_(overlap), ledger_(ledger) {}

  // The rover does this for so long.
  void Pass(Activity activity, double duration_s);

  // Whether the cameras are free.
  bool TakesLook() const { return !cameras_; }
  // Its images are taken from now on; they must be free. A look without scanning time.
  void Begin(std::unique_ptr<SeenLook> look);
  // What is under way or ready is of no use any more.
  void Drop();

  // What the rover has to rest for, and how long still: images first.
  struct Rest {
    Activity activity = Activity::kImaging;
    double duration_s = 0.0;
  };
  std::optional<Rest> MustRest() const;

  // The oldest look that is ready, once; null where there is none.
  std::unique_ptr<SeenLook> TakeReady();

 private:
  struct UnderWay {
    std::unique_ptr<SeenLook> look;
    double left_s = 0.0;  // of the stage that it is in
  };

  // Ends what has no time left.
  void Settle();
  // How long both go on as they do, of at most left_s; 0 where nothing is under way beside
  // `activity`.
  double StepBeside(Activity activity, double left_s);

  OverlapParams overlap_;
  Ledger& ledger_;
  std::optional<UnderWay> cameras_;
  std::optional<UnderWay> computer_;
  std::deque<std::unique_ptr<SeenLook>> ready_;
};

}  // namespace rockyard::trial
