// The 3-D replay of one trial as a page for a browser, and its plan view.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "campaign/trial_source.h"
#include "replay/data.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// A trial that was driven again: all that can be shown of it.
struct ReplayedTrial {
  replay::ReplayData data;
  std::string plan_svg;  // plan view in the manner of Matthies 1995, figure 16
};

// Drives the trial again and takes down its course. A trial that ends in a simulator fault is shown
// up to the fault. Throws core::UserError where the scenario is no drive. Cost: that of the trial,
// and less than as much again.
ReplayedTrial ReplayTrial(const TrialSource& source, std::uint64_t trial);

// What the page is given (src/web/replay/payload.ts), as JSON; a second trial is shown beside the
// first.
std::string ReplayPayload(const ReplayedTrial& replayed, const ReplayedTrial* beside = nullptr);

// Drives the trial again and writes its page to `path`, atomically, where the drive repeats the
// stored record bit for bit or there is none. Otherwise writes nothing and returns false. Throws
// core::UserError: no drive, pages not built, `path` cannot be written.
bool WriteReplayPage(const TrialSource& source, std::uint64_t trial,
                     const std::filesystem::path& path);

// What does not move in a replay: course, ground, rocks; and the shapes of the rover.

// Most heights of the drawn ground: rough ground of a wide arena is drawn more coarsely than 10 cm.
inline constexpr std::size_t kMaxHeights = 40000;

// Fills course, world, ground and rocks as they lay at the start. Throws core::UserError where the
// terrain cannot be built, which is a simulator fault of the trial.
void AddScene(const scenario::Scenario& scenario, const truth::TracedTrial& traced,
              replay::ReplayData& data);

// The links of the scenario's rover with the shapes that the simulation collides.
std::vector<replay::ReplayLink> LinksOf(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
