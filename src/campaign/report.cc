#include "campaign/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "batch/campaign_differences.h"
#include "batch/executor.h"
#include "batch/result_store.h"
#include "batch/trial_hash.h"
#include "campaign/campaign_process.h"
#include "campaign/output_folder.h"
#include "campaign/reference_cases.h"
#include "campaign/report_inputs.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_pieces.h"
#include "core/provenance.h"
#include "report/atomic_file.h"
#include "report/page_data.h"
#include "scenario/sweep.h"
#include "truth/measurement_record.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Returns the page that is asked for, or report.html in the folder that was named first.
std::string PageFile(const ReportRequest& request) {
  return request.page.empty() ? (fs::path(request.runs.front()) / "report.html").string()
                              : request.page;
}

// Throws, before the work, where a file cannot be meant.
void CheckFile(const char* option, const std::string& file, const char* extension) {
  CheckOutputFile(option, file);
  CheckExtension(option, file, extension);
}

void CheckFiles(const ReportRequest& request) {
  CheckFile("--out", PageFile(request), ".html");
  if (!request.data.empty()) CheckFile("--data", request.data, ".json");
}

void WritePage(const ReportRequest& request, const PageRequest& page, const Report& report,
               ReportResult& result) {
  if (!request.data.empty()) {
    report::WriteFileAtomically(request.data, report.json);
    result.data_bytes = report.json.size();
  }
  const std::string html = web::MakePage(web::Page::kReport, report.title, report.json);
  report::WriteFileAtomically(page.page, html);
  result.page_bytes = html.size();
}

Outcome Write(const ReportRequest& request, const ReportObserver& observer, const Contact& contact,
              ReportResult& result) {
  PageRequest page{.inputs = FindReportInputs(request.runs, request.cell),
                   .title = request.title,
                   .command = request.command,
                   .against = request.against,
                   .references = request.references,
                   .replays = request.replays,
                   .page = PageFile(request),
                   .progress = observer.replays,
                   .tracks = request.tracks,
                   .plugins = request.plugins,
                   .track_progress = observer.tracks};
  CheckFiles(request);
  result.page = page.page;
  const Report report = BuildReport(page, contact);
  result.runs = report.runs;
  result.trials = report.trials;
  result.replays = report.replays;
  try {
    WritePage(request, page, report, result);
  } catch (const core::UserError& failure) {
    // The disk failed after the work; input was not wrong before it.
    contact.journal.Fail(failure.problems());
    if (report.replays.written > 0) {
      contact.journal.Warn(fmt::format("{} replays are written, in {}", report.replays.written,
                                       report.replays.folder.string()));
    }
    return Outcome::kFailed;
  }
  return report.replays.outcome;
}

}  // namespace

ReportResult WriteReport(const ReportRequest& request, const ReportObserver& observer,
                         const Stop& stop) {
  ReportResult result;
  static_cast<WorkResult&>(result) = Recorded(observer, [&](Journal& journal) {
    return Write(request, observer, {journal, stop}, result);
  });
  return result;
}

namespace {

constexpr std::size_t kMaxCompared = 6;
constexpr double kTrackTime_s = 20.0;  // for the tracks of all runs together
constexpr auto kMethod = statistics::IntervalMethod::kWilson;

// Returns the numbers of the trials, ascending.
std::vector<std::uint64_t> TrialsOf(const std::vector<ChosenTrial>& worst) {
  std::vector<std::uint64_t> trials;
  trials.reserve(worst.size());
  for (const ChosenTrial& each : worst) trials.push_back(each.record.trial);
  std::sort(trials.begin(), trials.end());
  return trials;
}

[[noreturn]] void FailEmpty(const std::filesystem::path& folder) {
  throw core::UserError(folder.string(), "holds no finished trials to report",
                        "let it run: the same `rockyard run` or `rockyard sweep` with --resume");
}

class Builder {
 public:
  Builder(const PageRequest& request, const Contact& contact)
      : request_(request),
        contact_(contact),
        published_(request.against, request.references, contact.journal) {}

  Report Build() {
    for (const ReportInput& input : request_.inputs) {
      if (input.sweep) {
        AddSweep(input);
      } else {
        AddPlain(input);
      }
    }
    RequirePublished();
    Compare();
    return Finish();
  }

 private:
  // Adds a run; its values are let go afterwards.
  void AddPlain(const ReportInput& input) {
    StoredRun run = ReadRun(input.folder, input.cell);
    if (run.records.empty()) FailEmpty(input.folder);
    names_.push_back(run.identity.scenario);
    const std::vector<std::uint64_t> examples = ExamplesOf(run);
    std::vector<ChosenTrial> chosen = FindWorst(run, request_.replays);
    if (request_.replays > 0) AddChosen(run, examples, chosen);
    const std::vector<std::uint64_t> named = TrialsOf(chosen);
    AddRun(run, input.label, {}, std::move(chosen));
    AddTracks(run, input.label, examples, named);
    if (truth::IsMeasurement(run.schema) || run.prefix().empty()) return;
    for (truth::Record& record : run.records) record.values.clear();
    drives_.emplace_back(std::move(run), input.label);
  }

  // Adds the tracks of the first trials, which are chosen without regard to how they end, and those
  // of the examples and the named trials.
  void AddTracks(const StoredRun& run, const std::string& label,
                 const std::vector<std::uint64_t>& examples,
                 const std::vector<std::uint64_t>& named) {
    const auto plain = std::count_if(request_.inputs.begin(), request_.inputs.end(),
                                     [](const ReportInput& input) { return !input.sweep; });
    const Tracks tracks = DriveTracks(run,
                                      {.label = label,
                                       .first = request_.tracks,
                                       .examples = examples,
                                       .named = named,
                                       .limit_s = kTrackTime_s / static_cast<double>(plain),
                                       .threads = batch::ThreadCount({}),
                                       .plugins = request_.plugins},
                                      contact_, request_.track_progress);
    runs_.back()
        .Add("examples", core::JsonList(examples, [](auto trial) { return std::to_string(trial); }))
        .Add("tracks", report::PageTracksJson(tracks.tracks))
        .AddInteger("first_tracks", static_cast<std::int64_t>(tracks.first));
  }

  void AddRun(const StoredRun& run, const std::string& label, std::optional<std::size_t> sweep,
              std::vector<ChosenTrial> worst) {
    report::PageRun page{.label = label,
                         .folder = run.folder.string(),
                         .cell = run.identity.name,
                         .sweep = sweep,
                         .description = Describe(run, batch::ThreadCount({})),
                         .schema = run.schema,
                         .records = run.records,
                         .prefix = run.prefix(),
                         .parameters = ParametersOf(run),
                         .named = TrialsOf(worst),
                         .published = published_.Table(run),
                         .course = CourseOf(run),
                         .replay_command = ReplayCommand(run)};
    if (sweep) ShareParameters(page);
    any_published_ = any_published_ || page.published != "null";
    report_.trials += run.records.size();
    AddWorst(std::move(worst), label);
    runs_.push_back(
        report::PageRunMembers(page, run.rule ? statistics::IntervalMethod::kStopped : kMethod));
  }

  // Lets the first cell of a sweep have all parameters, and the others refer to it.
  void ShareParameters(report::PageRun& page) {
    if (first_cell_parameters_.empty()) {
      first_cell_ = runs_.size();
      first_cell_parameters_ = page.parameters;
      return;
    }
    auto others = report::OtherParameters(page.parameters, first_cell_parameters_);
    if (others.size() == page.parameters.size()) return;
    page.parameters = std::move(others);
    page.parameters_as = first_cell_;
  }

  void AddWorst(std::vector<ChosenTrial> worst, const std::string& label) {
    for (ChosenTrial& each : worst) {
      if (!request_.plugins && PluginDecides(each.identity.resolved)) {
        left_out_ = true;
        continue;
      }
      each.run = runs_.size();
      each.label = label;
      worst_.push_back(std::move(each));
    }
  }

  void AddSweep(const ReportInput& input) {
    const batch::ResultStore store = batch::ResultStore::Read(input.folder);
    const scenario::Sweep sweep = SweepOf(store, input.folder);
    names_.push_back(sweep.name);
    const CellReader reader(input.folder, store);
    std::vector<batch::CellHash> hashes;
    std::vector<ChosenTrial> others = std::exchange(worst_, {});
    const std::size_t before = report_.trials;
    first_cell_parameters_.clear();
    const auto load = [&](std::size_t cell) {
      StoredRun run = reader.Load(static_cast<int>(cell));
      AddRun(run, input.cell_labels[cell], sweeps_.size(), FindWorst(run, request_.replays));
      worst_ = Worst(std::move(worst_), request_.replays);
      std::string name = run.identity.name;
      report::SweepCellTrials trials = SweepCellView(std::move(run));
      hashes.push_back({std::move(name), trials.trial_hash});
      return trials;
    };
    left_out_ = false;
    const report::SweepSummary summary = report::SummarizeSweep(sweep, load, kMethod);
    if (left_out_) {
      contact_.journal.Remark(fmt::format(
          "{}: trials in which a plugin decides get no replay (--plugins lets them)", input.label));
    }
    if (report_.trials == before) FailEmpty(input.folder);
    worst_.insert(worst_.begin(), others.begin(), others.end());
    sweeps_.push_back(report::PageSweepJson(input.label, input.folder.string(), sweep, summary,
                                            {.trial_hash = batch::CampaignHash(hashes),
                                             .provenance = core::CurrentProvenance(),
                                             .builds = store.Builds(),
                                             .threads = batch::ThreadCount({})}));
  }

  void RequirePublished() const {
    if (request_.against.empty() || any_published_) return;
    throw core::UserError("--against", request_.against + " names the scenario of none of the runs",
                          "name the reference that their scenarios are in, or leave it out");
  }

  // Compares each run of drives with the first one.
  void Compare() {
    if (drives_.size() > kMaxCompared) {
      contact_.journal.Warn(
          fmt::format("{} runs are too many to compare with the first: name up to {}",
                      drives_.size(), kMaxCompared));
      return;
    }
    if (drives_.size() < 2) return;
    const auto& [first, first_label] = drives_.front();
    for (std::size_t i = 1; i < drives_.size(); ++i) {
      const auto& [second, label] = drives_[i];
      report::PageComparison comparison{.first = first_label,
                                        .second = label,
                                        .comparison = CompareDrives(first, second),
                                        .settings = {}};
      for (const batch::ScenarioDifference& each :
           batch::FindScenarioDifferences(first.identity.resolved, second.identity.resolved)) {
        comparison.settings.push_back({each.path, each.first, each.second});
      }
      comparisons_.push_back(std::move(comparison));
    }
  }

  // Returns why no published values stand beside the runs. It is also said in the terminal where
  // there is nothing to look in, which is often the wrong folder.
  std::string WhyNonePublished() const {
    if (any_published_) return {};
    if (published_.empty()) contact_.journal.Warn(published_.WhyNone());
    return published_.WhyNone();
  }

  // Returns the scenarios and sweeps of the inputs, with the label where several have one name.
  std::string Title() const {
    constexpr std::size_t kNamed = 3;
    if (!request_.title.empty()) return request_.title;
    std::string title;
    for (std::size_t i = 0; i < std::min(names_.size(), kNamed); ++i) {
      const std::string& label = request_.inputs[i].label;
      title += (i == 0 ? "" : ", ") + (names_[i].empty() ? label : names_[i]);
      if (!names_[i].empty() && std::ranges::count(names_, names_[i]) > 1) {
        title += fmt::format(" ({})", label);
      }
    }
    if (names_.size() > kNamed) title += fmt::format(" and {} more", names_.size() - kNamed);
    return title;
  }

  Report Finish() {
    report_.title = Title();
    report_.replays = WriteReplays(request_.page, worst_, runs_.size(), batch::ThreadCount({}),
                                   contact_, request_.progress);
    std::vector<std::string> runs;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      runs.push_back(
          runs_[i].Add("replays", report::PageReplaysJson(report_.replays.links[i])).Text());
    }
    const bool adjusted = comparisons_.size() > 1;
    if (adjusted) report::AdjustSuccesses(comparisons_);
    std::vector<std::string> comparisons;
    for (const report::PageComparison& each : comparisons_) {
      comparisons.push_back(report::PageComparisonJson(each, adjusted));
    }
    report_.runs = runs.size();
    report_.json = report::PageJson({.title = report_.title,
                                     .command = request_.command,
                                     .why_none_published = WhyNonePublished(),
                                     .provenance = core::CurrentProvenance()},
                                    runs, sweeps_, comparisons);
    return std::move(report_);
  }

  const PageRequest& request_;
  const Contact& contact_;
  PublishedTables published_;
  // The runs to compare, with their labels: no cells of a sweep, and without the values of their
  // records.
  std::vector<std::pair<StoredRun, std::string>> drives_;
  std::vector<std::string> names_;  // of the scenario or sweep of each input
  std::vector<core::JsonObject> runs_;
  std::vector<std::string> sweeps_;
  std::vector<report::PageComparison> comparisons_;
  std::vector<ChosenTrial> worst_;
  bool left_out_ = false;       // trials of worst_, as a plugin decides
  std::size_t first_cell_ = 0;  // of the sweep that is being added
  std::vector<core::ParameterInfo> first_cell_parameters_;
  bool any_published_ = false;
  Report report_;
};

}  // namespace

Report BuildReport(const PageRequest& request, const Contact& contact) {
  return Builder(request, contact).Build();
}

}  // namespace rockyard::campaign
