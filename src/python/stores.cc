#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/result_store.h"
#include "batch/trial_hash.h"
#include "campaign/campaign_traces.h"
#include "campaign/run_source.h"
#include "campaign/trial_source.h"
#include "core/error.h"
#include "python/parts.h"
#include "report/trace_view.h"
#include "scenario/sweep.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

// What is known of a run, or of the first cell of a sweep where none is wanted, but for its
// records.
py::dict HeadOf(const std::string& folder, const std::string& wanted) {
  std::optional<batch::CampaignIdentity> campaign;
  std::vector<std::string> builds;
  std::int64_t planned = 0;
  int number = 0;
  {
    const py::gil_scoped_release released;
    const batch::ResultStore store = batch::ResultStore::Read(folder);
    const bool any = wanted.empty() && !store.identity().design.empty();
    number = any ? 0 : campaign::FindCell(folder, store.identity().cells, wanted);
    planned = store.planned(number);
    builds = store.Builds();
    campaign = store.identity();
  }
  const batch::CellIdentity& cell = campaign->cells.at(static_cast<std::size_t>(number));
  py::dict dict;
  dict["name"] = cell.name;
  dict["scenario"] = cell.scenario;
  dict["resolved"] = cell.resolved;
  dict["seed"] = cell.seed;
  dict["planned"] = planned;
  dict["columns"] = ColumnsOf(campaign->schema);
  dict["builds"] = builds;
  std::vector<std::string> names;
  for (const batch::CellIdentity& each : campaign->cells) names.push_back(each.name);
  dict["cells"] = names;
  const std::string part =
      scenario::CellFileName(static_cast<std::size_t>(number), cell.name);  // campaign_traces.h
  dict["traces"] = (fs::path("traces") / (campaign->design.empty() ? "" : part)).string();
  dict["is_sweep"] = !campaign->design.empty();
  return dict;
}

// Returns the records as arrays: trial, outcome (place in `outcomes`), values (trials x columns).
py::tuple RecordsOf(const campaign::StoredRun& run) {
  const auto rows = static_cast<py::ssize_t>(run.records.size());
  const auto columns = static_cast<py::ssize_t>(run.schema.size());
  py::array_t<std::uint64_t> trials(rows);
  py::array_t<std::int8_t> outcomes(rows);
  py::array_t<double> values({rows, columns});
  auto trial = trials.mutable_unchecked<1>();
  auto outcome = outcomes.mutable_unchecked<1>();
  auto value = values.mutable_unchecked<2>();
  for (py::ssize_t row = 0; row < rows; ++row) {
    const truth::Record& record = run.records[static_cast<std::size_t>(row)];
    trial(row) = record.trial;
    outcome(row) = static_cast<std::int8_t>(record.outcome);
    const bool fault = record.values.empty();
    for (py::ssize_t column = 0; column < columns; ++column) {
      value(row, column) = fault ? std::numeric_limits<double>::quiet_NaN()
                                 : record.values[static_cast<std::size_t>(column)];
    }
  }
  return py::make_tuple(trials, outcomes, values);
}

// Returns the stored record of a trial; nothing where it is pending.
std::optional<truth::Record> StoredRecord(const std::string& folder, const std::string& cell,
                                          std::int64_t trial, truth::RecordSchema& schema) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  schema = store.identity().schema;
  const int number = campaign::FindCell(folder, store.identity().cells, cell);
  std::vector<truth::Record> records = store.Load(number, trial, trial + 1);
  if (records.empty()) return std::nullopt;
  return std::move(records.front());
}

// Drives a trial of a run again. Returns the bytes of its trace, whether the record is the stored
// one (None: none is stored), and where it is not.
py::tuple TraceOf(const std::string& folder, const std::string& cell, const OpenScenario& defaults,
                  std::uint32_t trial, const std::string& format) {
  std::string bytes;
  std::optional<bool> repeats;
  std::vector<std::string> differences;
  {
    const py::gil_scoped_release released;
    const scenario::Scenario scenario =
        campaign::LoadScenarioFrom(folder, {}, cell, defaults.values.values());
    truth::RecordSchema schema;
    const std::optional<truth::Record> stored = StoredRecord(folder, cell, trial, schema);
    const campaign::DriveRecording recording =
        campaign::RecordDrive(scenario, static_cast<std::uint64_t>(scenario.seed), trial);
    if (stored) {
      differences = report::RecordDifferences(schema, *stored, recording.traced.record);
      repeats = differences.empty();
    }
    bytes = campaign::TraceBytes(scenario, cell, recording,
                                 campaign::TraceOptions{.rules = {}, .format = format}.form());
  }
  return py::make_tuple(py::bytes(bytes), repeats, differences);
}

}  // namespace

void BindStores(py::module_& module) {
  module.attr("outcomes") = [] {
    py::list names;
    for (const std::string_view name : truth::kTrialOutcomeNames) names.append(name);
    return py::tuple(names);
  }();
  module.def("head", &HeadOf);
  module.def("read_records", [](const std::string& folder, const std::string& cell) {
    const campaign::StoredRun run = [&] {
      const py::gil_scoped_release released;
      return campaign::ReadRun(folder, cell);
    }();
    py::list details;
    for (const truth::Record& record : run.records) details.append(record.detail);
    return py::make_tuple(RecordsOf(run), details, batch::TrialHash(run.records));
  });
  // All cells at once, as opening a campaign costs more than its records.
  module.def("read_campaign", [](const std::string& folder) {
    const std::vector<campaign::StoredRun> runs = [&] {
      const py::gil_scoped_release released;
      return campaign::ReadCampaign(folder);
    }();
    py::list records;
    for (const campaign::StoredRun& run : runs) records.append(RecordsOf(run));
    return py::make_tuple(ColumnsOf(runs.front().schema), records);
  });
  module.def("trace", &TraceOf, py::arg("folder"), py::arg("cell"), py::arg("defaults"),
             py::arg("trial"), py::arg("format"));
}

}  // namespace rockyard::python
