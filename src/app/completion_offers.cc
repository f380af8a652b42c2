#include "app/completion_offers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "app/completion_lookup.h"

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

}  // namespace rockyard::app
