// rockyard completion
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/completion_script.h"
#include "app/console.h"

namespace rockyard::app {

void AddCompletionCommand(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Prints what lets a shell complete rockyard's commands");
  command->add_option("SHELL", *shell, "bash, zsh or fish")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->required();
  // The parser holds this callback, so it is there when the callback runs.
  command->callback([shell, &app] {
    const Shell known = *shell == "bash"  ? Shell::kBash
                        : *shell == "zsh" ? Shell::kZsh
                                          : Shell::kFish;
    PrintExact(CompletionScript(app, known));
  });
}

}  // namespace rockyard::app
