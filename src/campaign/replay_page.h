// The 3-D replay of one trial as a page for a browser, and its plan view. `rockyard replay` writes
// one; reports write one of each trial that they choose. No record depends on it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "campaign/trial_source.h"
#include "replay/data.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// Returns all that is known of a recorded drive, but for title, command and whether it repeats a
// stored record, which who asked for the drive knows. Throws core::UserError where the terrain
// cannot be built, which is a simulator fault of the trial. Cost: that of building the terrain.
replay::ReplayData DataOf(const scenario::Scenario& scenario, const std::string& cell,
                          DriveRecording recording);

// All that can be shown of a trial that was driven again.
struct ReplayedTrial {
  replay::ReplayData data;
  std::string plan_svg;  // plan view in the manner of Matthies 1995, figure 16
};

// Drives the trial again and takes down its course. A trial that ends in a simulator fault is shown
// up to the fault. Throws core::UserError where the scenario is no drive. Cost: that of the trial,
// and less than as much again.
ReplayedTrial ReplayTrial(const TrialSource& source, std::uint64_t trial);

// Returns what the page is given, as JSON. Must have the form of src/web/replay/payload.ts. A
// second trial is shown beside the first.
std::string ReplayPayload(const ReplayedTrial& replayed, const ReplayedTrial* beside = nullptr);

// Drives the trial again and writes its page to `path`, atomically, where the drive repeats the
// stored record bit for bit or there is none. Otherwise writes nothing and returns false. Throws
// core::UserError: no drive, pages not built, `path` cannot be written.
bool WriteReplayPage(const TrialSource& source, std::uint64_t trial,
                     const std::filesystem::path& path);

// The most heights of the drawn ground: rough ground of a wide arena is drawn more coarsely than 10
// cm.
inline constexpr std::size_t kMaxHeights = 40000;

// Fills what does not move: course, world, ground, and rocks as they lay at the start. Throws
// core::UserError where the terrain cannot be built, which is a simulator fault of the trial.
void AddScene(const scenario::Scenario& scenario, const truth::TracedTrial& traced,
              replay::ReplayData& data);

// Returns the links of the scenario's rover with the shapes that the simulation collides.
std::vector<replay::ReplayLink> LinksOf(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
