// Pages of commands as Markdown (AsMarkdown), for docs/commands.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/manual.h"

namespace rockyard::app {
namespace {

std::string Capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// Returns text for a cell of a table, which '|' would end and in which '<' would begin markup.
std::string Cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|')
      cell += "\\|";
    else if (c == '<')
      cell += "&lt;";
    else
      cell += c;
  }
  return cell;
}

std::string Code(const std::string& text) { return text.empty() ? "" : fmt::format("`{}`", text); }

// Returns `code` for a cell: there '|' would still end the cell, but '<' stands for itself.
std::string CodeCell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
    text.replace(at, 1, "\\|");
  }
  return Code(text);
}

std::string Table(const std::vector<ManualOption>& options, const char* head) {
  if (options.empty()) return "";
  std::string table =
      fmt::format("\n| {} | value | default | what it does |\n|---|---|---|---|\n", head);
  for (const ManualOption& option : options) {
    table += fmt::format("| {} | {} | {} | {} |\n", CodeCell(option.names), CodeCell(option.value),
                         CodeCell(option.preset), Cell(option.text));
  }
  return table;
}

std::string ExampleList(const ManualPage& page) {
  if (page.examples.empty()) return "";
  std::string text = "\nExamples:\n\n";
  for (const ManualExample& example : page.examples) {
    text += fmt::format("- `{}`: {}\n", example.line, example.what);
  }
  return text;
}

// Returns "run" of "rockyard run".
std::string LastWord(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::string Links(const ManualPage& page) {
  std::string text = "\n| command | what it does |\n|---|---|\n";
  for (const ManualPage& command : page.commands) {
    const std::string word = LastWord(command.name);
    text += fmt::format("| [{0}]({0}.md) | {1} |\n", word, Cell(command.summary));
  }
  return text;
}

std::string Body(const ManualPage& page) {
  return fmt::format("{}.\n\n```\n{}\n```\n{}{}", Capital(page.summary), page.usage,
                     Table(page.arguments, "argument"), Table(page.options, "option"));
}

}  // namespace

std::string AsMarkdown(const ManualPage& page) {
  const bool whole = page.name.find(' ') == std::string::npos;  // rockyard itself
  std::string text = fmt::format("# {}\n\n{}", page.name, Body(page));
  if (whole) text += Links(page);
  for (const ManualPage& command : page.commands) {
    if (!whole) text += fmt::format("\n## {}\n\n{}", command.name, Body(command));
  }
  text += ExampleList(page);
  for (const std::string& note : page.notes) text += fmt::format("\n{}\n", note);
  return text;
}

}  // namespace rockyard::app
