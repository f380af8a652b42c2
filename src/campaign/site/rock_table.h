// Fields of a catalogue of rocks and where they stand in a table or in properties, for
// ReadCatalogue.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/site/rock_catalogue.h"
#include "core/error.h"

namespace rockyard::campaign {

// Must have the order of kRockFieldNames (rock_table.cc).
enum class RockField { kX, kY, kLon, kLat, kDiameter, kLength, kWidth, kHeight, kBurial, kYaw };
inline constexpr std::size_t kRockFields = 10;

// Where a field stands, and metres (or degrees, or shares) per unit.
struct RockColumn {
  std::size_t index = 0;
  std::string name;
  double scale = 1.0;
};
using RockColumns = std::array<std::optional<RockColumn>, kRockFields>;

// Returns the columns of a table with these names, by what `columns` declares (CatalogueRequest)
// and by the names themselves. An empty span of names stands for a table without a header, whose
// columns all are declared by number. Throws core::UserError with all that is wrong.
RockColumns FindRockColumns(std::span<const std::string> names, const std::string& columns,
                            const std::string& file);

// Returns whether `columns` names all its columns by number.
bool AreNumbered(const std::string& columns);

// Makes rocks of rows of texts, one after the other, and gathers what is wrong.
class RockMaker {
 public:
  RockMaker(std::string file, RockColumns columns);

  // Takes the texts of a row; `where` names it in messages: "line 7". Texts that are missing are
  // empty.
  void Take(std::span<const std::string_view> texts, const std::string& where);
  void Fail(const std::string& where, std::string reason, std::string remedy);

  // Throws core::UserError where anything was wrong, or nothing was read.
  RockCatalogue Finish(bool needs_places) &&;

 private:
  std::optional<double> Number(RockField field, std::span<const std::string_view> texts,
                               const std::string& where);
  std::optional<double> Length(RockField field, std::span<const std::string_view> texts,
                               const std::string& where);
  std::optional<double> Burial(std::span<const std::string_view> texts, const std::string& where);
  bool Has(RockField field) const { return columns_[static_cast<std::size_t>(field)].has_value(); }

  std::string file_;
  RockColumns columns_;
  RockCatalogue catalogue_;
  std::vector<core::Problem> problems_;
  bool classes_ = false;  // of burial
};

}  // namespace rockyard::campaign
