// What does not move in a replay: course, ground, rocks; and the shapes of the rover.
#pragma once

#include "campaign/drive_recording.h"
#include "replay/data.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// Most heights of the drawn ground: rough ground of a wide arena is drawn more coarsely than 10 cm.
inline constexpr std::size_t kMaxHeights = 40000;

// Fills course, world, ground and rocks as they lay at the start. Throws core::UserError where the
// terrain cannot be built, which is a simulator fault of the trial.
void AddScene(const scenario::Scenario& scenario, const truth::TracedTrial& traced,
              replay::ReplayData& data);

// The links of the scenario's rover with the shapes that the simulation collides.
std::vector<replay::ReplayLink> LinksOf(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
