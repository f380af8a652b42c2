// Pages of commands for man(1), in the macros of man(7) (AsMan).
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/manual.h"

namespace rockyard::app {
namespace {

// Returns text that roff shows as it stands: '-' would become a hyphen, '\' begins an escape, and a
// line that begins with '.' or '\'' is a request.
std::string Plain(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (plain.empty() && (c == '.' || c == '\'')) plain += "\\&";
    if (c == '\\')
      plain += "\\e";
    else if (c == '-')
      plain += "\\-";
    else
      plain += c;
  }
  return plain;
}

std::string Upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c == ' ' ? '-' : std::toupper(c));
  });
  return text;
}

std::string Hyphened(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string Tagged(const std::vector<ManualOption>& options) {
  std::string text;
  for (const ManualOption& option : options) {
    text += fmt::format(".TP\n\\fB{}\\fR", Plain(option.names));
    if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", Plain(option.value));
    text += "\n" + Plain(option.text);
    if (!option.preset.empty()) text += fmt::format(" (default: {})", Plain(option.preset));
    text += "\n";
  }
  return text;
}

std::string Section(const char* name, const std::string& body) {
  return body.empty() ? "" : fmt::format(".SH {}\n{}", name, body);
}

// Returns each example as a command in bold and what it does.
std::string RoffExamples(const ManualPage& page) {
  std::string text;
  for (const ManualExample& example : page.examples) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", Plain(example.line), Plain(example.what));
  }
  return text;
}

std::string RoffNotes(const ManualPage& page) {
  std::string text;
  for (const std::string& note : page.notes) text += fmt::format(".PP\n{}\n", Plain(note));
  return text;
}

std::string RoffCommands(const ManualPage& page) {
  std::string text;
  for (const ManualPage& command : page.commands) {
    text += fmt::format(".SS {}\n{}\n", Plain(command.usage), Plain(command.summary));
    if (page.name.find(' ') == std::string::npos) continue;  // they have pages of their own
    text += Tagged(command.arguments) + Tagged(command.options);
  }
  return text;
}

std::string SeeAlso(const ManualPage& page) {
  if (page.name.find(' ') != std::string::npos) return "\\fBrockyard\\fR(1)\n";
  std::string text;
  for (const ManualPage& command : page.commands) {
    text +=
        fmt::format("{}\\fB{}\\fR(1)", text.empty() ? "" : ",\n", Plain(Hyphened(command.name)));
  }
  return text + "\n";
}

}  // namespace

std::string AsMan(const ManualPage& page, std::string_view version) {
  return fmt::format(
      ".TH {} 1 \"\" \"{}\" \"User commands\"\n"
      ".SH NAME\n{} \\- {}\n"
      ".SH SYNOPSIS\n\\fB{}\\fR\n{}{}{}{}{}{}",
      Upper(page.name), Plain(version), Plain(Hyphened(page.name)), Plain(page.summary),
      Plain(page.usage), Section("ARGUMENTS", Tagged(page.arguments)),
      Section("OPTIONS", Tagged(page.options)), Section("COMMANDS", RoffCommands(page)),
      Section("EXAMPLES", RoffExamples(page)), Section("NOTES", RoffNotes(page)),
      Section("SEE ALSO", SeeAlso(page)));
}

}  // namespace rockyard::app
