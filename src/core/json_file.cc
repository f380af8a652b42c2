#include "core/json_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "core/text.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestChain = 16;
// Most files of a document. Files that each name several others multiply: this bounds the memory of
// a mistaken or hostile input.
constexpr std::size_t kMaxFiles = 64;
// The key that no kind of a scenario may have for its name (core/kind_set.cc).
constexpr std::string_view kExtends = "extends";

// Returns "a.b" of "a" and "b".
std::string Join(std::string_view at, std::string_view key) {
  return at.empty() ? std::string(ShownKey(key)) : fmt::format("{}.{}", at, ShownKey(key));
}

// Problems are named by the place in the whole document where a file is asked for.
class ExtendsLoader {
 public:
  JsonValue Load(const fs::path& path, const std::string& at) {
    std::error_code error;
    fs::path identity = fs::weakly_canonical(path, error);
    if (error) identity = path;
    CheckChain(path, identity, at);
    JsonValue value = LoadJsonFileAlone(path);
    files_.push_back(identity);
    chain_.push_back(std::move(identity));
    value = Resolve(std::move(value), path.parent_path(), at);
    chain_.pop_back();
    return value;
  }

  // Resolves what stands inside of the value first, then what the value itself extends.
  JsonValue Resolve(JsonValue value, const fs::path& folder, const std::string& at) {
    if (value.Is(JsonValue::Type::kList)) {
      JsonValue::List& items = value.list();
      for (std::size_t i = 0; i < items.size(); ++i) {
        items[i] = Resolve(std::move(items[i]), folder, fmt::format("{}[{}]", at, i));
      }
    }
    if (!value.Is(JsonValue::Type::kObject)) return value;
    for (JsonMember& member : value.members()) {
      member.value = Resolve(std::move(member.value), folder, Join(at, member.key));
    }
    const JsonValue* base = value.Find(kExtends);
    if (base == nullptr) return value;
    JsonValue merged = LoadBases(*base, folder, at);
    value.Erase(kExtends);
    merged.Merge(value);
    return merged;
  }

  const std::vector<fs::path>& files() const { return files_; }

 private:
  // Returns the object of one file, or of a list of files of which each lies over the one before.
  JsonValue LoadBases(const JsonValue& names, const fs::path& folder, const std::string& at) {
    if (!names.Is(JsonValue::Type::kList)) return LoadBase(names, folder, at);
    JsonValue merged = JsonValue::Object();
    for (const JsonValue& name : names.list()) merged.Merge(LoadBase(name, folder, at));
    return merged;
  }

  JsonValue LoadBase(const JsonValue& name, const fs::path& folder, const std::string& at) {
    if (!name.Is(JsonValue::Type::kText) || name.text().empty()) {
      throw UserError(Join(at, kExtends), fmt::format("is {}, not a file name", Abbreviate(name)),
                      "write a path relative to this file");
    }
    const fs::path path = folder / name.text();
    if (std::error_code error; fs::status(path, error).type() == fs::file_type::not_found) {
      throw UserError(Join(at, kExtends),
                      fmt::format("names {}, which does not exist", path.string()),
                      "check the name and the folder; it is relative to the file that extends it");
    }
    JsonValue base = Load(path, at);
    if (!base.Is(JsonValue::Type::kObject)) {
      throw UserError(Join(at, kExtends),
                      fmt::format("names {}, which holds {}", name.text(), Describe(base.type())),
                      "name a file that holds an object");
    }
    return base;
  }

  void CheckChain(const fs::path& path, const fs::path& identity, const std::string& at) {
    if (std::find(chain_.begin(), chain_.end(), identity) != chain_.end()) {
      throw UserError(Join(at, kExtends), "the files extend each other in a cycle: " + Chain(path),
                      "remove one of the \"extends\"");
    }
    if (chain_.size() >= kLongestChain) {
      throw UserError(
          Join(at, kExtends),
          fmt::format("more than {} files extend each other: {}", kLongestChain, Chain(path)),
          "merge some of them");
    }
    if (files_.size() >= kMaxFiles) {
      throw UserError(Join(at, kExtends), fmt::format("more than {} files are read", kMaxFiles),
                      "merge some of them");
    }
  }

  std::string Chain(const fs::path& last) const {
    std::string text;
    for (const fs::path& path : chain_) text += path.filename().string() + " -> ";
    return text + last.filename().string();
  }

  std::vector<fs::path> chain_;
  std::vector<fs::path> files_;  // all that were read
};

// Returns the text as JSON, or nothing where it is none.
std::optional<JsonValue> TryParse(std::string_view text) {
  try {
    return ParseJson(text, "value");
  } catch (const UserError&) {
    return std::nullopt;
  }
}

}  // namespace

JsonValue LoadJsonFile(const fs::path& path) {
  JsonValue document = ExtendsLoader().Load(path, "");
  if (!document.Is(JsonValue::Type::kObject)) {
    throw UserError(path.string(), fmt::format("is {}, not an object", Describe(document.type())),
                    "write an object");
  }
  return document;
}

std::vector<fs::path> FilesOf(const fs::path& path) {
  ExtendsLoader loader;
  static_cast<void>(loader.Load(path, ""));
  return loader.files();
}

JsonValue LoadJsonFileAlone(const fs::path& path) {
  return ParseJson(ReadWholeFile(path, JsonLimits().max_bytes, "a JSON file"), path.string());
}

JsonValue ResolveExtends(JsonValue value, const fs::path& folder) {
  return ExtendsLoader().Resolve(std::move(value), folder, "");
}

void SetPath(JsonValue& document, std::string_view path, JsonValue value) {
  JsonValue* at = &document;
  std::string_view rest = path;
  if (std::count(path.begin(), path.end(), '.') >= JsonLimits().max_depth) {
    throw UserError(fmt::format("\"{}\"", path.substr(0, 60)), "has too many parts",
                    "check the path");
  }
  while (true) {
    const std::size_t dot = rest.find('.');
    const std::string_view key = rest.substr(0, dot);
    if (key.empty()) {
      throw UserError(fmt::format("\"{}\"", path), "is not a path",
                      "write keys joined by dots, such as a.b.c");
    }
    if (!at->Is(JsonValue::Type::kObject)) {
      const std::string_view before = path.substr(0, path.size() - rest.size());
      throw UserError(before.empty() ? "(root)" : std::string(before.substr(0, before.size() - 1)),
                      fmt::format("is {}, not an object", Abbreviate(*at)), "write an object");
    }
    if (dot == std::string_view::npos) {
      at->Set(key, std::move(value));
      return;
    }
    JsonValue* next = at->Find(key);
    at = next != nullptr ? next : &at->Set(key, JsonValue::Object());
    rest.remove_prefix(dot + 1);
  }
}

void ApplyOverride(JsonValue& document, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw UserError(std::string(assignment), "has no '='", "write PATH=VALUE");
  }
  const std::string_view path = assignment.substr(0, equals);
  const std::string_view text = assignment.substr(equals + 1);
  std::optional<JsonValue> value = TryParse(text);
  if (!value) {
    const bool structured =
        !text.empty() && std::string_view("[{\"").find(text[0]) != std::string_view::npos;
    value = structured ? ParseJson(text, path) : JsonValue(text);
  }
  SetPath(document, path, *std::move(value));
}

}  // namespace rockyard::core
