#include "campaign/campaign_request.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace rockyard::campaign {
namespace {

constexpr int kMaxShards = 1'000'000;

bool ParseWhole(std::string_view text, int& number) {
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc{} && result.ptr == end;
}

// What a stopping rule asks of the cells.
void CheckRule(const CampaignRequest& request, const CampaignPlan& plan,
               std::vector<core::Problem>& problems) {
  if (!request.rule) return;
  if (!request.ParseShard().whole()) {
    problems.push_back({"--until-half-width",
                        "looks at trials 0, 1, 2, ... of a cell, of which a shard has only some",
                        "leave out --shard, or say how many trials to run with --trials"});
  }
  for (const CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment.kind != experiments::ExperimentKind::kDrive) {
      problems.push_back({"--until-half-width",
                          fmt::format("needs drives, and {} measures", cell.Label()),
                          "say how many trials to run with --trials"});
    } else if (cell.scenario.drive.course.trials_per_layout > 1) {
      problems.push_back(
          {"--until-half-width",
           fmt::format("needs independent trials, and in {} {} trials share a layout of rocks",
                       cell.Label(), cell.scenario.drive.course.trials_per_layout),
           "set course.trials_per_layout=1, or say how many trials to run with --trials"});
    }
  }
}

// What traces ask of the cells.
void CheckTraces(const CampaignRequest& request, const CampaignPlan& plan,
                 std::vector<core::Problem>& problems) {
  try {
    if (!request.traces.retention().any()) return;
  } catch (const core::UserError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    return;
  }
  if (request.traces.retention().worst > 0 && !request.ParseShard().whole()) {
    problems.push_back({"--traces",
                        "worst:N is asked of all trials, of which a shard has only some",
                        "leave it out, merge the shards, and ask for it there with --resume"});
  }
  for (const CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment.kind == experiments::ExperimentKind::kDrive) continue;
    problems.push_back(
        {"--traces", fmt::format("needs drives, and {} measures", cell.Label()), "leave it out"});
  }
}

}  // namespace

batch::Shard CampaignRequest::ParseShard() const {
  if (shard.empty()) return {};
  const std::size_t slash = shard.find('/');
  const std::string_view text = shard;
  batch::Shard parsed;
  const bool numbers = slash != std::string::npos &&
                       ParseWhole(text.substr(0, slash), parsed.index) &&
                       ParseWhole(text.substr(slash + 1), parsed.count);
  if (!numbers || parsed.index < 1 || parsed.index > parsed.count || parsed.count > kMaxShards) {
    throw core::UserError("--shard", fmt::format("\"{}\" is no part of a campaign", shard),
                          "use I/N with 1 <= I <= N, e.g. 1/4");
  }
  return parsed;
}

void CheckPlan(const CampaignRequest& request, const CampaignPlan& plan) {
  std::vector<core::Problem> problems;
  CheckRule(request, plan, problems);
  CheckTraces(request, plan, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
}

}  // namespace rockyard::campaign
