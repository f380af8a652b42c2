// Traces of chosen trials of a campaign, written once its trials are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "batch/flight_log.h"
#include "batch/supervisor.h"
#include "campaign/drive_recording.h"
#include "campaign/journal.h"
#include "campaign/observer.h"
#include "campaign/outcome.h"
#include "campaign/trace_retention.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// As RecordDrive.
using TraceDriver = std::function<DriveRecording(const scenario::Scenario& scenario,
                                                 std::uint64_t seed, std::uint64_t trial)>;

struct TraceProgress {
  std::size_t written = 0;  // with those that were there before
  std::size_t total = 0;
};

struct TraceRequest {
  TraceRetention retention;
  TraceFormat format = TraceFormat::kNpz;
  int threads = 1;
  // By one thread at a time; at the end where any were to be written.
  std::function<void(const TraceProgress& progress, Moment moment)> progress = {};
  TraceDriver drive = RecordDrive;
};

// The bytes of a trace file.
std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const DriveRecording& recording, TraceFormat format);

// "trial-000123.npz"
std::string TraceFileName(std::uint64_t trial, TraceFormat format);

// Drives the chosen trials of every cell of the run in `folder` again, on several threads, and
// writes each trace that is not there yet, whole or not at all: traces/trial-000123.npz, of a sweep
// traces/<cell>/trial-000123.npz (scenario::CellFileName). Traces that are there stay, also those
// that the rules would not choose any more. A drive that does not repeat its record is no trace of
// it: it is told, not written, and makes the result kFailed, as do a drive or a file that fails and
// a trial that the mission leaves out; the others are written all the same. kInterrupted where
// log.stop() became true. The mission kRunAlone writes the trace of its trial, tells nothing, and
// is done. The log is told of every trial in flight and of how many traces are written. Records are
// only read. Throws core::UserError where the run cannot be read. Cost: that of the trials; memory:
// one recording per thread, and the records of one cell.
Outcome WriteTraces(const std::filesystem::path& folder, const TraceRequest& request,
                    const batch::Mission& mission, batch::FlightLog& log, Journal& journal);

}  // namespace rockyard::campaign
