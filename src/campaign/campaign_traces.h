// Traces of chosen trials of a campaign, for `run` and `sweep` with --traces; `rockyard trace`
// writes the same files of one trial. They are written once the trials of the campaign are stored:
// only then is known which trials failed, and which are the worst. Trials repeat bit for bit, and
// so are driven again.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "batch/flight_log.h"
#include "batch/supervisor.h"
#include "campaign/journal.h"
#include "campaign/trial_source.h"
#include "campaign/work.h"
#include "scenario/scenario.h"
#include "truth/record.h"

namespace rockyard::campaign {

// Returns the number that the text of an option is, all of it; nothing where the text is none.
template <typename Number>
std::optional<Number> NumberIn(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return number;
}

// Which trials of a campaign leave a trace: the union of what the rules ask for.
struct TraceRetention {
  bool all = false;
  bool failures = false;  // see report::FailedTrials
  std::size_t worst = 0;  // see report::WorstTrials
  double share = 0.0;     // of all trials, chosen by a hash of seed and trial

  bool any() const { return all || failures || worst > 0 || share > 0.0; }
};

// The forms of a trace file, by the names that --trace-format and the ends of files have.
enum class TraceFormat { kNpz, kCsv, kMcap };
inline constexpr std::array<std::string_view, 3> kTraceFormatNames{"npz", "csv", "mcap"};

struct TraceOptions {
  std::vector<std::string> rules;  // "all", "failures", "worst:N", "share:P"
  std::string format = "npz";

  // Returns what the rules ask for together. Of two counts or shares the larger holds. Throws
  // core::UserError with everything that is wrong.
  TraceRetention retention() const;
  // `format` must be one of kTraceFormatNames.
  TraceFormat form() const;
};

// Returns whether share:P keeps the trial: a pure function of (seed, trial), so that a campaign
// that is extended or gone on with keeps what it kept. A larger share keeps all that a smaller one
// does. SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators")
// mixes seed and trial to 53 bits. Must stay: which trials a share keeps.
bool IsInShare(std::uint64_t seed, std::uint64_t trial, double share);

// Returns the trials of one cell that the rules keep, ascending. Simulator faults are never kept:
// they have no record that the trace could be held against. Nor is a drive whose navigator ended
// the process that ran it (truth::IsNavigatorCrash): it would end this one.
std::vector<std::uint64_t> KeptTrials(const TraceRetention& retention,
                                      const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records, std::uint64_t seed);

// Returns the rules for people: "every failure, the 5 worst failures, 1 % of all trials".
std::string RetentionText(const TraceRetention& retention);

// Drives a trial, as RecordDrive does; tests put another driver in its place.
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
  // Called by one thread at a time while traces are written, and at the end where any were to be
  // written.
  std::function<void(const TraceProgress& progress, Moment moment)> progress = {};
  TraceDriver drive = RecordDrive;
  scenario::Scenario defaults = {};  // as of the campaign: its navigators and estimators
};

// Returns the bytes of a trace file, for campaigns and `rockyard trace` alike. Throws
// core::UserError where the terrain of an MCAP file cannot be built. Memory: of MCAP that of the
// recording again, and twice the file.
std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const DriveRecording& recording, TraceFormat format);

// Returns "trial-000123.npz", or with the end of another form.
std::string TraceFileName(std::uint64_t trial, TraceFormat format);

// Drives the chosen trials of every cell of the run in `folder` again, on several threads, and
// writes each trace that is not there yet, whole or not at all: traces/trial-000123.npz, of a sweep
// traces/<cell>/trial-000123.npz (scenario::CellFileName). Traces that are there stay, also those
// that the rules would not choose any more. Records are only read.
//
// A drive that does not repeat its record is told and leaves no trace. It makes the result kFailed,
// as do a drive or a file that fails and a trial that the mission leaves out; the other traces are
// written all the same. The result is kInterrupted where log.stop() became true. The mission
// kRunAlone writes the trace of its trial, tells no result, and is done. The log is told of every
// trial in flight and of how many traces are written.
//
// Throws core::UserError where the run cannot be read. Cost: that of the trials; memory: one
// recording per thread, and the records of one cell.
Outcome WriteTraces(const std::filesystem::path& folder, const TraceRequest& request,
                    const batch::Mission& mission, batch::FlightLog& log, Journal& journal);

}  // namespace rockyard::campaign
