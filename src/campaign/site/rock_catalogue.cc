#include "campaign/site/rock_catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "campaign/site/rock_table.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_pieces.h"
#include "core/json_text.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

// Returns the next line of a text, without its end, and takes it off.
std::string_view NextLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool IsComment(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at == std::string_view::npos || line[at] == '#';
}

// Commas, semicolons or tabs, whichever the line has; a blank stands for any run of them.
char DelimiterOf(std::string_view line) {
  for (const char delimiter : {',', ';', '\t'}) {
    if (line.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return ' ';
}

// Splits a line; quotes around a part are taken off, and a delimiter within them parts nothing.
void SplitLine(std::string_view line, char delimiter, std::vector<std::string_view>& parts) {
  parts.clear();
  if (delimiter == ' ') {
    constexpr std::string_view kBlanks = " \t";
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      parts.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(kBlanks, end);
    }
    return;
  }
  while (true) {
    const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
    std::size_t end = 0;
    if (first < line.size() && line[first] == '"') {
      const std::size_t close = std::min(line.find('"', first + 1), line.size());
      end = std::min(line.find(delimiter, close), line.size());
      parts.push_back(line.substr(first + 1, close - first - 1));
    } else {
      end = std::min(line.find(delimiter), line.size());
      parts.push_back(line.substr(0, end));
    }
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
  }
}

RockCatalogue ReadTable(std::string_view text, const CatalogueRequest& request) {
  const std::string file = request.file.string();
  std::int64_t number = 0;
  std::string_view rest = text;
  std::string_view line;
  while (!rest.empty() && IsComment(line)) {
    line = NextLine(rest);
    ++number;
  }
  if (IsComment(line)) {
    throw core::UserError(file, "is empty", "name a table with a line for each rock");
  }
  const char delimiter = DelimiterOf(line);
  std::vector<std::string_view> parts;
  SplitLine(line, delimiter, parts);
  const bool headless =
      AreNumbered(request.columns) && std::ranges::any_of(parts, [](std::string_view part) {
        return part.find_first_of("0123456789") == 0;
      });
  std::vector<std::string> names;
  if (!headless) {
    for (const std::string_view part : parts) {
      const std::size_t at = std::min(part.find_first_not_of(" \t"), part.size());
      names.emplace_back(part.substr(at, part.find_last_not_of(" \t") + 1 - at));
    }
  }
  RockMaker maker(file, FindRockColumns(names, request.columns, file));
  if (headless) maker.Take(parts, fmt::format("line {}", number));
  while (!rest.empty()) {
    line = NextLine(rest);
    ++number;
    if (IsComment(line)) continue;
    SplitLine(line, delimiter, parts);
    maker.Take(parts, fmt::format("line {}", number));
  }
  return std::move(maker).Finish(request.needs_places);
}

// Returns the two numbers of a point; nothing for any other geometry.
std::optional<std::array<double, 2>> PointOf(const JsonValue& feature) {
  const JsonValue* geometry = feature.Find("geometry");
  const JsonValue* type = geometry == nullptr ? nullptr : geometry->Find("type");
  const JsonValue* at = geometry == nullptr ? nullptr : geometry->Find("coordinates");
  if (type == nullptr || !type->Is(JsonValue::Type::kText) || type->text() != "Point" ||
      at == nullptr || !at->Is(JsonValue::Type::kList) || at->list().size() < 2 ||
      !at->list()[0].IsNumber() || !at->list()[1].IsNumber()) {
    return std::nullopt;
  }
  return std::array{at->list()[0].number(), at->list()[1].number()};
}

std::string TextOf(const JsonValue& value) {
  if (value.Is(JsonValue::Type::kText)) return value.text();
  return value.IsNumber() ? core::JsonNumber(value.number()) : "";
}

// Names of the properties of all features, in the order in which they are met.
std::vector<std::string> PropertyNames(const JsonValue::List& features) {
  constexpr std::size_t kMostNames = 1000;
  std::vector<std::string> names;
  for (const JsonValue& feature : features) {
    const JsonValue* properties = feature.Find("properties");
    if (properties == nullptr || !properties->Is(JsonValue::Type::kObject)) continue;
    for (const core::JsonMember& member : properties->members()) {
      if (names.size() < kMostNames && std::ranges::find(names, member.key) == names.end()) {
        names.push_back(member.key);
      }
    }
  }
  return names;
}

RockCatalogue ReadGeoJson(std::string_view text, const CatalogueRequest& request) {
  const std::string file = request.file.string();
  const JsonValue document = core::ParseJson(text, file);
  const JsonValue* features = document.Find("features");
  if (features == nullptr || !features->Is(JsonValue::Type::kList)) {
    throw core::UserError(file, "is no FeatureCollection",
                          "name a GeoJSON file with a list \"features\"");
  }
  std::vector<std::string> names = PropertyNames(features->list());
  const std::size_t properties = names.size();
  RockColumns columns = FindRockColumns(names, request.columns, file);
  auto& x = columns[static_cast<std::size_t>(RockField::kX)];
  auto& lon = columns[static_cast<std::size_t>(RockField::kLon)];
  const bool from_geometry = !x && !lon;
  if (from_geometry) {
    lon = RockColumn{properties, "coordinates"};
    columns[static_cast<std::size_t>(RockField::kLat)] = RockColumn{properties + 1, "coordinates"};
  }
  RockMaker maker(file, std::move(columns));
  std::size_t number = 0;
  std::vector<std::string> texts(properties + 2);
  for (const JsonValue& feature : features->list()) {
    const std::string where = fmt::format("features[{}]", number++);
    const auto point = PointOf(feature);
    if (from_geometry && !point) {
      maker.Fail(where, "is no point", "give every rock a geometry of type Point");
      continue;
    }
    const JsonValue* of = feature.Find("properties");
    for (std::size_t i = 0; i < properties; ++i) {
      const JsonValue* value = of == nullptr ? nullptr : of->Find(names[i]);
      texts[i] = value == nullptr ? "" : TextOf(*value);
    }
    if (point) {
      texts[properties] = core::JsonNumber((*point)[0]);
      texts[properties + 1] = core::JsonNumber((*point)[1]);
    }
    const std::vector<std::string_view> views(texts.begin(), texts.end());
    maker.Take(views, where);
  }
  return std::move(maker).Finish(request.needs_places);
}

}  // namespace

RockCatalogue ReadCatalogue(const CatalogueRequest& request) {
  const std::string text =
      core::ReadTextFile(request.file, kMostCatalogueBytes, "a catalogue of rocks");
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') return ReadGeoJson(text, request);
  return ReadTable(text, request);
}

}  // namespace rockyard::campaign
