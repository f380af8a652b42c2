// Whether a run is of the case that published values are about, and which runs of a report can be
// held against published values.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/run_source.h"
#include "statistics/published_comparison.h"
#include "statistics/published_values.h"

namespace rockyard::campaign {

// The runs for statistics::Compare, with the settings in which each differs from the scenario file
// that the reference in `folder` names for it: "PATH is VALUE, VALUE in FILE", the seed left out.
// Where it names none, or the file cannot be read (which is noted), what the run was told by --set
// and --ablate. `runs` must outlive the views.
std::vector<statistics::ScenarioRun> PublishedViews(const statistics::PublishedReference& reference,
                                                    const std::filesystem::path& folder,
                                                    std::span<const StoredRun* const> runs,
                                                    Journal& journal);

class PublishedTables {
 public:
  // The reference in `file`, or, where that is empty, every reference in results/reference below
  // the working folder (none where there is no such folder; one that cannot be read is noted and
  // left out; `journal` must outlive this). Throws core::UserError where `file` is no reference.
  PublishedTables(const std::string& file, Journal& journal);

  // `PublishedTable` of src/web/report/payload.ts, or "null": of the first reference that names the
  // scenario of the run. The values of one run are a family for Holm's procedure: what it is held
  // to does not depend on the other runs that are named. Cost: some seconds.
  std::string Table(const StoredRun& run) const;

  // Where was looked, for a report whose tables are all "null".
  std::string WhyNone() const;

  bool empty() const { return references_.empty(); }

 private:
  struct Reference {
    std::filesystem::path folder;
    statistics::PublishedReference values;
  };
  void Load(const std::filesystem::path& file);

  Journal& journal_;
  std::vector<Reference> references_;
};

}  // namespace rockyard::campaign
