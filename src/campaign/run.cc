#include "campaign/run.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "campaign/folder_report.h"
#include "campaign/run_source.h"
#include "campaign/scenario_doubts.h"
#include "campaign/shell_word.h"
#include "scenario/ablations.h"

namespace rockyard::campaign {
namespace {

void AddSettings(const RunRequest& request, std::vector<std::string>& settings) {
  for (const std::string& setting : request.campaign.overrides) settings.push_back(setting);
  for (const std::string& name : request.ablations) settings.push_back("--ablate " + name);
}

// Every option that changes the scenario.
std::vector<std::string> OverridesOf(const RunRequest& request) {
  std::vector<std::string> overrides = request.campaign.overrides;
  if (request.campaign.trials) {
    overrides.push_back(fmt::format("trials={}", *request.campaign.trials));
  }
  if (request.campaign.seed) overrides.push_back(fmt::format("seed={}", *request.campaign.seed));
  return overrides;
}

CampaignPlan PlanOf(const RunRequest& request) {
  const scenario::Scenario scenario =
      scenario::WithAblations(LoadScenarioFrom(request.source, OverridesOf(request)),
                              request.ablations)
          .scenario;
  std::string folder = scenario.name;
  for (const std::string& ablation : request.ablations) folder += fmt::format("-{}", ablation);
  std::optional<std::vector<std::string>> settings = SettingsOf(request.source);
  if (settings) AddSettings(request, *settings);
  return {.name = scenario.name,
          .design = "",
          .folder = DefaultFolder(folder, scenario.seed),
          .cells = {{.name = "", .scenario = scenario}},
          .settings = std::move(settings)};
}

// An ablation that changes nothing may be a mistake: nothing of that kind is in the scenario.
void RemarkIdleAblations(const RunRequest& request, Journal& journal) {
  if (request.ablations.empty() || !IsFirstRank()) return;
  const scenario::Scenario base = LoadScenarioFrom(request.source, request.campaign.overrides);
  for (const std::string& name : scenario::WithAblations(base, request.ablations).idle) {
    journal.Remark(fmt::format("--ablate {} changes nothing in this scenario", name));
  }
}

// Its name may be that of a scenario, which was meant.
void RemarkFolder(const RunRequest& request, Journal& journal) {
  std::error_code error;
  if (!IsFirstRank() || !std::filesystem::is_directory(request.source, error)) return;
  journal.Remark(fmt::format("{} is the folder of a run, whose settings are taken",
                             ShellPath(request.source.string())));
}

// What the scenario has without saying so may not be meant.
void WarnOfDoubts(const RunRequest& request, Journal& journal) {
  if (!IsFirstRank()) return;
  for (const core::Problem& doubt : DoubtsOf(request.source, OverridesOf(request))) {
    journal.Warn("doubtful: " + campaign::TextOf(doubt));
  }
}

}  // namespace

WorkResult Run(const RunRequest& request, const RunObserver& observer, const Stop& stop) {
  const CampaignRequest& campaign = request.campaign;
  const ReportSettings settings{.method = campaign.method, .threads = campaign.containment.threads};
  return Recorded(observer, [&](Journal& journal) {
    RemarkFolder(request, journal);
    WarnOfDoubts(request, journal);
    RemarkIdleAblations(request, journal);
    return RunCampaign(
        campaign, [&] { return PlanOf(request); },
        [&](const OpenedRun& run) { return ReportRun(run.folder, settings); }, observer,
        {journal, stop});
  });
}

core::Result<DryRun> Rehearse(const RunRequest& request, const Observer& observer) {
  return core::Attempt([&] {
    Journal journal(observer);
    RemarkFolder(request, journal);
    WarnOfDoubts(request, journal);
    RemarkIdleAblations(request, journal);
    return Rehearse(request.campaign, PlanOf(request));
  });
}

}  // namespace rockyard::campaign
