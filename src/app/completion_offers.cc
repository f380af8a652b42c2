#include "app/completion_offers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/run_folders.h"
#include "app/scenario_names.h"
#include "core/field_table.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

// "wilson" and "clopper-pearson" of "TEXT:{wilson,clopper-pearson}", as the parser shows it; words
// that stand for numbers are shown as "word->number".
std::vector<std::string> WrittenChoices(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  auto words = CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
  for (std::string& word : words) word = word.substr(0, word.find("->"));
  return words;
}

// Of "worst:N" what can be offered.
std::vector<std::string> Choices(const std::string& type) {
  auto words = WrittenChoices(type);
  for (std::string& word : words) {
    if (word.find(':') != std::string::npos) word.resize(word.find(':') + 1);
  }
  return words;
}

Takes TakenBy(const CLI::Option& option) {
  if (option.get_expected_min() == 0 || option.get_items_expected_min() == 0) {
    return Takes::kNothing;
  }
  if (option.check_lname("set")) return Takes::kSetting;
  const std::string type = option.get_type_name();
  if (!Choices(type).empty()) return Takes::kWord;
  const bool number =
      type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
  return number ? Takes::kNumber : Takes::kText;
}

std::string FirstLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// The kinds that fit what a command takes by the name "SCENARIO_OR_RUN".
std::vector<std::string> LookupKinds(std::string_view positional) {
  std::vector<std::string> kinds;
  for (const auto& [part, kind] :
       {std::pair{"SCENARIO", "scenarios"}, std::pair{"SWEEP", "sweeps"},
        std::pair{"ROVER", "rovers"}, std::pair{"RUN", "runs"}, std::pair{"SHARD", "runs"}}) {
    if (positional.find(part) != std::string_view::npos) kinds.emplace_back(kind);
  }
  return kinds;
}

void AddOptions(const CLI::App& app, CommandOffer& offer) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // of scripts, not of people
    const Takes takes = TakenBy(*option);
    const std::vector<std::string> choices = Choices(option->get_type_name());
    if (option->get_positional()) {
      offer.words.insert(offer.words.end(), choices.begin(), choices.end());
      offer.takes_files = offer.takes_files || takes == Takes::kText;
      for (const std::string& kind : LookupKinds(option->get_name())) {
        offer.lookups.push_back(kind);
      }
      continue;
    }
    Offer each{{}, takes, choices, FirstLine(option->get_description())};
    for (const std::string& name : option->get_lnames()) each.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) each.names.push_back("-" + name);
    const auto known = std::find_if(offer.options.begin(), offer.options.end(),
                                    [&](const Offer& other) { return other.names == each.names; });
    if (known == offer.options.end()) offer.options.push_back(std::move(each));
  }
}

CommandOffer OfferOf(const CLI::App& command) {
  CommandOffer offer{command.get_name(), FirstLine(command.get_description()), {}, {}, {}, false};
  AddOptions(command, offer);
  for (const CLI::App* inner : command.get_subcommands({})) {
    offer.words.push_back(inner->get_name());
    AddOptions(*inner, offer);
  }
  return offer;
}

std::vector<std::string> ValuesOf(const core::ParameterInfo& parameter) {
  if (parameter.kind == core::FieldKind::kBoolean) return {"true", "false"};
  return parameter.choices;
}

std::vector<std::string> Settings(std::string_view typed) {
  const bool has_path = typed.find('=') != std::string_view::npos;
  std::vector<std::string> words;
  for (const core::ParameterInfo& parameter : scenario::ListParameters()) {
    const std::string path = parameter.path + "=";
    if (!has_path) {
      words.push_back(path);
    } else if (typed.starts_with(path)) {
      for (const std::string& value : ValuesOf(parameter)) words.push_back(path + value);
    }
  }
  return words;
}

std::vector<std::string> Runs() {
  std::vector<std::string> words;
  for (const std::filesystem::path& run : RunFolders("results/runs")) {
    words.push_back(run.generic_string());
  }
  return words;
}

// The shortest ones, or paths for somebody who types one.
std::vector<std::string> Names(Wanted wanted, std::string_view typed) {
  return typed.find('/') == std::string_view::npos ? ScenarioNames(wanted) : ScenarioPaths(wanted);
}

std::vector<std::string> WordsOf(std::string_view kind, std::string_view typed) {
  if (kind == "settings") return Settings(typed);
  if (kind == "scenarios") return Names(Wanted::kScenario, typed);
  if (kind == "sweeps") return Names(Wanted::kSweep, typed);
  if (kind == "rovers") return Names(Wanted::kRover, typed);
  return kind == "runs" ? Runs() : std::vector<std::string>();
}

}  // namespace

std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  return Choices(option.get_type_name());
}

std::vector<std::string> WrittenChoicesOf(const CLI::Option& option) {
  return WrittenChoices(option.get_type_name());
}

std::vector<CommandOffer> Offers(const CLI::App& app) {
  std::vector<CommandOffer> offers;
  for (const CLI::App* command : app.get_subcommands({})) offers.push_back(OfferOf(*command));
  return offers;
}

std::vector<std::string> LookUp(std::string_view asked) {
  const std::size_t colon = asked.find(':');
  if (colon == std::string_view::npos) return {};
  const std::string_view typed = asked.substr(colon + 1);
  std::vector<std::string> words = WordsOf(asked.substr(0, colon), typed);
  std::erase_if(words, [&](const std::string& word) { return !word.starts_with(typed); });
  return words;
}

}  // namespace rockyard::app
