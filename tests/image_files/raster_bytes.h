// Tiny elevation models, typed from the rules of their formats.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "image_files/pds_bytes.h"

namespace rockyard::image_files {

// A whole number of `bytes` bytes, in either order.
inline std::string NumberBytes(std::uint64_t number, std::size_t bytes, bool big_endian) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t place = big_endian ? bytes - 1 - i : i;
    text += static_cast<char>(number >> (8 * place) & 0xffU);
  }
  return text;
}

// One value of a type of NumPy: "<f4".
inline std::string ValueBytes(const std::string& type, double value) {
  const std::size_t bytes = static_cast<std::size_t>(type[2] - '0');
  const bool big_endian = type[0] == '>';
  if (type == "<f4" || type == ">f4") {
    return NumberBytes(std::bit_cast<std::uint32_t>(static_cast<float>(value)), bytes, big_endian);
  }
  if (type[1] == 'f') return NumberBytes(std::bit_cast<std::uint64_t>(value), bytes, big_endian);
  return NumberBytes(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), bytes,
                     big_endian);
}

// A file of NumPy, version 1 (NEP 1): the values of `columns` columns row by row.
inline std::string NpyBytes(const std::string& type, std::size_t columns,
                            const std::vector<double>& values) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                       std::to_string(values.size() / columns) + ", " + std::to_string(columns) +
                       "), }";
  header.resize(117, ' ');
  header += '\n';
  std::string bytes =
      "\x93NUMPY" + std::string("\x01\x00", 2) + NumberBytes(118, 2, false) + header;
  for (const double value : values) bytes += ValueBytes(type, value);
  return bytes;
}

// An ESRI ASCII grid: the first row is the northernmost.
inline std::string AscText(std::size_t columns, const std::vector<std::string>& values,
                           double cell = 1.0) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows " +
                     std::to_string(values.size() / columns) + "\nxllcorner 100\nyllcorner 200\n" +
                     "cellsize " + std::to_string(cell) + "\nNODATA_value -9999\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += values[i] + ((i + 1) % columns == 0 ? "\n" : " ");
  }
  return text;
}

// A GeoTIFF (TIFF 6.0; GeoTIFF 1.1) of one strip of reals of 4 bytes, little-endian.
struct TiffText {
  std::uint32_t columns = 0;
  std::vector<double> values;
  // Of the outer corner of the first cell, and a cell's sides; degrees or metres.
  double left = 0.0;
  double top = 0.0;
  double step_x = 1.0;
  double step_y = 1.0;
  std::vector<std::uint16_t> keys;  // whole GeoKey entries of four numbers
  std::vector<double> doubles;      // of GeoDoubleParams
  std::string no_data;              // of GDAL_NODATA; "": none
};

// Keys of a sphere of the radius of Mars (3396190 m): longitudes and latitudes in degrees,
inline void GeographicKeys(TiffText& tiff) {
  tiff.keys = {1024, 0, 1, 2,    1025, 0, 1, 1,     2048, 0,     1, 32767, 2050, 0,     1, 32767,
               2054, 0, 1, 9102, 2056, 0, 1, 32767, 2057, 34736, 1, 0,     2058, 34736, 1, 1};
  tiff.doubles = {3396190.0, 3396190.0};
}

// or metres of an equirectangular map whose standard parallel is given.
inline void EquirectangularKeys(TiffText& tiff, double parallel_deg) {
  GeographicKeys(tiff);
  tiff.keys[3] = 1;
  const std::vector<std::uint16_t> more{3072, 0,    1,     32767, 3074, 0,    1,     32767, 3075,
                                        0,    1,    17,    3076,  0,    1,    9001,  3078,  34736,
                                        1,    2,    3080,  34736, 1,    3,    3081,  34736, 1,
                                        3,    3082, 34736, 1,     3,    3083, 34736, 1,     3};
  tiff.keys.insert(tiff.keys.end(), more.begin(), more.end());
  tiff.doubles.insert(tiff.doubles.end(), {parallel_deg, 0.0});
}

inline std::string TiffBytes(const TiffText& tiff) {
  const auto rows = static_cast<std::uint32_t>(tiff.values.size()) / tiff.columns;
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count;
    std::string data;
  };
  const auto shorts = [](const std::vector<std::uint16_t>& numbers) {
    std::string bytes;
    for (const std::uint16_t number : numbers) bytes += NumberBytes(number, 2, false);
    return bytes;
  };
  const auto doubles = [](const std::vector<double>& numbers) {
    std::string bytes;
    for (const double number : numbers) bytes += ValueBytes("<f8", number);
    return bytes;
  };
  std::string pixels;
  for (const double value : tiff.values) pixels += ValueBytes("<f4", value);
  const auto one = [&](std::uint16_t tag, std::uint32_t value) {
    return Entry{tag, 4, 1, NumberBytes(value, 4, false)};
  };
  constexpr std::uint32_t kHead = 8;
  std::vector<Entry> entries{one(256, tiff.columns),
                             one(257, rows),
                             one(258, 32),
                             one(259, 1),
                             one(262, 1),
                             one(273, kHead),
                             one(277, 1),
                             one(278, rows),
                             one(279, static_cast<std::uint32_t>(pixels.size())),
                             one(339, 3)};
  entries.push_back({33550, 12, 3, doubles({tiff.step_x, tiff.step_y, 0.0})});
  entries.push_back({33922, 12, 6, doubles({0.0, 0.0, 0.0, tiff.left, tiff.top, 0.0})});
  if (!tiff.keys.empty()) {
    std::vector<std::uint16_t> keys{1, 1, 0, static_cast<std::uint16_t>(tiff.keys.size() / 4)};
    keys.insert(keys.end(), tiff.keys.begin(), tiff.keys.end());
    entries.push_back({34735, 3, static_cast<std::uint32_t>(keys.size()), shorts(keys)});
    entries.push_back(
        {34736, 12, static_cast<std::uint32_t>(tiff.doubles.size()), doubles(tiff.doubles)});
  }
  if (!tiff.no_data.empty()) {
    const std::string text = tiff.no_data + '\0';
    entries.push_back({42113, 2, static_cast<std::uint32_t>(text.size()), text});
  }
  const auto directory_at = static_cast<std::uint32_t>(kHead + pixels.size());
  std::string bytes = "II" + NumberBytes(42, 2, false) + NumberBytes(directory_at, 4, false);
  bytes += pixels + NumberBytes(entries.size(), 2, false);
  auto data_at = static_cast<std::uint32_t>(directory_at + 2 + 12 * entries.size() + 4);
  std::string data;
  for (Entry& entry : entries) {
    bytes += NumberBytes(entry.tag, 2, false) + NumberBytes(entry.type, 2, false) +
             NumberBytes(entry.count, 4, false);
    if (entry.data.size() <= 4) {
      entry.data.resize(4, '\0');
      bytes += entry.data;
    } else {
      bytes += NumberBytes(data_at + data.size(), 4, false);
      data += entry.data;
    }
  }
  return bytes + std::string(4, '\0') + data;
}

}  // namespace rockyard::image_files
