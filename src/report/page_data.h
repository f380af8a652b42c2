// The data of the report page, which `rockyard report` writes: numbers of runs, sweeps and
// comparisons that are there already, put together as JSON. Must keep the shape of
// src/web/report/payload.ts.
//
// What is undefined is null. Texts may be anything: what is no UTF-8 is replaced. Nothing here
// draws random numbers but the bootstrap of the comparisons that it is given. Cost: linear in the
// values of the records, about 0.3 us each. Memory: the text, about 7 bytes for each value of each
// trial of a run, but no more than 15 MB a run (kMaxPageTrials).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/field_table.h"
#include "core/json_pieces.h"
#include "core/provenance.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "report/paired_comparison.h"
#include "report/run_description.h"
#include "report/run_files.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"
#include "report/trace_view.h"
#include "scenario/sweep.h"
#include "statistics/proportions.h"
#include "statistics/published_comparison.h"
#include "truth/record.h"

namespace rockyard::report {

// What all drives of a run share, as the report page draws them from above: world frame, whole
// centimetres in the page's data.
// A line of one height of the ground.
struct PageContour {
  double height_m = 0.0;
  std::vector<messages::Goal> line;
};

struct PageCourse {
  std::string rover;  // its name; "" where its shape is that of no rover that is known
  math::Pose2 start;
  messages::Goal goal;
  double goal_radius_m = 0.0;
  std::vector<messages::Goal> waypoints;  // true, in the order of driving
  std::vector<double> mirror_lines_m;     // y at which operators reflect the rover; mostly none
  std::vector<PageContour> contours;      // of an elevation model; mostly none
  double contour_interval_m = 0.0;
};

struct PageRock {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.0;  // of a circle that holds it
};

// The true path of one trial, simplified already.
struct PageTrack {
  std::uint64_t trial = 0;
  TracePath path;
  std::vector<PageRock> rocks = {};  // of trials that are drawn by themselves
};

// `Course` of src/web/report/payload.ts.
std::string PageCourseJson(const PageCourse& course);

// Member "tracks" of a run: `Track` of each.
std::string PageTracksJson(std::span<const PageTrack> tracks);

// Steps of a distribution function that a page holds at most.
inline constexpr std::size_t kMaxPageSteps = 1000;

// Trials of a run whose values a page holds at most, but for the few that are named. Of more it
// holds every k-th from trial 0 on, for the least k that does; what is known of a trial before it
// runs is its number alone, so that these are a random sample of all.
inline constexpr std::size_t kMaxPageTrials = 20000;

// A link to the replay of a trial, relative to the page.
struct PageLink {
  std::uint64_t trial = 0;
  std::string link;
};

// A run, or a cell of a campaign, with all that the page tells of it.
struct PageRun {
  std::string label;                 // unique on the page
  std::string folder;                // as the user named it
  std::string cell;                  // "" of a run of one scenario
  std::optional<std::size_t> sweep;  // position among the sweeps of the page
  RunDescription description;
  truth::RecordSchema schema;
  std::span<const truth::Record> records;         // all that are stored, by trial
  std::span<const truth::Record> prefix;          // those that rates may be computed from
  std::vector<core::ParameterInfo> parameters;    // none where another version made the run
  std::optional<std::size_t> parameters_as = {};  // run of the page that has all others
  std::vector<std::uint64_t> named = {};          // trials that must be there; ascending
  std::string published = "null";                 // PublishedJson
  std::optional<PageCourse> course = {};          // none of a measurement
  std::string replay_command;                     // with {trial} for the number
};

// `Run` of payload.ts but for its replays, which are told when all runs are known. Its summary is
// SummaryJson (or MeasurementJson) of the prefix: the run's summary.json.
core::JsonObject PageRunMembers(const PageRun& run, statistics::IntervalMethod method);

// Member "endings": outcomes with their details and how many of the records have both, most first.
std::string PageEndingsJson(std::span<const truth::Record> records);

// Member "replays" of a run.
std::string PageReplaysJson(std::span<const PageLink> links);

// The places of the records that the page of a run holds, ascending; all where they are few.
std::vector<std::size_t> PageTrials(std::span<const truth::Record> records,
                                    std::span<const std::uint64_t> named);

// `TrialTable`: the records at these places, values with six significant digits.
std::string PageTrialsJson(const truth::RecordSchema& schema,
                           std::span<const truth::Record> records,
                           std::span<const std::size_t> places);

// Members of distance_cdf.csv by column, of at most kMaxPageSteps steps: all of them, or the first,
// the last, and each at which the distribution function has grown by more than 1/998 (kMaxPageSteps
// less both ends) since the one before. What is kept is exact. Drawn as steps from it, the function
// is nowhere above that of all steps and nowhere below it by more than 1/998, however many trials
// share a distance. null where there are no steps.
std::string PageCdfJson(std::span<const DistanceStep> steps);

// Returns the parameters of a run whose values differ from those of another run; all parameters
// where the two have not the same ones in the same order. Cells of a sweep differ in few, and all
// parameters of all cells of a large one would fill a page.
std::vector<core::ParameterInfo> OtherParameters(std::span<const core::ParameterInfo> parameters,
                                                 std::span<const core::ParameterInfo> of);

std::string PageParametersJson(std::span<const core::ParameterInfo> parameters);

// `PublishedTable`: the rows of `result` that are about one scenario, "null" where there is none.
// `result` is of that run alone, which the notes say.
std::string PublishedJson(const statistics::PublishedReference& reference,
                          const statistics::ComparisonResult& result, std::string_view scenario);

// `Sweep`: SweepJson, and its curves as points and fitted lines (FittedLine).
std::string PageSweepJson(std::string_view label, std::string_view folder,
                          const scenario::Sweep& sweep, const SweepSummary& summary,
                          const SweepDescription& description);

// A setting in which two runs differ.
struct PageSetting {
  std::string path;
  std::string first;
  std::string second;
};

// Two runs of the page.
struct PageComparison {
  std::string first;  // labels
  std::string second;
  RunComparison comparison;
  std::vector<PageSetting> settings;
};

// Adjusts the p-values of all successes together by Holm, where there is more than one pair of
// runs. P-values that are not known stay so and are no members of the family.
void AdjustSuccesses(std::span<PageComparison> comparisons);

// `Comparison`. `adjusted`: whether AdjustSuccesses has been over its p-values.
std::string PageComparisonJson(const PageComparison& comparison, bool adjusted);

struct PageHead {
  std::string title;
  std::string command;
  std::string why_none_published = {};  // "" where some run is held against published values
  core::Provenance provenance;
};

// `ReportPayload`, of members that are JSON already.
std::string PageJson(const PageHead& head, std::span<const std::string> runs,
                     std::span<const std::string> sweeps, std::span<const std::string> comparisons);

}  // namespace rockyard::report
