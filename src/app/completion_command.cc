// rockyard completion
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/completion_offers.h"
#include "app/completion_script.h"
#include "app/console.h"

namespace rockyard::app {
namespace {

void PrintOffers(const std::string& asked) {
  std::string text;
  for (const std::string& word : LookUp(asked)) text += word + "\n";
  PrintExact(text);
}

}  // namespace

void AddCompletionCommand(CLI::App& app) {
  auto asked = std::make_shared<std::string>();
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Prints what lets a shell complete rockyard's commands");
  CLI::Option* named = command->add_option("SHELL", *shell, "bash, zsh or fish")
                           ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  // What the scripts ask for while somebody types.
  CLI::Option* offer =
      command->add_option("--offer", *asked, "KIND:TYPED: words to offer")->group("");
  // The parser holds this callback, so it is there when the callback runs.
  command->callback([shell, asked, named, offer, &app] {
    if (*offer) return PrintOffers(*asked);
    if (!*named) throw CLI::RequiredError("SHELL");
    const Shell known = *shell == "bash"  ? Shell::kBash
                        : *shell == "zsh" ? Shell::kZsh
                                          : Shell::kFish;
    PrintExact(CompletionScript(app, known));
  });
}

}  // namespace rockyard::app
