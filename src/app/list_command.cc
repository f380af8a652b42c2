// The command `rockyard list`: the scenario and sweep files of a folder, each with what it is; or,
// with --ablations, the causes of failure that `run --ablate` and sweeps can take away.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "campaign/scenario_list.h"
#include "campaign/scenario_names.h"
#include "core/json_text.h"
#include "core/json_value.h"
#include "report/line_text.h"
#include "scenario/ablations.h"

namespace rockyard::app {
namespace {

using core::JsonValue;

constexpr std::size_t kMinWidth = 40;

struct ListOptions {
  std::string folder;  // empty: campaign::ScenarioFolder()
  bool all = false;
  bool ablations = false;
  bool json = false;
};

std::string Bold(const std::string& text) {
  return StyleFor(stdout) == report::TextStyle::kColour ? fmt::format("\x1b[1m{}\x1b[0m", text)
                                                        : text;
}

std::size_t LineWidth() {
  return std::max(static_cast<std::size_t>(std::max(TerminalWidth(stdout), 0)), kMinWidth);
}

// Prints the name of a subfolder on a line of its own, and below it its files, each with what it
// is. On a terminal lines are cut to its width.
void PrintGroup(const std::string& folder, std::span<const campaign::ListedFile> files) {
  std::size_t widest = 0;
  for (const campaign::ListedFile& file : files) {
    widest = std::max(widest, report::Columns(report::Printable(file.name_in_group())));
  }
  const std::filesystem::path path = std::filesystem::path(folder) / files.front().group;
  Print(Bold(report::Printable(path.lexically_normal().generic_string())) + "\n");
  for (const campaign::ListedFile& file : files) {
    const std::string line = fmt::format("  {:<{}}  {}", report::Printable(file.name_in_group()),
                                         widest, report::Printable(file.About()));
    Print((IsTerminal(stdout) ? report::Cut(line, LineWidth()) : line) + "\n");
  }
}

// Files of one group must stand next to each other, as ListScenarios sorts them.
void PrintEntries(const std::string& folder, const std::vector<campaign::ListedFile>& files,
                  bool all) {
  std::vector<campaign::ListedFile> shown;
  std::copy_if(files.begin(), files.end(), std::back_inserter(shown),
               [&](const campaign::ListedFile& file) { return campaign::IsShown(file, all); });
  for (auto begin = shown.begin(); begin != shown.end();) {
    const auto end = std::find_if(begin, shown.end(), [&](const campaign::ListedFile& file) {
      return file.group != begin->group;
    });
    PrintGroup(folder, {begin, end});
    begin = end;
  }
  if (shown.size() < files.size()) {
    Print(fmt::format("{} parts of scenarios, which these extend, are left out: --all\n",
                      files.size() - shown.size()));
  }
}

void PrintEntriesAsJson(const std::string& folder, const std::vector<campaign::ListedFile>& files,
                        bool all) {
  JsonValue::List entries;
  for (const campaign::ListedFile& file : files) {
    if (campaign::IsShown(file, all)) entries.push_back(Json(file));
  }
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("folder", JsonValue(folder));
  json.Set("files", JsonValue(std::move(entries)));
  PrintJson(core::DumpJson(json));
}

void ListAblations() {
  for (const scenario::Ablation& ablation : scenario::Ablations()) {
    Print(fmt::format("{}: {}\n", ablation.name, ablation.sentence));
    for (const std::string_view setting : ablation.settings) {
      Print(fmt::format("    {}\n", setting));
    }
  }
}

void ListAblationsAsJson() {
  JsonValue::List entries;
  for (const scenario::Ablation& ablation : scenario::Ablations()) {
    JsonValue::List settings;
    for (const std::string_view setting : ablation.settings) {
      settings.emplace_back(std::string(setting));
    }
    JsonValue entry = JsonValue::Object();
    entry.Set("name", JsonValue(std::string(ablation.name)));
    entry.Set("description", JsonValue(std::string(ablation.sentence)));
    entry.Set("settings", JsonValue(std::move(settings)));
    entries.push_back(std::move(entry));
  }
  JsonValue json = JsonValue::Object();
  json.Set("schema_version", JsonValue(std::int64_t{1}));
  json.Set("ablations", JsonValue(std::move(entries)));
  PrintJson(core::DumpJson(json));
}

void List(const ListOptions& options) {
  if (options.ablations) return options.json ? ListAblationsAsJson() : ListAblations();
  const std::string folder =
      options.folder.empty() ? campaign::ScenarioFolder().string() : options.folder;
  const std::vector<campaign::ListedFile> files = campaign::ListScenarios(folder);
  if (options.json) {
    PrintEntriesAsJson(folder, files, options.all);
  } else {
    PrintEntries(folder, files, options.all);
  }
}

}  // namespace

void AddListCommand(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "Lists scenarios and sweeps with a line each");
  command->add_option("FOLDER", options->folder,
                      "where to look (default: $ROCKYARD_SCENARIOS, else ./scenarios, else those "
                      "of the installation or of the source tree)");
  command->add_flag("--all", options->all, "list parts of scenarios, such as rovers, too");
  command->add_flag("--ablations", options->ablations,
                    "list what `rockyard run --ablate` and sweeps can take away, with settings");
  command->add_flag("--json", options->json, "for programs");
  command->callback([options] { List(*options); });
}

}  // namespace rockyard::app
