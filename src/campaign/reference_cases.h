// The cases that baselines and publications are about: what runs gave, kept for later builds to be
// held against it, and whether a run is of the same case. The command `baseline` makes baselines;
// checks and reports hold runs against cases.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "batch/campaign_differences.h"
#include "campaign/journal.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/result.h"
#include "report/baseline.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::campaign {

struct BaselineRequest {
  std::vector<std::string> runs;  // folders of runs of drives, or of such folders
  std::string name;
  std::string reason;  // why its numbers may be what they are
};

// Makes a baseline of finished runs with independent trials and names of their own. Memory: the
// records of one campaign.
core::Result<report::Baseline> MakeBaseline(const BaselineRequest& request);

// The same, written into a file, whole or not at all. An error also: no reason, or a file that
// cannot be meant.
core::Result<report::Baseline> WriteBaseline(const BaselineRequest& request,
                                             const std::filesystem::path& file);

// The scenario of a baseline's cell beside that of a run.
struct BaselineScenario {
  // What makes the scenario of the run another one: settings that the baseline knows, and younger
  // ones that are not at their default. The seed does not count: another seed is another sample of
  // the same.
  std::vector<batch::ScenarioDifference> differences;
  // Settings that only the run has, at their default: whether they change anything is what a check
  // is for.
  std::vector<std::string> younger;
  bool same_fields = true;  // those that decide rocks, start and goal are the same
};

// Compares two resolved scenarios, both JSON texts. By it `check` takes a run for the
// baseline's case or refuses it. Throws core::UserError where one is none.
BaselineScenario CompareWithBaseline(const std::string& baseline, const std::string& run);

// Returns a problem of `label` where course.trials_per_layout is above 1: trials that share rocks
// are not independent, so that neither intervals nor p-values hold.
std::vector<core::Problem> SharedLayoutProblems(const std::string& label,
                                                const std::string& resolved);

// Returns the runs for statistics::Compare, with the settings in which each differs from the
// scenario file that the reference in `folder` names for it: "PATH is VALUE, VALUE in FILE", the
// seed left out. Where the reference names no file, or the file cannot be read (which is noted),
// the settings are those that the run was told by --set and --ablate. `runs` must outlive the
// views.
std::vector<statistics::ScenarioRun> PublishedViews(const statistics::PublishedReference& reference,
                                                    const std::filesystem::path& folder,
                                                    std::span<const StoredRun* const> runs,
                                                    Journal& journal);

// The tables of published values beside the runs of a report.
class PublishedTables {
 public:
  // Takes the reference in `file`, or, where `file` is empty, every reference in `folder`: none
  // where there is no such folder; one that cannot be read is noted and left out. `journal` must
  // outlive the tables. Throws core::UserError where `file` is no reference.
  PublishedTables(const std::string& file, std::string folder, Journal& journal);

  // Returns a `PublishedTable` of src/web/report/payload.ts from the first reference that names the
  // scenario of the run, or "null". The values of one run are a family for Holm's procedure: what a
  // run is held to does not depend on the other runs of the report. Cost: some seconds.
  std::string Table(const StoredRun& run) const;

  // Returns where was looked, for a report whose tables are all "null".
  std::string WhyNone() const;

  bool empty() const { return references_.empty(); }

 private:
  struct Reference {
    std::filesystem::path folder;
    statistics::PublishedReference values;
  };
  void Load(const std::filesystem::path& file);

  std::string folder_;
  Journal& journal_;
  std::vector<Reference> references_;
};

}  // namespace rockyard::campaign
