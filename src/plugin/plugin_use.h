// The plugins that a scenario names, and what they are known by. Scenarios read and write the list;
// fingerprints, stores and reports know a plugin by its hash.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "localization/estimator_set_params.h"
#include "navigation/navigator_set_params.h"
#include "perception/point_reader_set_params.h"

namespace rockyard::plugin {

class NavigatorSource;
class EstimatorSource;
class ReaderSource;

// One plugin of a scenario: a shared library, or the process of a navigator.
struct PluginUse {
  enum class Kind { kLibrary, kProcess };

  Kind kind = Kind::kLibrary;
  std::string text;    // the file's path, absolute; or the command, for /bin/sh
  std::string folder;  // absolute: in which the command runs; "" of a library
  // 16 hexadecimal digits (core::Hasher): over the library's bytes; or over the command, the bytes
  // of each word of it that is a file, and what the process says of itself.
  std::string hash;
  bool confined = false;  // of a process: it runs without network and cannot write files
  std::vector<std::shared_ptr<const NavigatorSource>> navigators;
  std::vector<std::shared_ptr<const EstimatorSource>> estimators = {};
  std::vector<std::shared_ptr<const ReaderSource>> readers = {};

  // Returns "libmine.so" or the command, for people.
  std::string Name() const;
};

// The member of a scenario that lists plugins.
inline constexpr const char* kPluginsKey = "plugins";

// Returns the list with absolute paths: those of files and commands are relative to `folder`. What
// is wrong with an entry is left for OpenPlugins.
core::JsonValue Anchored(core::JsonValue list, const std::filesystem::path& folder);

// Opens the plugins of a scenario's list: texts (files of libraries), {"library": FILE} and
// {"process": COMMAND}, each with "hash" and "folder" where it was written by ToJson. Relative
// paths and commands are taken from `folder`. Those that are in `opened` already are not asked
// again. Throws core::UserError with what is wrong: no such file, no plugin, another hash than the
// list says (both are named).
std::vector<PluginUse> OpenPlugins(const core::JsonValue& list, const std::filesystem::path& folder,
                                   const std::vector<PluginUse>& opened = {});

// The sets that plugins add to.
struct PluginSets {
  navigation::NavigatorSet& navigators;
  localization::EstimatorSet& estimators;
  perception::PointReaderSet& readers;
};

// Adds to the sets a stand-in for each navigator, estimator and reader that the document, a
// scenario, chooses or has a group of, and that they lack: its parameters are those that the group
// states, and it cannot drive. So the scenario of a stored run can be read, shown and compared
// without running anybody's code.
void AddStandIns(const core::JsonValue& document, PluginSets sets);

// Returns the list as a resolved scenario has it.
core::JsonValue ToJson(const std::vector<PluginUse>& plugins);

// Returns the schema of the list.
core::JsonValue SchemaOfPlugins();

// Returns the list without what no record depends on: paths and folders.
core::JsonValue IdentityOf(const core::JsonValue& list);

// Adds navigators, estimators and readers of the plugins to the sets, but for those that are in
// them. Throws core::UserError where a name is taken, also where a navigator and an estimator have
// own values of the same name, as columns of records bear it.
void AddKinds(const std::vector<PluginUse>& plugins, PluginSets sets);

}  // namespace rockyard::plugin
