#include "app/new_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "core/error.h"
#include "core/field_table.h"
#include "core/files.h"
#include "core/json_text.h"
#include "report/atomic_file.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestNavigatorName = 40;

// Targets that CMake has by itself in every project (policy CMP0037).
constexpr std::string_view kTargetsOfCMake =
    " all clean edit_cache help install preinstall rebuild_cache ";

// Modules of Python (sys.stdlib_module_names of 3.8 to 3.13) and of the client: a file of the same
// name beside the program would be taken for one of them, by the client or by NumPy. The last three
// are no names of a class.
constexpr std::string_view kModulesOfPython =
    " abc aifc antigravity argparse array ast asynchat asyncio asyncore atexit audioop base64 bdb "
    "binascii binhex bisect builtins bz2 calendar cgi cgitb chunk cmath cmd code codecs codeop "
    "collections colorsys compileall concurrent configparser contextlib contextvars copy copyreg "
    "crypt csv ctypes curses dataclasses datetime dbm decimal difflib dis distutils doctest email "
    "encodings ensurepip enum errno faulthandler fcntl filecmp fileinput fnmatch formatter "
    "fractions ftplib functools gc genericpath getopt getpass gettext glob graphlib grp gzip "
    "hashlib heapq hmac html http idlelib imaplib imghdr imp importlib inspect io ipaddress "
    "itertools json keyword lib2to3 linecache locale logging lzma mailbox mailcap marshal math "
    "mimetypes mmap modulefinder msilib msvcrt multiprocessing netrc nis nntplib nt ntpath "
    "nturl2path numbers opcode operator optparse os ossaudiodev parser pathlib pdb pickle "
    "pickletools pipes pkgutil platform plistlib poplib posix posixpath pprint profile pstats pty "
    "pwd py_compile pyclbr pydoc pydoc_data pyexpat queue quopri random re readline reprlib "
    "resource rlcompleter runpy sched secrets select selectors shelve shlex shutil signal site "
    "smtpd smtplib sndhdr socket socketserver spwd sqlite3 sre_compile sre_constants sre_parse ssl "
    "stat statistics string stringprep struct subprocess sunau symbol symtable sys sysconfig "
    "syslog tabnanny tarfile telnetlib tempfile termios textwrap this threading time timeit "
    "tkinter token tokenize tomllib trace traceback tracemalloc tty turtle turtledemo types typing "
    "unicodedata unittest urllib uu uuid venv warnings wave weakref webbrowser winreg winsound "
    "wsgiref xdrlib xml xmlrpc zipapp zipfile zipimport zlib zoneinfo "
    "numpy rockyard_navigator none true false ";

bool IsAmong(std::string_view words, const std::string& word) {
  return words.find(" " + word + " ") != std::string_view::npos;
}

bool IsLowerLetter(char c) { return c >= 'a' && c <= 'z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsNavigatorName(std::string_view name) {
  return !name.empty() && IsLowerLetter(name.front()) && std::ranges::all_of(name, [](char c) {
    return IsLowerLetter(c) || IsDigit(c) || c == '_';
  });
}

// Returns what has the name in the group "navigation" of scenarios; nothing where it is free.
std::string_view TakenInScenarios(const std::string& name) {
  const std::string path = "navigation." + name;
  for (const core::ParameterInfo& parameter : scenario::ListParameters()) {
    if (parameter.path == "navigation.navigator" &&
        std::ranges::count(parameter.choices, name) > 0) {
      return "is a navigator of rockyard";
    }
    if (parameter.path == path || parameter.path.starts_with(path + ".")) {
      return "is a setting of the group navigation";
    }
  }
  return name == "extends" ? "is a key of every group of a scenario" : "";
}

// Returns what is wrong with the name; empty where nothing is.
std::string_view NavigatorNameProblem(const std::string& name, NavigatorForm form) {
  if (!IsNavigatorName(name)) return "is no name of a navigator";
  if (name.size() > kLongestNavigatorName) return "is too long";
  const std::string_view taken = TakenInScenarios(name);
  if (!taken.empty()) return taken;
  if (form == NavigatorForm::kPlugin) {
    return IsAmong(kTargetsOfCMake, name) ? "is a target that CMake has by itself" : "";
  }
  return IsAmong(kModulesOfPython, name) ? "is a name that Python or the client uses" : "";
}

// Returns the name that is most like what was typed, a path or words in capitals, say; it can
// still be taken.
std::string WellFormed(std::string_view typed) {
  while (typed.ends_with('/')) typed.remove_suffix(1);
  typed.remove_prefix(typed.rfind('/') + 1);  // npos + 1 is 0
  std::string name;
  for (const char c : typed) {
    const bool upper = c >= 'A' && c <= 'Z';
    const char lower = upper ? static_cast<char>(c - 'A' + 'a') : c;
    const bool word = IsLowerLetter(lower) || IsDigit(lower);
    const bool begins = upper && !name.empty() && IsLowerLetter(name.back());
    if ((begins || !word) && !name.empty() && name.back() != '_') name += '_';
    if (IsLowerLetter(lower) || (word && !name.empty())) name += lower;
  }
  name.resize(std::min(name.size(), kLongestNavigatorName - std::string_view("my_").size()));
  while (name.ends_with('_')) name.pop_back();
  return name.empty() ? "mine" : name;
}

// Returns "WallFollower2" of "wall_follower_2".
std::string ClassName(std::string_view name) {
  std::string text;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') text += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '_';
  }
  return text;
}

std::string Replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string replaced;
  for (std::size_t at = text.find(from); at != std::string_view::npos; at = text.find(from)) {
    replaced += text.substr(0, at);
    replaced += to;
    text.remove_prefix(at + from.size());
  }
  return replaced + std::string(text);
}

}  // namespace

void CheckNavigatorName(const std::string& name, NavigatorForm form) {
  const std::string_view problem = NavigatorNameProblem(name, form);
  if (problem.empty()) return;
  std::string better = WellFormed(name);
  if (!NavigatorNameProblem(better, form).empty()) better = "my_" + better;
  const std::string_view rule = IsNavigatorName(name)
                                    ? "another name"
                                    : "lower-case letters, digits and underscores, a letter first";
  throw core::UserError("NAME", fmt::format("\"{}\" {}", name, problem),
                        fmt::format("use {}, such as {}", rule, better));
}

std::vector<NewFile> NavigatorFiles(const std::string& name, NavigatorForm form,
                                    const std::string& nominal) {
  constexpr std::string_view kFilledIn = ".in";
  const std::string_view folder = form == NavigatorForm::kPlugin ? "plugin/" : "process/";
  // The file that is extended comes last: its path may hold anything.
  const std::array<std::pair<std::string_view, std::string>, 3> places{
      {{"MyNavigator", ClassName(name)},
       {"my_navigator", name},
       {"\"pathfinder/nominal.json\"", core::QuoteJson(nominal)}}};
  std::vector<NewFile> files;
  for (const Template& each : Templates()) {
    if (!each.path.starts_with(folder)) continue;
    NewFile file{std::string(each.path.substr(folder.size())), std::string(each.text)};
    if (file.name.ends_with(kFilledIn)) {
      file.name.resize(file.name.size() - kFilledIn.size());
      file.name = Replaced(file.name, "my_navigator", name);
      for (const auto& [from, to] : places) file.text = Replaced(file.text, from, to);
    }
    files.push_back(std::move(file));
  }
  return files;
}

std::vector<std::string> CommandsOf(std::span<const NewFile> files) {
  const auto readme = std::ranges::find(files, "README.md", &NewFile::name);
  std::vector<std::string> commands;
  if (readme == files.end()) return commands;
  std::istringstream lines(readme->text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
    } else if (inside) {
      commands.push_back(line);
    }
  }
  return commands;
}

void WriteNewFolder(const fs::path& folder, std::span<const NewFile> files) {
  const batch::EmptyFolders parents(batch::MakeFolders(folder.parent_path()));
  core::RemoveLeftovers(folder);
  try {
    core::TemporaryFolder whole(folder);
    for (const NewFile& file : files) {
      report::WriteFileAtomically(whole.path() / file.name, file.text);
    }
    whole.Commit();
  } catch (const std::system_error& error) {
    core::FailOnDisk(folder, "cannot be made", error.code());
  }
}

}  // namespace rockyard::app
