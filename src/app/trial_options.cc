#include "app/trial_options.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <system_error>

#include "app/console.h"
#include "app/run_folders.h"
#include "app/scenario_names.h"

namespace rockyard::app {

void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request) {
  command
      .add_option("SCENARIO_OR_RUN", request.source,
                  "scenario file or its name, scenario.resolved.json, or the folder of a run")
      ->required();
  command.add_option("--trial", request.trial, "trial index, from 0")->required();
  command.add_option("--cell", request.cell, "cell of a campaign: its name, or number from 0");
  command.add_option("--seed", request.seed, "seed of every random stream");
  command.add_option("--set", request.overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
}

void FindSource(campaign::TrialRequest& request) {
  request.source = ScenarioFile(request.source);
  RequireRuns(std::span(&request.source, 1));
}

void PrintRepetition(std::optional<bool> repeats_stored, const std::string& source) {
  std::error_code error;
  if (repeats_stored.value_or(false)) {
    Print("  same as the stored record, bit for bit\n");
  } else if (!repeats_stored && std::filesystem::is_directory(source, error)) {
    Print("  pending in the run: compared with nothing\n");
  }
}

}  // namespace rockyard::app
