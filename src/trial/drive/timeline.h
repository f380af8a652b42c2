// What goes on at one time in a drive, and when looks are ready: Drive passes all time of the rover
// as a whole through it. Records depend on it: the navigator gets a look at the first decision
// after it is ready, looks in the order in which they were taken.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "messages/point_cloud.h"
#include "trial/clock/clock_params.h"
#include "trial/clock/ledger.h"
#include "trial/sight/terrain_sensing.h"

namespace rockyard::trial {

// A look at the terrain on its way to the navigator.
struct SeenLook {
  // Return report, cloud or images; null where the navigator does not read such.
  const messages::HazardReport* report() const {
    return percept.report ? &*percept.report : nullptr;
  }
  const messages::PointCloud* cloud() const { return percept.cloud ? &*percept.cloud : nullptr; }
  const messages::LookImages* images() const { return percept.images ? &*percept.images : nullptr; }

  Percept percept;
  messages::LookMoment moment;
};

// The rover as a whole does one thing at a time: it drives, steers, rests. Looks may be under way
// beside that: the cameras take the images of a look, then the computer works on them. Cameras and
// computer each have place for one look; images wait in the cameras until the computer is free. The
// clock goes by what the rover as a whole does; a stage of a look beside it draws its own power
// until the stage ends, also within a tick. A stage that may not overlap (OverlapParams) goes on
// only while the rover rests for it.
class Timeline {
 public:
  // `ledger` outlives it.
  Timeline(const OverlapParams& overlap, Ledger& ledger) : overlap_(overlap), ledger_(ledger) {}

  // Lets the rover do one thing for some time.
  void Pass(Activity activity, double duration_s);

  // Returns whether the cameras are free.
  bool TakesLook() const { return !cameras_; }
  // Begins to take the images of a look without scanning time; the cameras must be free.
  void Begin(std::unique_ptr<SeenLook> look);
  // Drops all looks that are under way or ready.
  void Drop();

  // What the rover has to rest for.
  struct Rest {
    Activity activity = Activity::kImaging;
    double duration_s = 0.0;  // that is left
  };
  // Returns what the rover has to rest for, images before computing; nothing where it may go on.
  std::optional<Rest> MustRest() const;

  // Returns the oldest look that is ready, once; null where there is none.
  std::unique_ptr<SeenLook> TakeReady();

 private:
  struct UnderWay {
    std::unique_ptr<SeenLook> look;
    double left_s = 0.0;  // of the stage that the look is in
  };

  // Ends stages that have no time left.
  void Settle();
  // Lets cameras and computer go on until one of their stages ends, for left_s at most. Returns for
  // how long; 0 where nothing goes on beside `activity`.
  double StepBeside(Activity activity, double left_s);

  OverlapParams overlap_;
  Ledger& ledger_;
  std::optional<UnderWay> cameras_;
  std::optional<UnderWay> computer_;
  std::deque<std::unique_ptr<SeenLook>> ready_;
};

}  // namespace rockyard::trial
