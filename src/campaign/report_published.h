// Which runs of a report can be held against published values, and what comes of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/journal.h"
#include "campaign/run_source.h"
#include "statistics/published_values.h"

namespace rockyard::campaign {

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
