#include "app/set_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "campaign/plugin_settings.h"

namespace rockyard::app {
namespace {

// The settings that stand for plugins, at the front of all.
struct PluginOptions {
  campaign::GivenPlugins given;
  std::size_t settings = 0;  // of them that stand there already

  void Set(std::vector<std::string>& overrides) {
    const auto begin = overrides.begin();
    overrides.erase(begin, begin + static_cast<std::ptrdiff_t>(settings));
    const std::vector<std::string> made = campaign::SettingsOf(given);
    settings = made.size();
    overrides.insert(overrides.begin(), made.begin(), made.end());
  }
};

}  // namespace

void AddSetOptions(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  // The parser calls these two after it has filled what --set gives, as they are added later.
  auto plugins = std::make_shared<PluginOptions>();
  const auto add = [&](const char* name, std::vector<std::string> campaign::GivenPlugins::*member,
                       const char* description) {
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [plugins, member, &overrides](const std::vector<std::string>& values) {
              plugins->given.*member = values;
              plugins->Set(overrides);
            },
            description)
        ->allow_extra_args(false);
  };
  add("--plugin", &campaign::GivenPlugins::libraries,
      "FILE: shared library with navigators, of which the first one drives unless --set says "
      "otherwise, or with an estimator or a reader of images; repeat");
  add("--navigator-process", &campaign::GivenPlugins::processes,
      "CMD: command of a navigator in a process of its own, which drives; repeat");
}

}  // namespace rockyard::app
