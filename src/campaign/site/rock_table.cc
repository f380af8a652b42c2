#include "campaign/site/rock_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "core/text.h"

namespace rockyard::campaign {
namespace {

constexpr std::size_t kMostProblems = 20;

// Must have the order of RockField.
constexpr std::array<std::string_view, kRockFields> kRockFieldNames{
    "x", "y", "lon", "lat", "diameter", "length", "width", "height", "burial", "yaw"};

struct Alias {
  RockField field;
  std::string_view name;  // lower case, without its unit
};

constexpr Alias kAliases[] = {
    {RockField::kX, "x"},
    {RockField::kX, "east"},
    {RockField::kX, "easting"},
    {RockField::kY, "y"},
    {RockField::kY, "north"},
    {RockField::kY, "northing"},
    {RockField::kLon, "lon"},
    {RockField::kLon, "longitude"},
    {RockField::kLat, "lat"},
    {RockField::kLat, "latitude"},
    {RockField::kDiameter, "diameter"},
    {RockField::kDiameter, "d"},
    {RockField::kLength, "length"},
    {RockField::kWidth, "width"},
    {RockField::kHeight, "height"},
    {RockField::kBurial, "burial"},
    {RockField::kBurial, "buried_share"},
    {RockField::kYaw, "yaw"},
};

struct LengthUnit {
  std::string_view name;
  double metres;
};
constexpr std::array<LengthUnit, 3> kLengthUnits{{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}}};

bool IsLength(RockField field) {
  return field == RockField::kX || field == RockField::kY || field == RockField::kDiameter ||
         field == RockField::kLength || field == RockField::kWidth || field == RockField::kHeight;
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// A name and the unit at its end: "D_cm", "width (m)", "height [mm]"; no unit where none stands
// there.
struct NameAndUnit {
  std::string name;
  std::string unit;
};

NameAndUnit SplitUnit(std::string_view text) {
  std::string lower = Lower(Trimmed(text));
  for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}}) {
    const std::size_t at = lower.rfind(open);
    if (at == std::string::npos || at == 0 || lower.back() != close) continue;
    return {std::string(Trimmed(std::string_view(lower).substr(0, at))),
            std::string(Trimmed(std::string_view(lower).substr(at + 1, lower.size() - at - 2)))};
  }
  const std::size_t at = lower.rfind('_');
  if (at == std::string::npos || at == 0) return {lower, ""};
  const std::string unit = lower.substr(at + 1);
  for (const std::string_view known : {"m", "cm", "mm", "px", "deg"}) {
    if (unit == known) return {lower.substr(0, at), unit};
  }
  return {lower, ""};
}

// One "field=column:unit".
struct Declared {
  RockField field;
  std::string column;
  std::string unit;
};

std::vector<Declared> DeclaredIn(const std::string& columns, std::vector<core::Problem>& problems) {
  std::vector<Declared> all;
  std::string_view rest = columns;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::string_view part = Trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t equals = part.find('=');
    const std::string_view name = Trimmed(part.substr(0, std::min(equals, part.size())));
    const auto* found = std::ranges::find(kRockFieldNames, name);
    if (equals == std::string_view::npos || found == kRockFieldNames.end()) {
      problems.push_back({"--columns", fmt::format("names no field in \"{}\"", part),
                          fmt::format("use FIELD=COLUMN or FIELD=COLUMN:UNIT with FIELD one of {}",
                                      fmt::join(kRockFieldNames, ", "))});
      continue;
    }
    std::string_view column = part.substr(equals + 1);
    const std::size_t colon = column.rfind(':');
    std::string_view unit;
    if (colon != std::string_view::npos) {
      unit = Trimmed(column.substr(colon + 1));
      column = column.substr(0, colon);
    }
    all.push_back({static_cast<RockField>(found - kRockFieldNames.begin()),
                   std::string(Trimmed(column)), Lower(unit)});
  }
  return all;
}

std::optional<std::size_t> ColumnNumber(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  constexpr std::size_t kMost = 1000;
  if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > kMost) {
    return std::nullopt;
  }
  return number - 1;
}

void SetScale(RockField field, const std::string& unit, RockColumn& column,
              std::vector<core::Problem>& problems) {
  if (unit.empty() || (!IsLength(field) && unit == "deg")) return;
  if (IsLength(field)) {
    for (const LengthUnit& known : kLengthUnits) {
      if (unit != known.name) continue;
      column.scale = known.metres;
      return;
    }
  }
  problems.push_back({fmt::format("column {}", column.name), fmt::format("is in {}", unit),
                      IsLength(field)
                          ? "bring it to m, cm or mm: pixels have no length of their own"
                          : "use degrees for angles and shares without a unit"});
}

// Whether columns, by their fields, say where a rock lies and how large it is.
void RequireFields(const RockColumns& columns, const std::string& file,
                   std::vector<core::Problem>& problems) {
  const auto has = [&](RockField field) {
    return columns[static_cast<std::size_t>(field)].has_value();
  };
  if (!has(RockField::kDiameter) && !(has(RockField::kLength) && has(RockField::kWidth))) {
    problems.push_back({file, "has no column of diameters, nor of lengths and widths",
                        "say which it is: --columns diameter=NAME:cm"});
  }
  if (has(RockField::kX) != has(RockField::kY) || has(RockField::kLon) != has(RockField::kLat)) {
    problems.push_back({file, "has half of its places: one of two columns",
                        "name both: --columns x=NAME,y=NAME or lon=NAME,lat=NAME"});
  }
}

}  // namespace

bool AreNumbered(const std::string& columns) {
  std::vector<core::Problem> ignored;
  const std::vector<Declared> declared = DeclaredIn(columns, ignored);
  return !declared.empty() && std::ranges::all_of(declared, [](const Declared& one) {
    return ColumnNumber(one.column).has_value();
  });
}

RockColumns FindRockColumns(std::span<const std::string> names, const std::string& columns,
                            const std::string& file) {
  std::vector<core::Problem> problems;
  RockColumns found;
  for (const Declared& one : DeclaredIn(columns, problems)) {
    auto& place = found[static_cast<std::size_t>(one.field)];
    const auto named = std::ranges::find(names, one.column);
    const std::optional<std::size_t> number = ColumnNumber(one.column);
    if (named != names.end()) {
      place = RockColumn{static_cast<std::size_t>(named - names.begin()), one.column};
    } else if (number && (names.empty() || *number < names.size())) {
      place = RockColumn{*number, one.column};
    } else {
      const std::vector<std::string_view> views(names.begin(), names.end());
      problems.push_back(
          {"--columns", fmt::format("names \"{}\", which is no column of {}", one.column, file),
           views.empty() ? "use its number, from 1" : core::Suggest(one.column, views)});
      continue;
    }
    SetScale(one.field, one.unit.empty() ? SplitUnit(one.column).unit : one.unit, *place, problems);
  }
  const auto size_declared = [&] {
    return found[static_cast<std::size_t>(RockField::kDiameter)].has_value();
  };
  const bool sized = size_declared();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const NameAndUnit split = SplitUnit(names[i]);
    for (const Alias& alias : kAliases) {
      auto& place = found[static_cast<std::size_t>(alias.field)];
      if (place || split.name != alias.name) continue;
      // A diameter that is declared leaves no room for another size.
      if (sized && (alias.field == RockField::kLength || alias.field == RockField::kWidth))
        continue;
      place = RockColumn{i, names[i]};
      SetScale(alias.field, split.unit, *place, problems);
    }
  }
  RequireFields(found, file, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return found;
}

RockMaker::RockMaker(std::string file, RockColumns columns)
    : file_(std::move(file)), columns_(std::move(columns)) {
  catalogue_.geographic = Has(RockField::kLon) && !Has(RockField::kX);
  catalogue_.placed = Has(RockField::kX) || Has(RockField::kLon);
}

void RockMaker::Fail(const std::string& where, std::string reason, std::string remedy) {
  if (problems_.size() < kMostProblems) {
    problems_.push_back(
        {fmt::format("{}: {}", file_, where), std::move(reason), std::move(remedy)});
  }
}

std::optional<double> RockMaker::Number(RockField field, std::span<const std::string_view> texts,
                                        const std::string& where) {
  const auto& column = columns_[static_cast<std::size_t>(field)];
  if (!column) return std::nullopt;
  if (column->index >= texts.size()) {
    Fail(where,
         fmt::format("has {} columns, and {} is column {}", texts.size(),
                     kRockFieldNames[static_cast<std::size_t>(field)], column->index + 1),
         "fill the line up, or remove it");
    return std::nullopt;
  }
  const std::string_view text = Trimmed(texts[column->index]);
  const std::optional<double> number = core::FiniteNumber(text);
  const bool optional = field == RockField::kHeight || field == RockField::kYaw;
  if (!number && !(text.empty() && optional)) {
    Fail(where,
         fmt::format("\"{}\" is no number for {}", text.substr(0, 40),
                     kRockFieldNames[static_cast<std::size_t>(field)]),
         "use digits with a point, or remove the line");
  }
  if (!number) return std::nullopt;
  return *number * column->scale;
}

std::optional<double> RockMaker::Length(RockField field, std::span<const std::string_view> texts,
                                        const std::string& where) {
  const std::optional<double> length_m = Number(field, texts, where);
  constexpr double kMost_m = 1000.0;
  if (length_m && !(*length_m > 0.0 && *length_m <= kMost_m)) {
    Fail(where,
         fmt::format("{} is {:g} m", kRockFieldNames[static_cast<std::size_t>(field)], *length_m),
         "use a length above 0, of up to 1000 m, or check its unit (--columns)");
    return std::nullopt;
  }
  return length_m;
}

std::optional<double> RockMaker::Burial(std::span<const std::string_view> texts,
                                        const std::string& where) {
  const auto& column = columns_[static_cast<std::size_t>(RockField::kBurial)];
  if (!column || column->index >= texts.size()) return std::nullopt;
  const std::string word = Lower(Trimmed(texts[column->index]));
  if (word.empty()) return std::nullopt;
  constexpr std::array<std::pair<std::string_view, double>, 4> kClasses{
      {{"perched", 0.0},
       {"partially buried", 1.0 / 3.0},
       {"partially_buried", 1.0 / 3.0},
       {"buried", 2.0 / 3.0}}};
  for (const auto& [name, share] : kClasses) {
    if (word != name) continue;
    classes_ = true;
    return share;
  }
  const std::optional<double> share = core::FiniteNumber(word);
  if (share && *share >= 0.0 && *share <= 1.0) return share;
  Fail(where, fmt::format("\"{}\" is no burial", word.substr(0, 40)),
       "use a share from 0 to 1, or perched, partially buried or buried");
  return std::nullopt;
}

void RockMaker::Take(std::span<const std::string_view> texts, const std::string& where) {
  if (catalogue_.rocks.size() >= kMostCatalogueRocks) {
    throw core::UserError(
        fmt::format("{}: {}", file_, where),
        fmt::format("is rock number {}", kMostCatalogueRocks + 1),
        fmt::format("take at most {}: those of the site alone", kMostCatalogueRocks));
  }
  CatalogueRock rock;
  if (catalogue_.placed) {
    rock.x =
        Number(catalogue_.geographic ? RockField::kLon : RockField::kX, texts, where).value_or(0.0);
    rock.y =
        Number(catalogue_.geographic ? RockField::kLat : RockField::kY, texts, where).value_or(0.0);
  }
  if (Has(RockField::kDiameter)) {
    rock.diameter_m = Length(RockField::kDiameter, texts, where).value_or(0.0);
  } else {
    const double length_m = Length(RockField::kLength, texts, where).value_or(1.0);
    const double width_m = Length(RockField::kWidth, texts, where).value_or(1.0);
    rock.diameter_m = std::max(length_m, width_m);
    constexpr double kNarrowest = 0.2;  // of terrain.rocks.listed.width_ratio
    rock.width_ratio = std::max(kNarrowest, std::min(length_m, width_m) / rock.diameter_m);
  }
  rock.height_m = Length(RockField::kHeight, texts, where);
  rock.buried_share = Burial(texts, where);
  rock.yaw_deg = Number(RockField::kYaw, texts, where);
  catalogue_.rocks.push_back(rock);
}

RockCatalogue RockMaker::Finish(bool needs_places) && {
  if (needs_places && !catalogue_.placed) {
    throw core::UserError(file_, "does not say where its rocks lie",
                          "name the columns: --columns x=NAME,y=NAME or lon=NAME,lat=NAME");
  }
  if (problems_.empty() && catalogue_.rocks.empty()) {
    throw core::UserError(file_, "has no rocks", "name a catalogue with a line for each rock");
  }
  if (!problems_.empty()) throw core::UserError(std::move(problems_));
  if (classes_) {
    catalogue_.notes.emplace_back(
        "classes of burial stand for shares of the height that are assumed: perched 0, partially "
        "buried 1/3, buried 2/3");
  }
  return std::move(catalogue_);
}

}  // namespace rockyard::campaign
