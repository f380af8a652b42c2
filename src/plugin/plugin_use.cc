#include "plugin/plugin_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "plugin/foreign_estimator.h"
#include "plugin/foreign_navigator.h"
#include "plugin/foreign_reader.h"
#include "plugin/library.h"
#include "plugin/process.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using core::UserError;
using Kind = PluginUse::Kind;

constexpr std::size_t kMostPlugins = 16;

// Returns the words of a command, as far as blanks and quotes part them.
std::vector<std::string> WordsOf(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  for (const char c : command) {
    if (quote != 0 ? c == quote : c == '"' || c == '\'') {
      quote = quote != 0 ? '\0' : c;
    } else if (quote == 0 && (c == ' ' || c == '\t')) {
      if (!word.empty()) words.push_back(std::exchange(word, {}));
    } else {
      word += c;
    }
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

std::string HashOfProcess(const PluginUse& use) {
  core::Hasher hasher;
  hasher.Text(use.text);
  for (const std::string& word : WordsOf(use.text)) {
    const fs::path file = fs::path(use.folder) / word;  // an absolute word stays itself
    std::error_code error;
    if (fs::is_regular_file(file, error)) AddFile(file, hasher);
  }
  for (const auto& navigator : use.navigators) {
    hasher.Text(navigator->description().name).Text(navigator->description().version);
  }
  return core::Hex(hasher.value());
}

// One entry of the list as it is written.
struct Entry {
  Kind kind = Kind::kLibrary;
  std::string text;
  std::string folder;  // "" where the entry has none
  std::string hash;    // "" where the entry has none
};

std::string TextIn(const JsonValue& object, std::string_view key, const std::string& path) {
  const JsonValue* member = object.Find(key);
  if (member == nullptr) return {};
  if (!member->Is(JsonValue::Type::kText) || member->text().empty()) {
    throw UserError(fmt::format("{}.{}", path, key), "is no text", "write a text");
  }
  return member->text();
}

Entry ReadEntry(const JsonValue& value, const std::string& path) {
  if (value.Is(JsonValue::Type::kText)) return {Kind::kLibrary, value.text(), {}, {}};
  if (!value.Is(JsonValue::Type::kObject)) {
    throw UserError(path, "is neither a text nor an object",
                    R"(write {"library": "libmine.so"} or {"process": "python3 mine.py"})");
  }
  constexpr std::array<std::string_view, 5> kKeys{"library", "process", "folder", "hash",
                                                  "confined"};
  for (const core::JsonMember& member : value.members()) {
    if (std::find(kKeys.begin(), kKeys.end(), member.key) == kKeys.end()) {
      throw UserError(fmt::format("{}.{}", path, member.key), "is not a known key",
                      core::Suggest(member.key, kKeys));
    }
  }
  const std::string library = TextIn(value, "library", path);
  const std::string process = TextIn(value, "process", path);
  if (library.empty() == process.empty()) {
    throw UserError(path, library.empty() ? "names no plugin" : "names a library and a process",
                    R"(write {"library": "libmine.so"} or {"process": "python3 mine.py"})");
  }
  return {library.empty() ? Kind::kProcess : Kind::kLibrary, library.empty() ? process : library,
          TextIn(value, "folder", path), TextIn(value, "hash", path)};
}

PluginUse OpenOne(const Entry& entry, const fs::path& folder, const std::string& path) {
  PluginUse use{.kind = entry.kind, .text = entry.text, .folder = {}, .hash = {}, .navigators = {}};
  const fs::path base = fs::absolute(folder).lexically_normal();
  if (use.kind == Kind::kLibrary) {
    const fs::path file = (base / entry.text).lexically_normal();
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      throw UserError(fmt::format("{}.library", path),
                      fmt::format("names {}, which is no file", file.string()),
                      "build the plugin, or give its place with --plugin FILE");
    }
    use.text = file.string();
    use.hash = HashOfLibrary(file);
  } else {
    use.folder = entry.folder.empty() ? base.string() : entry.folder;
    std::error_code error;
    if (!fs::is_directory(use.folder, error)) {
      throw UserError(fmt::format("{}.folder", path),
                      fmt::format("names {}, which is no folder", use.folder),
                      "give the command again with --navigator-process CMD");
    }
  }
  const auto changed = [&] {
    throw UserError(path,
                    fmt::format("is another one than before: {} has the hash {} now, and had {}",
                                use.Name(), use.hash, entry.hash),
                    "go on with the former one, or begin a run of its own");
  };
  if (use.kind == Kind::kLibrary && !entry.hash.empty() && entry.hash != use.hash) changed();
  if (use.kind == Kind::kLibrary) {
    OpenedLibrary opened = OpenLibrary(use.text, use.hash);
    use.navigators = std::move(opened.navigators);
    use.estimators = std::move(opened.estimators);
    use.readers = std::move(opened.readers);
  } else {
    OpenedProcess opened = OpenProcess(use.text, use.folder);
    use.navigators.push_back(std::move(opened.source));
    use.confined = opened.confined;
    use.hash = HashOfProcess(use);
    if (!entry.hash.empty() && entry.hash != use.hash) changed();
  }
  return use;
}

}  // namespace

std::string PluginUse::Name() const {
  return kind == Kind::kLibrary ? fs::path(text).filename().string() : text;
}

JsonValue Anchored(JsonValue list, const fs::path& folder) {
  if (!list.Is(JsonValue::Type::kList)) return list;
  const fs::path base = fs::absolute(folder.empty() ? fs::path(".") : folder);
  const auto anchored = [&](const std::string& path) {
    return JsonValue((base / path).lexically_normal().string());
  };
  for (JsonValue& entry : list.list()) {
    if (entry.Is(JsonValue::Type::kText)) {
      entry = JsonValue::Object({{"library", anchored(entry.text())}});
      continue;
    }
    JsonValue* library = entry.Find("library");
    if (library != nullptr && library->Is(JsonValue::Type::kText)) {
      *library = anchored(library->text());
    }
    if (entry.Find("process") != nullptr && entry.Find("folder") == nullptr) {
      entry.Set("folder", JsonValue(base.lexically_normal().string()));
    }
  }
  return list;
}

JsonValue SchemaOfPlugins() {
  const auto text = [](const char* description) {
    return JsonValue::Object(
        {{"description", JsonValue(description)}, {"type", JsonValue("string")}});
  };
  JsonValue entry = JsonValue::Object(
      {{"type", core::ListOf(std::array{"string", "object"})},
       {"properties",
        JsonValue::Object({{"library", text("shared library of a plugin, relative to this file")},
                           {"process", text("command of a navigator's process")},
                           {"folder", text("in which the command runs: that of this file")},
                           {"hash", text("of what the scenario was resolved with")},
                           {"confined", JsonValue::Object({{"type", JsonValue("boolean")}})}})},
       {"additionalProperties", JsonValue(false)}});
  return JsonValue::Object(
      {{"description",
        JsonValue("navigators, estimators and readers of images that are no part of the program "
                  "(docs/navigators.md)")},
       {"type", JsonValue("array")},
       {"items", std::move(entry)}});
}

std::vector<PluginUse> OpenPlugins(const JsonValue& list, const fs::path& folder,
                                   const std::vector<PluginUse>& opened) {
  if (!list.Is(JsonValue::Type::kList)) {
    throw UserError(kPluginsKey, "is no list", R"(write [{"library": "libmine.so"}])");
  }
  if (list.list().size() > kMostPlugins) {
    throw UserError(kPluginsKey, fmt::format("has {} entries", list.list().size()),
                    fmt::format("use at most {}", kMostPlugins));
  }
  std::vector<PluginUse> plugins;
  for (std::size_t i = 0; i < list.list().size(); ++i) {
    const std::string path = fmt::format("{}[{}]", kPluginsKey, i);
    const Entry entry = ReadEntry(list.list()[i], path);
    const auto known = std::find_if(opened.begin(), opened.end(), [&](const PluginUse& use) {
      return use.kind == entry.kind && use.text == entry.text &&
             (entry.folder.empty() || use.folder == entry.folder) &&
             (entry.hash.empty() || use.hash == entry.hash);
    });
    plugins.push_back(known != opened.end() ? *known : OpenOne(entry, folder, path));
  }
  return plugins;
}

namespace {

// Returns the parameters of a group as a plugin would declare them.
JsonValue DeclaredBy(const JsonValue& group) {
  JsonValue::List fields;
  for (const core::JsonMember& member : group.members()) {
    using Type = JsonValue::Type;
    const JsonValue& value = member.value;
    JsonValue field = JsonValue::Object({{"name", JsonValue(member.key)}});
    if (value.Is(Type::kObject)) {
      field.Set("type", JsonValue("group"));
      field.Set("parameters", DeclaredBy(value));
    } else {
      const auto whole = [](const JsonValue& each) { return each.Is(Type::kInteger); };
      const char* type = "text";
      if (value.IsNumber()) type = whole(value) ? "integer" : "real";
      if (value.Is(Type::kBoolean)) type = "boolean";
      if (value.Is(Type::kList))
        type = std::ranges::all_of(value.list(), whole) ? "integers" : "reals";
      field.Set("type", JsonValue(type));
      field.Set("default", value);
    }
    fields.push_back(std::move(field));
  }
  return JsonValue(std::move(fields));
}

[[noreturn]] void RefuseToDrive() {
  throw UserError(kPluginsKey, "are not opened, as nothing is to be driven", "");
}

// Stand for a navigator, an estimator and a reader that are not opened.
class StandIn final : public NavigatorSource {
 public:
  using NavigatorSource::NavigatorSource;

  std::unique_ptr<navigation::Navigator> Make(const Parameters&,
                                              const navigation::NavigatorSetup&) const override {
    RefuseToDrive();
  }

 protected:
  JsonValue AskTraits(const Parameters&) const override {
    return JsonValue::Object(
        {{"reads", JsonValue("hazards")},
         {"goal_tolerance", JsonValue::Object({{"value_m", JsonValue(0.0)}})}});
  }
};

template <typename Source, typename Thing, typename Setup>
class CheckedStandIn final : public Source {
 public:
  using Source::Source;

  std::unique_ptr<Thing> Make(const Parameters&, const Setup&) const override { RefuseToDrive(); }

 protected:
  JsonValue AskProblems(const Parameters&) const override { return JsonValue::Object(); }
};
using EstimatorStandIn =
    CheckedStandIn<EstimatorSource, localization::Estimator, localization::EstimatorSetup>;
using ReaderStandIn =
    CheckedStandIn<ReaderSource, perception::PointReader, perception::PointReaderSetup>;

// Adds stand-ins to one set; `group` is that of the set in a scenario, `key` the choice in it.
template <typename Kind, typename Source, typename Set>
void AddStandInsTo(Set& set, const JsonValue* group, std::string_view key) {
  if (group == nullptr || !group->Is(JsonValue::Type::kObject)) return;
  const auto add = [&](const std::string& name, const JsonValue& parameters) {
    if (std::ranges::count(set.names(), name) > 0) return;
    JsonValue description = JsonValue::Object({{"name", JsonValue(name)}});
    description.Set("parameters", DeclaredBy(parameters));
    // An estimator that drove took what aids brought.
    description.Set("takes_fixes", JsonValue(true));
    description.Set("takes_motions", JsonValue(true));
    try {
      set.Add(std::make_unique<Kind>(std::make_shared<Source>(
          "what is not opened", ReadDescription(description, "a stored scenario"))));
    } catch (const UserError&) {
      // A key of the group that is no kind: whoever reads the scenario judges it.
    }
  };
  for (const core::JsonMember& member : group->members()) {
    if (member.value.Is(JsonValue::Type::kObject)) add(member.key, member.value);
  }
  const JsonValue* chosen = group->Find(key);
  if (chosen != nullptr && chosen->Is(JsonValue::Type::kText)) {
    add(chosen->text(), JsonValue::Object());
  }
}

}  // namespace

void AddStandIns(const JsonValue& document, PluginSets sets) {
  if (!document.Is(JsonValue::Type::kObject)) return;
  AddStandInsTo<ForeignKind, StandIn>(sets.navigators, document.Find("navigation"), "navigator");
  AddStandInsTo<ForeignEstimatorKind, EstimatorStandIn>(sets.estimators,
                                                        document.Find("localization"), "estimator");
  AddStandInsTo<ForeignReaderKind, ReaderStandIn>(sets.readers, document.Find("perception"),
                                                  "reader");
}

JsonValue ToJson(const std::vector<PluginUse>& plugins) {
  return core::ListOf(plugins, [](const PluginUse& use) {
    JsonValue entry = JsonValue::Object();
    entry.Append(use.kind == Kind::kLibrary ? "library" : "process", JsonValue(use.text));
    if (use.kind == Kind::kProcess) entry.Append("folder", JsonValue(use.folder));
    entry.Append("hash", JsonValue(use.hash));
    // For people: how it ran.
    if (use.kind == Kind::kProcess) entry.Append("confined", JsonValue(use.confined));
    return entry;
  });
}

JsonValue IdentityOf(const JsonValue& list) {
  JsonValue identity = list;
  if (!identity.Is(JsonValue::Type::kList)) return identity;
  for (JsonValue& entry : identity.list()) {
    entry.Erase("folder");
    entry.Erase("confined");
    entry.Erase("library");
    entry.Erase("process");
  }
  return identity;
}

namespace {

// Adds the kinds of these sources, but for those that a copy of the scenario has already.
template <typename Kind, typename Sources, typename Set>
void AddSources(const Sources& sources, Set& set) {
  for (const auto& source : sources) {
    const bool there = std::ranges::any_of(set.kinds(), [&](const auto& kind) {
      const auto* foreign = dynamic_cast<const Kind*>(kind.get());
      return foreign != nullptr && foreign->IsOf(source);
    });
    if (!there) set.Add(std::make_unique<Kind>(source));
  }
}

void RequireOwnColumns(const PluginSets& sets) {
  for (const auto& estimator : sets.estimators.kinds()) {
    for (const auto& navigator : sets.navigators.kinds()) {
      if (estimator->name() != navigator->name()) continue;
      for (const messages::OwnValue& value : estimator->own_values()) {
        if (!std::ranges::count(navigator->own_values(), value.name, &messages::OwnValue::name)) {
          continue;
        }
        throw UserError(fmt::format("localization.{}", estimator->name()),
                        fmt::format("counts \"{}\", as the navigator of that name does: records "
                                    "would have two columns of one name",
                                    value.name),
                        "give one of them another name");
      }
    }
  }
}

}  // namespace

void AddKinds(const std::vector<PluginUse>& plugins, PluginSets sets) {
  for (const PluginUse& use : plugins) {
    AddSources<ForeignKind>(use.navigators, sets.navigators);
    AddSources<ForeignEstimatorKind>(use.estimators, sets.estimators);
    AddSources<ForeignReaderKind>(use.readers, sets.readers);
  }
  RequireOwnColumns(sets);
}

}  // namespace rockyard::plugin
