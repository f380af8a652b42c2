// What the parser knows of a command, as a page to read: Markdown for docs/commands, roff for man.
// `rockyard help` writes the pages; a test compares docs/commands with them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace rockyard::app {

// An option or an argument.
struct ManualOption {
  std::string names;  // "--trials", "-h, --help", "SCENARIO"
  std::string value;  // "INT, 1 to 4096", "uniform | adaptive"; empty for a switch
  std::string preset;
  std::string text;  // what it does, then what it needs and excludes
};

struct ManualExample {
  std::string line;  // as typed
  std::string what;  // what it does
};

// The page of a command, with the commands below it.
struct ManualPage {
  std::string name;  // "rockyard run", "rockyard plan claim"
  std::string summary;
  std::string usage;
  std::vector<ManualOption> arguments;
  std::vector<ManualOption> options;
  std::vector<ManualExample> examples;
  std::vector<std::string> notes;  // paragraphs below the options of --help, the examples apart
  std::vector<ManualPage> commands;
};

// Returns the page of a command. `parent` is what stands before its name: "rockyard". Options
// without a group, which only scripts use, are left out.
ManualPage ManualOf(const CLI::App& command, std::string_view parent = "");

// Returns what writes --help: it says of an option what its page says.
std::shared_ptr<CLI::FormatterBase> HelpFormatter();

// Returns the page as Markdown, ending in a line break. Commands below it are sections; on the page
// of rockyard itself they are links to their own pages.
std::string AsMarkdown(const ManualPage& page);

// Returns the page in the macros of man(7), for section 1. It has no date, so that equal programs
// give equal pages. `version` stands in its foot.
std::string AsMan(const ManualPage& page, std::string_view version);

}  // namespace rockyard::app
