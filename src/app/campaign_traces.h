// Traces of chosen trials of a campaign, written once its trials are stored.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "app/drive_recording.h"
#include "app/exit_code.h"
#include "app/trace_retention.h"
#include "scenario/scenario.h"

namespace rockyard::app {

struct TraceRequest {
  TraceRetention retention;
  TraceFormat format = TraceFormat::kNpz;
  int threads = 1;
  bool quiet = false;  // print errors only
};

// The bytes of a trace file.
std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const DriveRecording& recording, TraceFormat format);

// "trial-000123.npz"
std::string TraceFileName(std::uint64_t trial, TraceFormat format);

// Drives the chosen trials of every cell of the run in `folder` again, on several threads, and
// writes each trace that is not there yet, whole or not at all: traces/trial-000123.npz, of a sweep
// traces/<cell>/trial-000123.npz (scenario::CellFileName). A drive that does not repeat its
// record is no trace of it: it is told, not written, and makes the result kFailed, as a file that
// cannot be written does; the others are written all the same. kInterrupted where `stop` became
// true. Records are only read. Cost: that of the trials; memory: one recording per thread, and the
// records of one cell.
ExitCode WriteTraces(const std::filesystem::path& folder, const TraceRequest& request,
                     const std::atomic<bool>& stop);

}  // namespace rockyard::app
