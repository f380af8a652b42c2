#include "campaign/report_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include "batch/parallel_tasks.h"
#include "campaign/report_inputs.h"
#include "experiments/drive/drive_experiment.h"
#include "report/trace_path.h"
#include "report/trace_view.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
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
      if (!chosen && !truth::IsFault(record)) chosen_.push_back(&record);
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

  // Nothing where the trial is not the stored one.
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

}  // namespace

Tracks DriveTracks(const StoredRun& run, const TrackRequest& request, const Contact& contact,
                   const TrackReport& progress) {
  if (request.first == 0 || truth::IsMeasurement(run.schema)) return {};
  const auto scenario = ScenarioOf(run);
  if (!scenario) return {};
  return Driver(run, *scenario, request, contact, progress).Drive();
}

}  // namespace rockyard::campaign
