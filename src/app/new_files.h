// What `rockyard new` writes: the templates (templates/) with a name in place of my_navigator, and
// MyNavigator where it names a class. Templates are part of the program (templates/embed.cmake). No
// record depends on them; what earlier programs have written must go on to work.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::app {

// A file that the program holds. What ends in ".in" is filled in, and loses the ending.
struct Template {
  std::string_view path;  // "plugin/my_navigator.cc.in": begins with the folder of its form
  std::string_view text;
};

// Returns all of them, sorted by path but for those that are copied as they are, which come last.
std::span<const Template> Templates();

// How a navigator gets into rockyard.
enum class NavigatorForm { kPlugin, kProcess };

// Throws core::UserError, with a name that can be taken, where a navigator cannot have this name:
// it is none, a group of a scenario has it already, or the folder would not build or run.
void CheckNavigatorName(const std::string& name, NavigatorForm form);

struct NewFile {
  std::string name;
  std::string text;
};

// Returns the files of a navigator's folder. `nominal` is the file that its scenario extends, as
// the scenario names it. Requires a name that CheckNavigatorName accepts.
std::vector<NewFile> NavigatorFiles(const std::string& name, NavigatorForm form,
                                    const std::string& nominal);

// Returns the commands that the README among the files tells to type, in the new folder.
std::vector<std::string> CommandsOf(std::span<const NewFile> files);

// Makes the folder, and those that it is in, with these files: whole or not at all. Throws
// core::UserError where it exists or cannot be made, core::MachineError and batch::StoreError where
// the machine fails.
void WriteNewFolder(const std::filesystem::path& folder, std::span<const NewFile> files);

}  // namespace rockyard::app
