// Traces of chosen trials of a campaign, written once its trials are stored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/exit_code.h"
#include "batch/flight_log.h"
#include "batch/supervisor.h"
#include "campaign/drive_recording.h"
#include "campaign/trace_retention.h"
#include "scenario/scenario.h"

namespace rockyard::app {

// As RecordDrive.
using TraceDriver = std::function<campaign::DriveRecording(
    const scenario::Scenario& scenario, std::uint64_t seed, std::uint64_t trial)>;

struct TraceRequest {
  campaign::TraceRetention retention;
  campaign::TraceFormat format = campaign::TraceFormat::kNpz;
  int threads = 1;
  bool quiet = false;  // print errors only
  TraceDriver drive = campaign::RecordDrive;
};

// The bytes of a trace file.
std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const campaign::DriveRecording& recording, campaign::TraceFormat format);

// "trial-000123.npz"
std::string TraceFileName(std::uint64_t trial, campaign::TraceFormat format);

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
ExitCode WriteTraces(const std::filesystem::path& folder, const TraceRequest& request,
                     const batch::Mission& mission, batch::FlightLog& log);

}  // namespace rockyard::app
