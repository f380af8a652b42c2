/// @file
/// What pieces of work are asked alike, what a caller is told while they go on, and what came of
/// them. Runs, sweeps, merges, checks, replays and reports share these types; the command line and
/// programs read them. The library prints none of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace rockyard::campaign {

/// How work ended. Must stay: the numbers, which are exit codes of worker processes and of the
/// command; batch::kOverdueExit and batch::kShortExit are none of them.
enum class Outcome {
  kDone = 0,           ///< all of it, and nothing differs
  kDiffers = 1,        ///< a comparison differs
  kBadInput = 2,       ///< nothing written
  kTooManyFaults = 3,  ///< simulator faults above the stated fraction
  kInconclusive = 4,   ///< nothing differs, but something is underpowered
  kFailed = 5,         ///< a disk or the machine failed while running; what was finished is stored
  kInterrupted = 130,  ///< somebody asked for an early end; what was finished is stored
};

/// How much a note matters.
enum class NoteKind {
  kRemark,  ///< good to know
  kWarning  ///< whoever waits for the work has to know it
};

/// A sentence for the user.
struct Note {
  NoteKind kind = NoteKind::kRemark;
  std::string text;  ///< whole sentences, one line
};

/// Whom work tells. Everything is told when it comes up, and each function may be left out, as what
/// work returns holds it, too. A supervised campaign tells in the process where things come up,
/// which may be a worker: what the observer writes there counts, what it keeps in memory there does
/// not come back.
struct Observer {
  std::function<void(const Note& note)> note = {};
  std::function<void(const std::vector<core::Problem>& problems)> problems = {};
};

/// Which moment progress is told of.
enum class Moment { kUnderWay, kEnd };

/// What to do with a run that lies in the folder already. No choice deletes a store.
enum class ExistingRun {
  kRefuse,            ///< the default
  kResume,            ///< go on; refuse where scenario, seed or build differ
  kSetAside,          ///< --force: rename its store and start anew
  kResumeOrSetAside,  ///< --resume --force: go on where it fits, otherwise set aside
  kOwn,               ///< for this library alone: an earlier process of the same work made it
};

/// One trial to run again: of a scenario, or of a finished run whose record it must repeat.
struct TrialRequest {
  std::string source;       ///< scenario file, scenario.resolved.json, or the folder of a run
  std::string cell = {};    ///< of a campaign: its name, or number from 0
  std::uint32_t trial = 0;  ///< index in the campaign
  std::optional<std::int64_t> seed = {};    ///< absent: the scenario's; an error with a run
  std::vector<std::string> overrides = {};  ///< "PATH=VALUE"; an error with a run
};

/// How many trials of a campaign there are.
struct TrialCounts {
  std::int64_t planned = 0;
  std::int64_t finished = 0;  ///< of those planned, also in earlier sessions
  std::int64_t faults = 0;    ///< of those finished: simulator faults
};

/// All that was told while a piece of work went on.
struct Account {
  std::vector<Note> notes;
  std::vector<core::Problem> problems;
  std::filesystem::path folder;  ///< of a campaign: where its store is
  TrialCounts trials;            ///< of a campaign
};

/// What came of a piece of work, whichever process did it. With kBadInput `problems` say what was
/// wrong with the request, with other outcomes what went wrong meanwhile.
struct WorkResult : Account {
  Outcome outcome = Outcome::kDone;
};

}  // namespace rockyard::campaign
