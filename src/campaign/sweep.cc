#include "campaign/sweep.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "campaign/folder_report.h"
#include "campaign/scenario_doubts.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

// Problems name the file, of which a cluster job may have many.
scenario::Sweep RequestedSweep(const SweepRequest& request) {
  const std::string file = request.file.string();
  try {
    return scenario::LoadSweep(file, {.overrides = request.campaign.overrides,
                                      .trials = request.campaign.trials,
                                      .seed = request.campaign.seed});
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      if (problem.path.starts_with(file)) continue;
      problem.path = fmt::format("{}: {}", file, problem.path);
    }
    throw core::UserError(std::move(problems));
  }
}

CampaignPlan PlanOfCells(const SweepRequest& request, const scenario::Sweep& sweep) {
  CampaignPlan plan{.name = sweep.name,
                    .design = sweep.document,
                    .folder = DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed)),
                    .cells = {},
                    .settings = request.campaign.overrides};
  for (const scenario::SweepCell& cell : sweep.cells) {
    plan.cells.push_back({.name = cell.name, .scenario = cell.scenario});
  }
  return plan;
}

void WarnOfDoubts(const scenario::Sweep& sweep, Journal& journal) {
  for (const core::Problem& doubt : DoubtsOf(sweep))
    journal.Warn("doubtful: " + campaign::TextOf(doubt));
}

}  // namespace

WorkResult RunSweep(const SweepRequest& request, const RunObserver& observer, const Stop& stop) {
  const CampaignRequest& campaign = request.campaign;
  const ReportSettings settings{.method = campaign.method, .threads = campaign.containment.threads};
  // Read where trials are planned: on rank 0 alone, so that a mistake is told once.
  scenario::Sweep sweep;
  return Recorded(observer, [&](Journal& journal) {
    return RunCampaign(
        campaign,
        [&] {
          sweep = RequestedSweep(request);
          WarnOfDoubts(sweep, journal);
          return PlanOfCells(request, sweep);
        },
        [&](const OpenedRun& run) { return ReportSweep(run.store, sweep, settings); }, observer,
        {journal, stop});
  });
}

core::Result<SweepRehearsal> RehearseSweep(const SweepRequest& request, int pilots,
                                           const Observer& observer) {
  return core::Attempt([&] {
    Journal journal(observer);
    SweepRehearsal told{.sweep = RequestedSweep(request), .trials = {}, .plan = {}};
    WarnOfDoubts(told.sweep, journal);
    const CampaignPlan plan = PlanOfCells(request, told.sweep);
    CheckPlan(request.campaign, plan);
    told.trials = TrialsOf(OpeningOf(request.campaign, plan), plan);
    told.plan = WriteSweepPlan(
        told.sweep, {.folder = request.campaign.folder, .trials = told.trials, .pilots = pilots});
    return told;
  });
}

}  // namespace rockyard::campaign
