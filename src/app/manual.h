// What the parser knows of a command, as a page to read: Markdown for docs/commands, roff for man.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace rockyard::app {

struct ManualOption {
  std::string names;  // "--trials", "-h, --help", "SCENARIO"
  std::string value;  // "INT, 1 to 4096", "uniform | adaptive"; empty for a switch
  std::string preset;
  std::string text;  // what it does, then what it needs and excludes
};

struct ManualExample {
  std::string line;  // as typed
  std::string what;  // it does
};

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

// Of a command and of those below it; `parent` is what stands before its name. Options that are
// kept from people (an empty group) are left out.
ManualPage ManualOf(const CLI::App& command, std::string_view parent = "");

// Ends with a line break. Commands below it are sections of the page; those of rockyard itself,
// which have pages of their own, are a list of links.
std::string AsMarkdown(const ManualPage& page);

// A page for section 1 of the manual (man(7)), without a date, so that equal programs give equal
// pages. `version` stands in its foot.
std::string AsMan(const ManualPage& page, std::string_view version);

}  // namespace rockyard::app
