#include "app/campaign_options.h"

#include <CLI/CLI.hpp>

#include "app/set_options.h"

namespace rockyard::app {
namespace {

void AddPlanOptions(CLI::App& command, CampaignOptions& options) {
  CLI::Option* trials = command.add_option(
      "--trials", options.request.trials, "number of trials (of each cell), those stored included");
  CLI::Option* until =
      command
          .add_option("--until-half-width", options.until_half_width,
                      "run until the 95 % interval of declared success has this half-width, "
                      "e.g. 0.02")
          ->check(CLI::Range(0.0005, 0.49))
          ->excludes(trials);
  command.add_option("--max-trials", options.rule.max_trials, "most trials (of each cell) of that")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
      ->capture_default_str()
      ->needs(until);
  command.add_option("--block", options.rule.block, "trials between two looks of that")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str()
      ->needs(until);
  command
      .add_option("--allocate", options.allocate,
                  "which cells get the next blocks of that: all (uniform), or the half of them "
                  "with the widest intervals (adaptive)")
      ->check(CLI::IsMember({"uniform", "adaptive"}))
      ->capture_default_str()
      ->needs(until);
  command
      .add_option("--budget", options.rule.budget,
                  "most trials of all cells together (default: no limit)")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
      ->needs(until);
  command.add_option("--shard", options.request.shard,
                     "I/N: only the I-th of N parts of the trials; `rockyard merge` puts the parts "
                     "together");
  command.add_option("--seed", options.request.seed, "seed of every random stream");
  AddSetOptions(command, options.request.overrides);
}

void AddFolderOptions(CLI::App& command, CampaignOptions& options) {
  command.add_option("--out", options.out, "run folder (default: results/runs/<name>-seed<seed>)");
  CLI::Option* resume = command.add_flag(
      "--resume", options.resume, "go on with the run in the folder; a larger --trials extends it");
  CLI::Option* retry = command.add_flag("--retry-faults", options.request.retry_faults,
                                        "with --resume: drive again what ended in a simulator "
                                        "fault, as where the machine was to blame");
  retry->needs(resume);
  command.add_flag("--force", options.force,
                   "set a run in the folder and the files of its names aside (as *.old-1.*: "
                   "nothing is deleted) and start anew; with --resume only where it cannot go on");
  command.add_flag("--any-build", options.any_build,
                   "let --resume mix trials of different builds of the program");
  command
      .add_flag("--dry-run", options.dry_run,
                "print what would be done and what it would cost, from a few pilot trials; do "
                "nothing else")
      ->excludes(retry);
}

// `options` must outlive the command.
void AddTraceOptions(CLI::App& command, campaign::TraceOptions& options) {
  CLI::Option* traces =
      command
          .add_option("--traces", options.rules,
                      "afterwards drive chosen trials again and write their course into the "
                      "folder traces: all, failures, worst:N (failures that ended furthest from "
                      "the goal, of each cell), share:P (a random share); repeat for more")
          // Completion and the pages of commands read the choices from the name of the type.
          ->type_name("RULE:{all,failures,worst:N,share:P}")
          ->allow_extra_args(false);
  command
      .add_option("--trace-format", options.format,
                  "of these files: npz (arrays for NumPy), csv (samples and events) or mcap (for "
                  "Foxglove and other readers of MCAP)")
      ->check(CLI::IsMember(std::vector<std::string>(campaign::kTraceFormatNames.begin(),
                                                     campaign::kTraceFormatNames.end())))
      ->capture_default_str()
      ->needs(traces);
}

void AddProcessOptions(CLI::App& command, CampaignOptions& options) {
  command
      .add_option("--threads", options.request.containment.threads,
                  "threads (default: all of the machine)")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--max-faults", options.request.max_fault_fraction,
                  "fraction of simulator faults above which the run fails")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_flag("--no-supervisor", options.no_supervisor,
                   "one process: a crash of the simulator ends the run");
  command
      .add_option("--trial-cpu-limit", options.request.containment.trial_cpu_limit_s,
                  "CPU seconds after which a trial is taken to hang; 0: none")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--rank-silence", options.request.containment.rank_silence_s,
                  "under mpirun: seconds without a sign of life after which a rank is given up and "
                  "others run its trials; 0: waits for ever")
      ->check(CLI::Range(2.0, 1e6) | CLI::IsMember({0.0}))
      ->capture_default_str();
  CLI::Option* json =
      command.add_flag("--json", options.json, "print summary.json instead of the table");
  command.add_flag("--quiet", options.quiet, "print nothing but errors")->excludes(json);
}

}  // namespace

Output CampaignOptions::output() const {
  if (json) return Output::kJson;
  return quiet ? Output::kQuiet : Output::kText;
}

campaign::CampaignRequest CampaignOptions::Request() const {
  using campaign::ExistingRun;
  campaign::CampaignRequest wanted = request;
  wanted.folder = out;
  if (resume) {
    wanted.existing = force ? ExistingRun::kResumeOrSetAside : ExistingRun::kResume;
  } else {
    wanted.existing = force ? ExistingRun::kSetAside : ExistingRun::kRefuse;
  }
  wanted.build = any_build ? batch::BuildPolicy::kAny : batch::BuildPolicy::kSame;
  if (until_half_width > 0.0) {
    wanted.rule = rule;
    wanted.rule->half_width = until_half_width;
    wanted.rule->allocation =
        allocate == "adaptive" ? batch::Allocation::kAdaptive : batch::Allocation::kUniform;
  }
  wanted.method = interval == "wilson" ? statistics::IntervalMethod::kWilson
                                       : statistics::IntervalMethod::kClopperPearson;
  wanted.containment.supervisor = !no_supervisor;
  return wanted;
}

void AddCampaignOptions(CLI::App& command, CampaignOptions& options) {
  AddPlanOptions(command, options);
  AddFolderOptions(command, options);
  AddTraceOptions(command, options.request.traces);
  AddProcessOptions(command, options);
}

void AddIntervalOption(CLI::App& command, CampaignOptions& options) {
  command.add_option("--interval", options.interval, "of rates: wilson or clopper-pearson")
      ->check(CLI::IsMember({"wilson", "clopper-pearson"}))
      ->capture_default_str();
}

}  // namespace rockyard::app
