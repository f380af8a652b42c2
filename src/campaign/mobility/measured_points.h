// Points that were measured on slopes or of wheels, to be drawn beside what is computed.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace rockyard::campaign {

struct MeasuredPoint {
  std::string soil;                      // "": of whichever
  std::string way = "up";                // up, down or across
  std::map<std::string, double> values;  // by column, such as slope_deg and slip
};

// The columns of numbers that a file of points may have.
std::span<const std::string_view> PointColumns();

// Reads a CSV file with a line of names: soil, way and any of PointColumns. Empty fields are none.
// Throws core::UserError with what is wrong, line by line; `soils` are the names that it may use.
std::vector<MeasuredPoint> ReadPoints(const std::filesystem::path& file,
                                      std::span<const std::string> soils);

}  // namespace rockyard::campaign
