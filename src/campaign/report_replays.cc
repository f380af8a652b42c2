#include "campaign/report_replays.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "batch/parallel_tasks.h"
#include "campaign/replay_page.h"
#include "campaign/report_inputs.h"
#include "campaign/trial_source.h"
#include "core/error.h"
#include "core/json_text.h"
#include "experiments/drive/drive_experiment.h"
#include "report/trace_view.h"
#include "report/trial_outcomes.h"
#include "statistics/drive_summary.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Returns the file name of a replay, of characters that file names can hold anywhere.
std::string FileName(const ChosenTrial& worst) {
  std::string name = worst.label.substr(0, 60);
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || (std::isalnum(byte) == 0 && c != '-' && c != '.' && c != '_')) c = '_';
  }
  // The number of the run keeps names apart that differ in other characters only.
  return fmt::format("{}-{}-trial{}.html", worst.run + 1, name, worst.record.trial);
}

// Returns the text as a link in a page has to be written (RFC 3986).
std::string PercentEncoded(const std::string& text) {
  std::string link;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 0x80 && (std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_' || c == '~');
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

// Writes one page after the other, on several threads.
class ReplayWriter {
 public:
  ReplayWriter(const fs::path& page, std::span<const ChosenTrial> trials, std::size_t runs,
               const Contact& contact, const ReplayReport& progress)
      : name_(page.stem().string() + "_replays"),
        trials_(trials),
        contact_(contact),
        progress_(progress),
        done_(trials.size(), false) {
    replays_.links.resize(runs);
    replays_.folder = page.parent_path() / name_;
  }

  ReportReplays Write(int threads) {
    if (!trials_.empty()) WriteAll(threads);
    TellLeftovers();
    return std::move(replays_);
  }

 private:
  void WriteAll(int threads) {
    std::error_code error;
    fs::create_directories(replays_.folder, error);
    if (error) {
      core::FailOnDisk(replays_.folder, "cannot be made", error,
                       "choose another place with --out, or --replays 0");
    }
    std::atomic<bool> stop{contact_.stop.IsWanted()};
    {
      const std::shared_ptr<void> watch = contact_.stop.Watch(stop, SecondWish::kEnds);
      batch::RunTasks(trials_.size(), threads, stop, [&](std::size_t i) {
        WriteOne(i);
        if (contact_.stop.IsWanted()) stop = true;
      });
    }
    if (progress_) progress_({ended_, trials_.size(), 0, ""}, Moment::kEnd);
    contact_.journal.Fail(problems_);
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      if (done_[i]) Link(trials_[i]);
    }
    if (stop) {
      contact_.journal.Warn(
          fmt::format("interrupted: the page links the {} of {} replays that are written",
                      replays_.written, trials_.size()));
      replays_.outcome = Outcome::kInterrupted;
    }
  }

  void Link(const ChosenTrial& worst) {
    ++replays_.written;
    files_.insert(FileName(worst));
    replays_.links[worst.run].push_back(
        {worst.record.trial, PercentEncoded(name_) + "/" + PercentEncoded(FileName(worst))});
  }

  void WriteOne(std::size_t i) {
    const ChosenTrial& worst = trials_[i];
    std::vector<core::Problem> problems;
    Outcome outcome = Outcome::kFailed;
    try {
      const TrialSource source =
          StoredTrial({.source = worst.folder.string(),
                       .cell = worst.cell,
                       .trial = static_cast<std::uint32_t>(worst.record.trial),
                       .seed = {},
                       .overrides = {}},
                      worst.identity, worst.builds, worst.record);
      if (!WriteReplayPage(source, worst.record.trial, replays_.folder / FileName(worst))) {
        outcome = Outcome::kDiffers;
        problems.push_back({fmt::format("{}, trial {}", worst.label, worst.record.trial),
                            "driven again, its record is not the stored one: it gets no replay",
                            "use the program that made the run: " + worst.builds.front()});
      }
    } catch (const core::UserError& error) {
      problems = error.problems();
    } catch (const std::exception& error) {
      problems.push_back({fmt::format("{}, trial {}", worst.label, worst.record.trial),
                          fmt::format("gets no replay: {}", error.what()), ""});
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    if (progress_) {
      progress_({ended_, trials_.size(), worst.record.trial, worst.label}, Moment::kUnderWay);
    }
    if (problems.empty()) {
      done_[i] = true;
      return;
    }
    // What is wrong with all of them, such as a plugin that was built anew, is told once.
    for (core::Problem& problem : problems) {
      const bool known = std::ranges::any_of(problems_, [&](const core::Problem& other) {
        return other.path == problem.path && other.reason == problem.reason;
      });
      if (!known) problems_.push_back(std::move(problem));
    }
    if (replays_.outcome != Outcome::kDiffers) replays_.outcome = outcome;
  }

  // Tells of older pages in the folder: they may be of other runs, and show what no longer holds.
  void TellLeftovers() const {
    std::size_t others = 0;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(replays_.folder, error)) {
      const fs::path file = entry.path().filename();
      if (file.extension() == ".html" && !files_.contains(file.string())) ++others;
    }
    if (others == 0) return;
    contact_.journal.Warn(
        fmt::format("{} older page{} in {} {} not of this report: remove {} if not needed", others,
                    others == 1 ? "" : "s", replays_.folder.string(), others == 1 ? "is" : "are",
                    others == 1 ? "it" : "them"));
  }

  const std::string name_;
  const std::span<const ChosenTrial> trials_;
  const Contact& contact_;
  const ReplayReport& progress_;
  std::mutex mutex_;
  std::vector<bool> done_;
  std::size_t ended_ = 0;
  std::vector<core::Problem> problems_;
  std::set<std::string> files_;  // that are linked
  ReportReplays replays_;
};

}  // namespace

std::vector<ChosenTrial> FindWorst(const StoredRun& run, std::size_t most) {
  std::vector<ChosenTrial> worst;
  if (truth::IsMeasurement(run.schema)) return worst;
  AddChosen(run, report::WorstTrials(run.schema, run.records, most), worst);
  return worst;
}

void AddChosen(const StoredRun& run, std::span<const std::uint64_t> trials,
               std::vector<ChosenTrial>& chosen) {
  const auto column = statistics::ColumnIndex(run.schema, "true_goal_distance_m");
  for (const std::uint64_t trial : trials) {
    if (std::any_of(chosen.begin(), chosen.end(),
                    [&](const ChosenTrial& each) { return each.record.trial == trial; })) {
      continue;
    }
    const auto at = std::lower_bound(
        run.records.begin(), run.records.end(), trial,
        [](const truth::Record& record, std::uint64_t wanted) { return record.trial < wanted; });
    truth::Record record = *at;
    record.values.Detach();
    chosen.push_back({.folder = run.folder,
                      .cell = run.identity.name.empty() ? std::string() : std::to_string(run.cell),
                      .identity = run.identity,
                      .builds = run.builds,
                      .record = std::move(record),
                      .run = 0,
                      .label = {},
                      .goal_distance_m = report::GoalDistanceOrInfinity(*at, column)});
  }
}

std::vector<ChosenTrial> Worst(std::vector<ChosenTrial> trials, std::size_t most) {
  std::stable_sort(trials.begin(), trials.end(), [](const ChosenTrial& a, const ChosenTrial& b) {
    return a.goal_distance_m > b.goal_distance_m;
  });
  if (trials.size() > most) trials.resize(most);
  return trials;
}

ReportReplays WriteReplays(const fs::path& page, std::span<const ChosenTrial> trials,
                           std::size_t runs, int threads, const Contact& contact,
                           const ReplayReport& progress) {
  return ReplayWriter(page, trials, runs, contact, progress).Write(threads);
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTolerance_m = 0.01;
constexpr std::size_t kMostPoints = 20000;  // that are simplified
constexpr std::size_t kMultibodyShare = 4;  // a multibody trial takes many times as long

std::vector<report::PageRock> RocksOf(const scenario::Scenario& scenario, std::uint64_t seed,
                                      std::uint64_t trial) {
  const core::TrialKey key{seed, static_cast<std::uint32_t>(trial)};
  const terrain::Field field =
      terrain::BuildField(scenario.drive.terrain, trial::LayoutKey(scenario.drive, key),
                          trial::TerrainCourse(scenario.drive.course));
  std::vector<report::PageRock> rocks;
  for (const terrain::Rock& rock : field.terrain.rocks()) {
    rocks.push_back({rock.center_W.x(), rock.center_W.y(),
                     std::max(rock.semi_axes_m.x(), rock.semi_axes_m.y())});
  }
  return rocks;
}

class Driver {
 public:
  Driver(const StoredRun& run, const scenario::Scenario& scenario, const TrackRequest& request,
         const Contact& contact, const TrackReport& progress)
      : run_(run),
        scenario_(scenario),
        experiment_(scenario.drive),
        request_(request),
        contact_(contact),
        progress_(progress) {}

  Tracks Drive() {
    const std::size_t first = FirstTrials();
    Choose(first);
    std::atomic<bool> stop{contact_.stop.IsWanted()};
    const Clock::time_point start = Clock::now();
    {
      const std::shared_ptr<void> watch = contact_.stop.Watch(stop, SecondWish::kEnds);
      batch::RunTasks(chosen_.size(), request_.threads, stop, [&](std::size_t i) {
        DriveOne(*chosen_[i]);
        const std::chrono::duration<double> spent = Clock::now() - start;
        if (contact_.stop.IsWanted() || spent.count() > request_.limit_s) stop = true;
      });
    }
    if (progress_) progress_({ended_, chosen_.size(), request_.label}, Moment::kEnd);
    if (differing_ > 0) {
      contact_.journal.Warn(fmt::format(
          "{}: {} of the trials that were driven again for the map are not the stored ones, and "
          "are left out of it: use the program that made the run: {}",
          request_.label, differing_, run_.builds.front()));
    }
    return Finish(first);
  }

 private:
  std::size_t FirstTrials() const {
    const bool multibody = scenario_.drive.rover.fidelity == rover::Fidelity::kMultibody;
    const std::size_t wanted =
        multibody ? (request_.first + kMultibodyShare - 1) / kMultibodyShare : request_.first;
    return std::min(wanted, run_.prefix().size());
  }

  void Choose(std::size_t first) {
    const auto add = [&](const truth::Record& record) {
      const bool chosen = std::any_of(chosen_.begin(), chosen_.end(), [&](const auto* each) {
        return each->trial == record.trial;
      });
      const bool drivable = !truth::IsFault(record) && !truth::IsNavigatorCrash(record);
      if (!chosen && drivable) chosen_.push_back(&record);
    };
    for (const auto* trials : {&request_.examples, &request_.named}) {
      for (const std::uint64_t trial : *trials) {
        add(*std::lower_bound(
            run_.records.begin(), run_.records.end(), trial,
            [](const auto& record, auto wanted) { return record.trial < wanted; }));
      }
    }
    for (const truth::Record& record : run_.prefix().first(first)) add(record);
  }

  bool IsExample(std::uint64_t trial) const {
    return std::find(request_.examples.begin(), request_.examples.end(), trial) !=
           request_.examples.end();
  }

  // Drives a trial; returns nothing where it is not the stored one.
  std::optional<report::PageTrack> Track(const truth::Record& stored) const {
    const std::uint64_t seed = run_.identity.seed;
    try {
      truth::Trace trace;
      const truth::Record record = experiment_.RunTraced(seed, stored.trial, trace);
      if (!report::RecordDifferences(run_.schema, stored, record).empty()) return std::nullopt;
      const report::TracePath path = report::Thinned(report::TruePath(trace), kMostPoints);
      report::PageTrack track{stored.trial, report::Simplified(path, kTolerance_m)};
      if (IsExample(stored.trial)) track.rocks = RocksOf(scenario_, seed, stored.trial);
      return track;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }

  void DriveOne(const truth::Record& stored) {
    std::optional<report::PageTrack> track = Track(stored);
    const std::lock_guard lock(mutex_);
    ++ended_;
    if (progress_) progress_({ended_, chosen_.size(), request_.label}, Moment::kUnderWay);
    if (track) {
      tracks_.tracks.push_back(std::move(*track));
    } else {
      ++differing_;
    }
  }

  Tracks Finish(std::size_t first) {
    auto& tracks = tracks_.tracks;
    std::sort(tracks.begin(), tracks.end(),
              [](const auto& a, const auto& b) { return a.trial < b.trial; });
    tracks_.first = static_cast<std::size_t>(std::count_if(
        tracks.begin(), tracks.end(), [&](const auto& each) { return each.trial < first; }));
    return std::move(tracks_);
  }

  const StoredRun& run_;
  const scenario::Scenario& scenario_;
  const experiments::DriveExperiment experiment_;
  const TrackRequest& request_;
  const Contact& contact_;
  const TrackReport& progress_;
  std::vector<const truth::Record*> chosen_;
  std::mutex mutex_;
  std::size_t ended_ = 0;
  std::size_t differing_ = 0;
  Tracks tracks_;
};

// Returns the scenario, with its plugins where they may run; nothing, and a note, where not, or
// where one is another than it was.
std::optional<scenario::Scenario> OpenedScenario(const StoredRun& run, bool plugins,
                                                 const Contact& contact) {
  std::optional<scenario::Scenario> sealed = ScenarioOf(run);
  if (!sealed || !sealed->drive.foreign()) return sealed;
  if (!plugins) {
    contact.journal.Remark(fmt::format(
        "{}: no trial is driven again, as a plugin decides (--plugins lets it)", run.Label()));
    return std::nullopt;
  }
  try {
    return scenario::ReadScenario(core::ParseJson(run.identity.resolved, "resolved scenario"));
  } catch (const core::UserError& error) {
    contact.journal.Warn(
        fmt::format("{}: no trial is driven again: {}", run.Label(), error.what()));
    return std::nullopt;
  }
}

}  // namespace

Tracks DriveTracks(const StoredRun& run, const TrackRequest& request, const Contact& contact,
                   const TrackReport& progress) {
  if (request.first == 0 || truth::IsMeasurement(run.schema)) return {};
  const auto scenario = OpenedScenario(run, request.plugins, contact);
  if (!scenario) return {};
  return Driver(run, *scenario, request, contact, progress).Drive();
}

}  // namespace rockyard::campaign
