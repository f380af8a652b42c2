// Tells a watcher what the navigator of a drive shows (navigation::Navigator::overlay). Must stay:
// without a watcher no navigator is asked, and a drive is the same with one and without.
#pragma once

#include "navigation/event_gate.h"
#include "trial/drive/world.h"
#include "trial/watchers.h"

namespace rockyard::trial {

// Returns a listener for the gate of events: asks the navigator after each decision what it shows,
// and tells `watch` where that is something else than before, with the truth of the moment. Returns
// an empty one where `watch` is empty. A navigator that fails to say it is asked no more. `world`
// outlives the listener. Memory: one overlay. Cost: that of comparing two.
navigation::AskedListener TellsOverlays(const OverlayWatcher& watch, const World& world);

}  // namespace rockyard::trial
