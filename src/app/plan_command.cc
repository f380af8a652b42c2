// The command `rockyard plan`: how many trials a question needs, with a subcommand for each
// question.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "batch/work_plan.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/json_value.h"
#include "statistics/sample_size.h"

namespace rockyard::app {
namespace {

using statistics::IntervalMethod;

// A question and its answers.
class PlanReport {
 public:
  explicit PlanReport(std::string question) : question_(std::move(question)) {}

  // Adds an answer: `key` names it for programs, `what` for people.
  void Add(std::string key, std::string what, std::int64_t trials);
  void Add(std::string key, std::string what, double probability);

  struct Line {
    std::string key;
    std::string what;
    core::JsonValue number;
    bool cut_off = false;
  };
  const std::string& question() const { return question_; }
  const std::vector<Line>& lines() const { return lines_; }

 private:
  std::string question_;
  std::vector<Line> lines_;
};

// Returns whether a number of trials is where the search for it ended, and so no answer.
bool IsCutOff(std::int64_t trials) { return trials >= statistics::kMaxTrials; }

void PlanReport::Add(std::string key, std::string what, std::int64_t trials) {
  const bool cut_off = IsCutOff(trials);
  if (cut_off) what += " (that many or more: the search ends there)";
  lines_.push_back({std::move(key), std::move(what), core::JsonValue(trials), cut_off});
}

void PlanReport::Add(std::string key, std::string what, double probability) {
  lines_.push_back({std::move(key), std::move(what), core::JsonValue(probability), false});
}

std::string PlanText(const PlanReport& report) {
  std::string text = report.question() + "\n";
  for (const PlanReport::Line& line : report.lines()) {
    const bool whole = line.number.Is(core::JsonValue::Type::kInteger);
    const std::string number =
        whole ? std::to_string(line.number.integer()) : fmt::format("{:.4f}", line.number.number());
    text += fmt::format("  {:>10}  {}\n", number, line.what);
  }
  return text;
}

// Returns {"question", and a number for each key}, with "KEY_or_more": true beside a number whose
// search was cut off.
std::string PlanJson(const PlanReport& report) {
  core::JsonValue json = core::JsonValue::Object();
  json.Set("question", core::JsonValue(report.question()));
  for (const PlanReport::Line& line : report.lines()) {
    json.Set(line.key, line.number);
    if (line.cut_off) json.Set(line.key + "_or_more", core::JsonValue(true));
  }
  return core::DumpJson(json);
}

// The options that questions share; each takes those that it needs.
struct PlanOptions {
  double confidence = 0.95;
  double alpha = 0.05;
  double power = 0.8;
  bool json = false;
};

constexpr double kMinConfidence = 0.5;
constexpr double kMaxConfidence = 0.999999;

void AddConfidence(CLI::App& command, PlanOptions& options) {
  command.add_option("--confidence", options.confidence, "of the interval or the claim")
      ->check(CLI::Range(kMinConfidence, kMaxConfidence))
      ->capture_default_str();
}

void AddTest(CLI::App& command, PlanOptions& options) {
  command.add_option("--alpha", options.alpha, "level of the test")
      ->check(CLI::Range(1e-9, 0.5))
      ->capture_default_str();
  command.add_option("--power", options.power, "chance to find what is there")
      ->check(CLI::Range(0.05, 0.9999))
      ->capture_default_str();
}

void AddJson(CLI::App& command, PlanOptions& options) {
  command.add_flag("--json", options.json, "for programs");
}

void Show(const PlanReport& report, const PlanOptions& options) {
  if (options.json) return PrintJson(PlanJson(report));
  Print(Wrapped(PlanText(report)));
}

struct HalfWidthQuestion {
  PlanOptions options;
  double rate = 0.5;
  double half_width = 0.0;
  std::int64_t block = batch::StoppingRule{}.block;  // the default of run --block
};

void PlanHalfWidth(const HalfWidthQuestion& q) {
  const double confidence = q.options.confidence;
  PlanReport report(fmt::format(
      "trials for an interval of rate +- {:g} at {:g} confidence, if the rate is near {:g}",
      q.half_width, confidence, q.rate));
  report.Add(
      "wilson", "Wilson, number fixed beforehand",
      statistics::TrialsForHalfWidth(q.rate, q.half_width, confidence, IntervalMethod::kWilson));
  report.Add("clopper_pearson", "Clopper-Pearson, number fixed beforehand",
             statistics::TrialsForHalfWidth(q.rate, q.half_width, confidence,
                                            IntervalMethod::kClopperPearson));
  report.Add("stopped", fmt::format("--until-half-width, about, in blocks of {}", q.block),
             statistics::TrialsForStopping(q.rate, q.half_width, confidence, q.block));
  Show(report, q.options);
}

void AddHalfWidth(CLI::App& plan) {
  auto q = std::make_shared<HalfWidthQuestion>();
  CLI::App* command = plan.add_subcommand("half-width", "A rate, known to within a half-width");
  command->add_option("--half-width", q->half_width, "such as 0.02")
      ->required()
      ->check(CLI::Range(1e-5, 0.49));
  command->add_option("--rate", q->rate, "guess; 0.5 is the worst case")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--block", q->block, "trials between two looks")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  AddConfidence(*command, q->options);
  AddJson(*command, q->options);
  command->callback([q] { PlanHalfWidth(*q); });
}

struct ClaimQuestion {
  PlanOptions options;
  double below = 0.0;
  std::int64_t failures = 0;
};

void PlanClaim(const ClaimQuestion& q) {
  PlanReport report(
      fmt::format("trials for the claim \"fails in less than {:g} of all trials\"", q.below));
  const std::int64_t trials = statistics::TrialsForClaim(q.below, q.options.confidence, q.failures);
  report.Add("trials",
             fmt::format("with {:g} confidence, if no more than {} fail", q.options.confidence,
                         q.failures),
             trials);
  if (q.failures == 0) {
    report.Add("rule_of_three", "rule of three (95 %, no failure): 3 over the rate",
               std::int64_t{std::llround(std::ceil(3.0 / q.below))});
  }
  for (const double part : {2.0, 5.0, 10.0}) {
    if (IsCutOff(trials)) break;
    report.Add(fmt::format("chance_at_{:g}th", part),
               fmt::format("chance to pass if the true rate is {:g}", q.below / part),
               statistics::ClaimChance(trials, q.below / part, q.failures));
  }
  Show(report, q.options);
}

void AddClaim(CLI::App& plan) {
  auto q = std::make_shared<ClaimQuestion>();
  CLI::App* command = plan.add_subcommand("claim", "\"Fails less than once in 1000\"");
  command->add_option("--below", q->below, "failure rate of the claim, such as 0.001")
      ->required()
      ->check(CLI::Range(1e-7, 0.5));
  command->add_option("--failures", q->failures, "that may be seen all the same")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  AddConfidence(*command, q->options);
  AddJson(*command, q->options);
  command->callback([q] { PlanClaim(*q); });
}

struct DifferenceQuestion {
  PlanOptions options;
  double first = 0.0;
  double second = 0.0;
  double discordant = -1.0;  // below 0: not given
};

// Returns the shares of pairs in which only the first succeeds, and only the second. Throws
// core::UserError where no pairs with these rates have so many discordant ones.
statistics::RatePair DiscordantRates(const DifferenceQuestion& q) {
  const double difference = q.second - q.first;
  const double least = std::abs(difference);
  const double most = std::min({q.first + q.second, 2.0 - q.first - q.second, 1.0});
  if (q.discordant < least - 1e-12 || q.discordant > most + 1e-12) {
    throw core::UserError("--discordant",
                          fmt::format("is {:g}, which no pairs with rates {:g} and {:g} have",
                                      q.discordant, q.first, q.second),
                          fmt::format("use a share from {} to {}", least, most));
  }
  return {0.5 * (q.discordant - difference), 0.5 * (q.discordant + difference)};
}

void PlanDifference(const DifferenceQuestion& q) {
  if (q.first == q.second) {
    throw core::UserError("--to", "is the rate of --from, so that there is no difference to find",
                          "give the rate that matters, or use rockyard plan equivalence");
  }
  const PlanOptions& o = q.options;
  PlanReport report(
      fmt::format("trials to tell a rate of {:g} from one of {:g} (alpha {:g}, power {:g})",
                  q.first, q.second, o.alpha, o.power));
  const statistics::RatePair rates{q.first, q.second};
  const std::int64_t group = statistics::TrialsForFisher(rates, o.alpha, o.power);
  report.Add("fisher", "of each of two groups with other seeds, Fisher's exact test", group);
  if (group <= statistics::kMaxExactFisher) {
    report.Add("fisher_power", "    its exact power",
               statistics::FisherPower(group, rates, o.alpha));
  }
  if (q.discordant >= 0.0) {
    report.Add(
        "mcnemar",
        fmt::format("pairs with the same seeds, {:g} of them discordant, McNemar's exact test",
                    q.discordant),
        statistics::TrialsForMcNemar(DiscordantRates(q), o.alpha, o.power));
  }
  Show(report, o);
}

void AddDifference(CLI::App& plan) {
  auto q = std::make_shared<DifferenceQuestion>();
  CLI::App* command = plan.add_subcommand("difference", "Two rates, told apart");
  command->add_option("--from", q->first, "rate of the one")
      ->required()
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--to", q->second, "rate of the other")
      ->required()
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--discordant", q->discordant,
                      "share of pairs in which just one succeeds, for runs with the same seeds");
  AddTest(*command, q->options);
  AddJson(*command, q->options);
  command->callback([q] { PlanDifference(*q); });
}

struct EquivalenceQuestion {
  PlanOptions options;
  double margin = 0.0;
  double deviation = 0.0;
};

void PlanEquivalence(const EquivalenceQuestion& q) {
  const PlanOptions& o = q.options;
  PlanReport report(fmt::format(
      "trials to show that two means differ by less than {:g} (TOST, alpha {:g}, power {:g})",
      q.margin, o.alpha, o.power));
  const auto trials = [&](statistics::Pairing pairing) {
    return statistics::TrialsForEquivalence(q.margin, q.deviation, o.alpha, o.power, pairing);
  };
  report.Add("unpaired", fmt::format("of each group, standard deviation {:g} in both", q.deviation),
             trials(statistics::Pairing::kUnpaired));
  report.Add("paired",
             fmt::format("pairs, standard deviation {:g} of their differences", q.deviation),
             trials(statistics::Pairing::kPaired));
  Show(report, o);
}

void AddEquivalence(CLI::App& plan) {
  auto q = std::make_shared<EquivalenceQuestion>();
  CLI::App* command = plan.add_subcommand("equivalence", "Two means, shown to be alike");
  command->add_option("--margin", q->margin, "difference that matters, in any unit")
      ->required()
      ->check(CLI::Range(1e-12, 1e12));
  command
      ->add_option("--deviation", q->deviation,
                   "standard deviation in that unit; of a rate p: sqrt(p (1 - p))")
      ->required()
      ->check(CLI::Range(0.0, 1e12));
  AddTest(*command, q->options);
  AddJson(*command, q->options);
  command->callback([q] { PlanEquivalence(*q); });
}

}  // namespace

void AddPlanCommand(CLI::App& app) {
  CLI::App* plan = app.add_subcommand("plan", "How many trials a question needs");
  plan->require_subcommand(1);
  AddHalfWidth(*plan);
  AddClaim(*plan);
  AddDifference(*plan);
  AddEquivalence(*plan);
}

}  // namespace rockyard::app
