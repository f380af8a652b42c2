#include <fmt/format.h>

#include "report/attribution.h"
#include "report/line_text.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using statistics::Attribution;
using statistics::Estimate;

constexpr std::size_t kNameWidth = 23;  // three intervals beside it fit 100 columns
constexpr std::size_t kPlaceWidth = 30;
// Longer tables are for files.
constexpr std::size_t kMaxEffects = 15;

std::string Percent(const Estimate& estimate) {
  return fmt::format("{:6.1f} ({:6.1f} ..{:6.1f})", 100.0 * estimate.value,
                     100.0 * estimate.interval.low, 100.0 * estimate.interval.high);
}

std::string Percent(const statistics::Proportion& rate) {
  return Percent(Estimate{rate.rate, rate.interval});
}

std::string Shares(const Attribution& result) {
  std::string text = fmt::format("  {:<{}} {:<24} {:<24} {}\n", "made perfect removes, %",
                                 kNameWidth, "Shapley share", "alone", "after all others");
  for (const statistics::FunctionShare& row : result.shares) {
    text += fmt::format("  {:<{}} {} {} {}\n", Cut(row.function, kNameWidth), kNameWidth,
                        Percent(row.share), Percent(row.first), Percent(row.last));
  }
  text += fmt::format("  {:<{}} {} {:6.1f}: these need not sum\n", "all of them", kNameWidth,
                      Percent(result.removed), 100.0 * result.sum_of_firsts);
  return text;
}

std::string Failures(const Attribution& result) {
  return fmt::format("  {:<{}} {}\n  {:<{}} {}\n", "fail as flown, %", kNameWidth,
                     Percent(result.failures.front()), "fail, all perfect, %", kNameWidth,
                     Percent(result.remainder));
}

std::string Effects(const Attribution& result) {
  std::string text =
      "  effects on the failure probability, points of per cent (interactions: halved "
      "differences)\n";
  for (std::size_t i = 0; i < result.effects.size() && i < kMaxEffects; ++i) {
    const statistics::EffectOfSet& row = result.effects[i];
    text += fmt::format("    {}  {}\n", Percent(row.effect),
                        statistics::NameOf(row.set, result.functions).substr(0, 70));
  }
  return text;
}

std::string Combinations(const Attribution& result) {
  std::string text = "  failures with these perfect, %\n";
  for (std::size_t c = 0; c < result.failures.size() && c <= kMaxEffects; ++c) {
    const auto set = static_cast<statistics::Combination>(c);
    const std::string name = statistics::NameOf(set, result.functions, " + ");
    text += fmt::format("    {}  {}\n", Percent(result.failures[c]), name.substr(0, 70));
  }
  return text;
}

std::string Table(const SweepAttribution& attribution, std::size_t kind) {
  const Attribution& result = attribution.by_success[kind];
  const std::string at = attribution.at.empty() ? "" : ", " + Cut(attribution.at, kPlaceWidth);
  std::string text = fmt::format("\nattribution of failures, {}{}: {} paired trials\n",
                                 kSuccessNames[kind], at, result.trials);
  if (attribution.left_out > 0) {
    text += fmt::format("  {} with a fault in some cell left out\n", attribution.left_out);
  }
  if (result.trials == 0) return text;
  text += Failures(result) + Shares(result);
  // The other definition of success gets the short table.
  if (kind == static_cast<std::size_t>(SuccessKind::kDeclared)) return text;
  return text + Effects(result) + Combinations(result);
}

}  // namespace

std::string AttributionText(std::span<const SweepAttribution> attributions) {
  std::string text;
  for (const SweepAttribution& attribution : attributions) {
    text += Table(attribution, static_cast<std::size_t>(SuccessKind::kTrue));
    text += Table(attribution, static_cast<std::size_t>(SuccessKind::kDeclared));
  }
  return text;
}

}  // namespace rockyard::report
