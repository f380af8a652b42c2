#include "api/campaign.h"

#include <utility>
#include <variant>

#include "campaign/check.h"
#include "campaign/compare.h"
#include "campaign/reference_cases.h"
#include "campaign/report.h"
#include "campaign/run.h"

namespace rockyard::api {
namespace {

campaign::CampaignRequest CampaignOf(const RunRequest& request) {
  campaign::CampaignRequest campaign{.trials = request.trials,
                                     .seed = request.seed,
                                     .overrides = request.overrides,
                                     .folder = request.folder,
                                     .existing = request.existing,
                                     .shard = request.shard,
                                     .max_fault_fraction = request.max_fault_fraction,
                                     .defaults = request.defaults.values(),
                                     .program = request.program};
  campaign.containment.threads = request.threads;
  campaign.traces.rules = request.traces;
  return campaign;
}

campaign::RunObserver ObserverOf(const RunRequest& request) {
  campaign::RunObserver observer{request.observer};
  if (request.progress) {
    observer.trials = [&request](const batch::Progress& progress, campaign::Moment) {
      request.progress(progress.finished, progress.planned);
    };
  }
  return observer;
}

}  // namespace

campaign::WorkResult Run(const RunRequest& request) {
  return campaign::Run({.source = request.source, .campaign = CampaignOf(request)},
                       ObserverOf(request), {.wanted = request.stop});
}

campaign::WorkResult Sweep(const RunRequest& request) {
  return campaign::RunSweep({.file = request.source, .campaign = CampaignOf(request)},
                            ObserverOf(request), {.wanted = request.stop});
}

campaign::WorkResult Merge(const MergeRequest& request) {
  return campaign::Merge(
      {.shards = request.shards, .folder = request.folder, .partial = request.partial},
      {request.observer});
}

campaign::WorkResult Report(const ReportRequest& request) {
  const campaign::ReportResult result =
      campaign::WriteReport({.runs = request.runs,
                             .cell = request.cell,
                             .page = request.page.string(),
                             .data = request.data.string(),
                             .against = request.reference.string(),
                             .title = request.title,
                             .replays = request.replays,
                             .tracks = request.tracks,
                             .plugins = request.plugins},
                            {request.observer}, {.wanted = request.stop});
  return static_cast<const campaign::WorkResult&>(result);
}

void WriteBaseline(const BaselineRequest& request) {
  campaign::WriteBaseline({.runs = request.runs, .name = request.name, .reason = request.reason},
                          request.file)
      .OrThrow();
}

Finding Check(const CheckRequest& request, const campaign::Observer& observer) {
  const campaign::CheckResult result =
      campaign::Check({.runs = request.runs, .reference = request.reference, .cell = request.cell},
                      observer)
          .OrThrow();
  return std::visit(
      [](const auto& check) {
        return Finding{check.outcome, campaign::CheckJson(check)};
      },
      result);
}

Finding Compare(const CompareRequest& request) {
  const campaign::Comparison found = campaign::Compare({.first = request.first,
                                                        .second = request.second,
                                                        .cell = request.cell,
                                                        .second_cell = request.second_cell})
                                         .OrThrow();
  return {found.outcome, campaign::ComparisonJson(found)};
}

}  // namespace rockyard::api
