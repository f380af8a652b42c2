// Which runs of a report can be held against published values, and what comes of it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/run_source.h"
#include "statistics/published_values.h"

namespace rockyard::app {

class PublishedTables {
 public:
  // The reference in `file`, or, where that is empty, every reference in results/reference below
  // the working folder (none where there is no such folder; one that cannot be read is noted and
  // left out). Throws core::UserError where `file` is no reference.
  explicit PublishedTables(const std::string& file);

  // For each run a `PublishedTable` of src/web/report/payload.ts, or "null": of the first reference
  // that names its scenario. Runs of different scenarios are judged together, as `rockyard check`
  // of all of them does: they are one family for Holm's procedure. Of several runs of one scenario
  // the first ones of each are such a family, then the second ones, and so on. Cost: some seconds a
  // family.
  std::vector<std::string> Tables(std::span<const StoredRun> runs) const;

 private:
  struct Reference {
    std::filesystem::path folder;
    statistics::PublishedReference values;
  };
  void Load(const std::filesystem::path& file);

  std::vector<Reference> references_;
};

}  // namespace rockyard::app
