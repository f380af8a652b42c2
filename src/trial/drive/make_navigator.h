// The navigator of a drive, with the wrappers that every drive puts around it. Drive makes one at
// its start; records depend on the order of the wrappers (navigation/event_gate.h,
// stuck_reaction.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/random.h"
#include "messages/estimates.h"
#include "navigation/event_gate.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Makes the navigator of the scenario, which drives to `goals`, one at least, in their order; a
// route that it is told to follow is planned before anything moves. A plugin or process that fails
// to begin gives a navigator that fails when it is first asked, when there is a drive that can end
// by it. tick_s: of control. Where they are not empty, `on_asked` is told of each question, and
// `on_end` of what a plugin or process took.
std::unique_ptr<navigation::Navigator> MakeNavigator(
    const DriveParams& drive, const terrain::Terrain& terrain, core::TrialKey key,
    const std::vector<messages::Goal>& goals, double tick_s, navigation::AskedListener on_asked,
    std::function<void(const messages::NavigatorUse&)> on_end = {});

}  // namespace rockyard::trial
