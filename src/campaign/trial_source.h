// One trial to run again: of a scenario, or of a finished run whose record it must repeat; and
// drives that are recorded. Replays, traces and the replays of reports find and drive their trials
// here. No record depends on what is recorded, or none would repeat the stored one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/work.h"
#include "core/error.h"
#include "replay/data.h"
#include "scenario/scenario.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::campaign {

// The course of one drive, and what the rover saw and chose on the way.
struct DriveRecording {
  truth::TracedTrial traced;
  std::vector<replay::ReplayScan> scans;
  std::vector<replay::ReplayStep> steps;
  std::vector<replay::ReplayLook> looks;  // those that have images
  std::vector<replay::ReplayOverlay> overlays;
  std::size_t overlay_every = 1;  // one of so many overlays of the drive is in `overlays`
};

// The most points of one step that are kept, evenly spread over those that the look gave.
inline constexpr std::size_t kMaxStepPoints = 120;

// How much memory the overlays of a recording may take, where they are more than one. Where they
// would take more, only every second one is kept, or every fourth, ...
inline constexpr std::size_t kMaxOverlayMemoryBytes = 64'000'000;

// Drives the trial: a pure function of its arguments, with the record of the campaign, bit for bit.
// A simulator fault ends the recording where it happens. Throws core::UserError where the scenario
// is no drive. Memory: some 0.4 kB a control tick, 60 kB a step of a map-based navigator, 30 kB a
// look with images, and 64 MB of overlays at the most.
DriveRecording RecordDrive(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::uint64_t trial);

// Returns every moment of a recording in the order of time, with the angles of the rover's links.
std::vector<replay::ReplayPose> PosesOf(const scenario::Scenario& scenario,
                                        const truth::Trace& trace);

// Returns an SVG file in the manner of Matthies 1995, figure 16: octagons at the positions and of
// the sizes of rocks, true path solid, dead-reckoned path dotted, filled circles on both where
// obstacles were detected, an x at start and goal. Rocks lie where they lay at the start. Cost:
// that of building the terrain.
std::string PlanView(const scenario::Scenario& scenario, const truth::TracedTrial& traced);

// A trial to run again, and what a finished run says of it.
struct TrialSource {
  scenario::Scenario scenario;
  std::uint64_t seed = 1;
  std::string cell;     // name of the campaign's cell; "" for a run or a scenario
  std::string request;  // the words that name the trial again, but for --trial
  std::optional<truth::Record> stored;
  std::vector<std::string> builds;  // that wrote the run
};

// Finds the trial of a request. Throws core::UserError: no such scenario, run or trial, or --seed
// or --set with a run.
TrialSource FindTrial(const TrialRequest& request);

// Returns the trial of a run that has been read already: the trial `stored` of `cell`; absent where
// the trial is pending. `request` tells where run and cell are from. Throws core::UserError where
// the scenario is of another version of the program.
TrialSource StoredTrial(const TrialRequest& request, const batch::CellIdentity& cell,
                        std::vector<std::string> builds, std::optional<truth::Record> stored);

// Returns "rockyard replay ..." for the trial, as a shell reads it.
std::string ReplayCommandLine(const TrialSource& source, std::uint64_t trial);

// Returns where `record` does not repeat the stored one, which must be there, and what to do then;
// nothing where it repeats it.
std::vector<core::Problem> CompareWithStore(const TrialRequest& request, const TrialSource& source,
                                            const truth::RecordSchema& schema,
                                            const truth::Record& record);

}  // namespace rockyard::campaign
