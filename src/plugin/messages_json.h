// The messages between the command and a navigator's process, as JSON (docs/navigators.md has the
// list). Must stay, for processes that are written: names, units and what an absent member means;
// another meaning is another protocol.
#pragma once

#include <span>

#include "core/json_value.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::plugin {

// Return what a request holds.
core::JsonValue PlaceToJson(const messages::Goal& place);
core::JsonValue PoseToJson(const messages::PoseEstimate& pose);
core::JsonValue SetupToJson(const navigation::NavigatorSetup& setup);
core::JsonValue InputToJson(const navigation::NavigatorInput& input);

// Return what an answer holds. Throw navigation::NavigatorFault where a member is of a wrong type
// or an unknown name. Absent members of a decision: it drives, stops, does not look, and is asked
// at events.
navigation::NavigatorDecision DecisionFromJson(const core::JsonValue& answer);
messages::Overlay OverlayFromJson(const core::JsonValue& answer);
// Reads as many numbers as there are places.
void OwnValuesFromJson(const core::JsonValue& list, std::span<double> values);

}  // namespace rockyard::plugin
