#include "report/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "report/comparison_format.h"
#include "report/line_text.h"

namespace rockyard::report {
namespace {

using statistics::ComparedValue;
using statistics::ComparisonResult;
using statistics::Interval;
using statistics::PublishedReference;
using statistics::PublishedValue;
using statistics::ValueRole;
using statistics::Verdict;

constexpr std::size_t kWidth = 100;
constexpr std::size_t kRemarkIndent = 6;

// What the columns show by marks and indents.
constexpr const char* kMarks =
    "c: conditional on error sizes that the publication states as inputs. k: the simulation was "
    "calibrated with these runs or their like. Indented: other readings, shown and not judged, "
    "among them sets of which as many runs arrived as of the published ones.";

char RoleMark(ValueRole role) {
  switch (role) {
    case ValueRole::kConditional:
      return 'c';
    case ValueRole::kCalibration:
      return 'k';
    case ValueRole::kPrediction:
      break;
  }
  return ' ';
}

std::string What(const PublishedValue& value) {
  const bool has_unit = !IsCount(value) && std::isfinite(value.value) && value.unit != "1";
  return has_unit ? fmt::format("{} [{}]", value.what, value.unit) : value.what;
}

// Words in lines of at most kWidth, each line indented.
std::string Wrap(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result;
  std::string line(indent, ' ');
  std::string word;
  while (words >> word) {
    const bool first = line.size() == indent;
    if (!first && line.size() + 1 + word.size() > kWidth) {
      result += line + "\n";
      line = std::string(indent, ' ') + word;
    } else {
      line += (first ? "" : " ") + word;
    }
  }
  return result + line + "\n";
}

std::string Line(char mark, const std::string& what, const std::string& published,
                 const std::string& predicted, const std::string& p, const std::string& holm,
                 const std::string& power, const std::string& verdict) {
  std::string line = fmt::format("{} {:<31.31} {:>9} {:>23} {:>6} {:>6} {:>5} {}", mark,
                                 Printable(what), published, predicted, p, holm, power, verdict);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string Details(const ComparedValue& value) {
  std::string text;
  for (const auto& side : value.beside) {
    text += Line(' ', "    " + side.name, "", Prediction(value, side), PValue(side.p_value), "", "",
                 "");
  }
  for (const std::string& remark : Remarks(value)) text += Wrap(remark, kRemarkIndent);
  return text;
}

std::string Row(const ComparedValue& value) {
  const PublishedValue& published = value.published;
  return Line(RoleMark(published.role), What(published), Published(published), Prediction(value),
              PValue(value.p_value), PValue(value.holm_p_value), Power(value.power),
              statistics::Name(value.verdict)) +
         Details(value);
}

// What a reader must not miss: it stands between the name of a scenario and its rows.
std::string Changed(const ComparisonResult& result, std::string_view scenario) {
  const statistics::OtherSettings* changed = result.FindChanged(scenario);
  if (changed == nullptr) return "";
  std::string text = Wrap(std::string(kNotPublishedCase) + ":", 2);
  for (const std::string& setting : changed->settings) text += Wrap(setting, 4);
  return text;
}

std::string Footnotes(const ComparisonResult& result) {
  std::vector<std::string> notes = ComparisonNotes(result);
  notes.insert(notes.begin() + 3, kMarks);
  std::string text;
  for (const std::string& note : notes) text += Wrap(note, 0);
  return text;
}

std::vector<std::string> Scenarios(const ComparisonResult& result) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const ComparedValue& value : result.values) {
    if (seen.insert(value.published.scenario).second) names.push_back(value.published.scenario);
  }
  return names;
}

// Arithmetic that agrees with a publication says nothing about the simulation.
std::string ComputedAmongThem(const ComparisonResult& result) {
  const auto computed =
      std::count_if(result.values.begin(), result.values.end(), [](const ComparedValue& value) {
        return value.published.statistic == statistics::StatisticKind::kComputed;
      });
  return computed == 0 ? "" : fmt::format("; {} of them computed, not simulated", computed);
}

}  // namespace

std::vector<std::string> ComparisonNotes(const ComparisonResult& result) {
  const statistics::ComparisonOptions& options = result.options;
  std::vector<std::string> notes{
      "published: successes of runs, or the printed number. predicted: median and 95 % interval "
      "for a new set of the published size, the simulation's own uncertainty included.",
      "p: two-sided, that the published and the simulated runs follow one law. Holm: adjusted for "
      "the family. power: chance to see a success rate 0.20 lower (other counts: 0.20 nearer to "
      "one half; other numbers: a shift by half a standard deviation, and where a number has a "
      "lower limit a change of scale as large, whichever is hardest to see) at the level that "
      "Holm grants.",
      "agrees: not rejected, and power 0.8 or more. holds: a bound or arithmetic that any "
      "simulation "
      "meets. differs: Holm at or below alpha; of counts, for runs on rock layouts that are "
      "independent. underpowered: not rejected, but too few published runs to tell. not judged: no "
      "number, or no simulated trials."};
  if (std::any_of(result.values.begin(), result.values.end(), [](const ComparedValue& value) {
        return statistics::HasTolerance(value.published.statistic);
      })) {
    notes.emplace_back(
        "Numbers with a tolerance: the simulated value and its interval, all such intervals "
        "together 95 % (Bonferroni). agrees: inside of the tolerance. differs: apart from it. "
        "underpowered: across an end of it. Computed numbers are points: they hold or differ.");
  }
  notes.push_back(
      fmt::format("{} p-values in Holm's family, alpha {}, {} samples for each, seed {}. A bound "
                  "is judged without a p-value.",
                  result.family, options.alpha, options.replicates, options.seed));
  return notes;
}

std::string ComparisonText(const PublishedReference& reference, const ComparisonResult& result) {
  std::string text = Printable(reference.title) + " against simulated trials\n\n";
  text += Line(' ', "number", "published", "predicted (95 %)", "p", "Holm", "power", "verdict");
  for (const std::string& scenario : Scenarios(result)) {
    text +=
        (scenario.empty() ? "computed" : Printable(scenario)) + "\n" + Changed(result, scenario);
    for (const ComparedValue& value : result.values) {
      if (value.published.scenario == scenario) text += Row(value);
    }
  }
  text += fmt::format("\n{} agree, {} hold, {} differ, {} underpowered, {} not judged{}\n\n",
                      CountOf(result, Verdict::kAgrees), CountOf(result, Verdict::kHolds),
                      CountOf(result, Verdict::kDiffers), CountOf(result, Verdict::kUnderpowered),
                      CountOf(result, Verdict::kNotJudged), ComputedAmongThem(result));
  for (const statistics::OtherSettings& changed : result.changed) {
    text += Wrap(fmt::format("{} is {}", changed.scenario, kNotPublishedCase), 0) + "\n";
  }
  return text + Footnotes(result);
}

}  // namespace rockyard::report
