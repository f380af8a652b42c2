// An experiment without a rover: records that follow from (seed, index) alone.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "batch/campaign_differences.h"
#include "batch/result_store.h"
#include "batch/trial_hash.h"
#include "core/json_text.h"
#include "core/random.h"
#include "experiments/experiment.h"
#include "truth/record.h"

namespace rockyard::batch {

inline truth::RecordSchema FakeSchema() {
  return {{"true_distance_m", "m", "path"}, {"sim_time_s", "s", "time"}, {"odd \"name\"", "1", ""}};
}

inline truth::Record FakeRecord(std::uint64_t seed, std::uint64_t index) {
  core::RandomStream stream({seed, static_cast<std::uint32_t>(index)}, core::Purpose::kTest);
  const double distance = 7.0 + stream.Uniform();
  const bool reached = stream.Uniform() < 0.8;
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  return {index,
          reached ? truth::TrialOutcome::kGoalReached : truth::TrialOutcome::kNoPath,
          reached ? "arrived" : "gave up",
          {distance, reached ? 100.0 * stream.Uniform() : undefined, -0.0}};
}

// Those of trials from .. to-1, seed 1.
inline std::vector<truth::Record> FakeRecords(std::uint64_t from, std::uint64_t to) {
  std::vector<truth::Record> records;
  for (std::uint64_t i = from; i < to; ++i) records.push_back(FakeRecord(1, i));
  return records;
}

// The hash of as many trials from 0 on.
inline std::string FakeHash(std::uint64_t trials) { return TrialHash(FakeRecords(0, trials)); }

class FakeExperiment final : public experiments::Experiment {
 public:
  using Hook = std::function<void(std::uint64_t index)>;

  // `hook` runs before each trial, on its thread: to wait, to throw, to count.
  explicit FakeExperiment(Hook hook = {}) : schema_(FakeSchema()), hook_(std::move(hook)) {}

  const truth::RecordSchema& schema() const override { return schema_; }

  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override {
    if (hook_) hook_(index);
    return FakeRecord(seed, index);
  }

 private:
  truth::RecordSchema schema_;
  Hook hook_;
};

inline CellIdentity FakeCell(std::uint64_t seed = 1, const std::string& name = "") {
  const char* resolved = R"({"name": "fake", "trials": 10, "terrain": {"k": 0.00415}})";
  return {.name = name,
          .scenario = "fake",
          .fingerprint = ResolvedFingerprint(core::ParseJson(resolved, "fake")),
          .resolved = resolved,
          .seed = seed};
}

inline CampaignIdentity FakeIdentity(std::uint64_t seed = 1) {
  return {.name = "fake",
          .design = "",
          .build = "0.1.0 abc",
          .schema = FakeSchema(),
          .cells = {FakeCell(seed)}};
}

// Of the only cell.
inline void AppendRecords(ResultStore& store, const std::vector<truth::Record>& records) {
  std::vector<CellRecord> rows;
  for (const truth::Record& record : records) rows.push_back({0, record});
  store.Append(rows);
}

}  // namespace rockyard::batch
