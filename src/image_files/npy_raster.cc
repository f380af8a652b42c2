#include "image_files/npy_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "core/check.h"
#include "core/error.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNpyMark = "\x93NUMPY";
// Headers of plain arrays have 118 bytes; version 1 allows 64 kB.
constexpr std::size_t kMostNpyHeader = 1 << 16;
// Longer sides would overflow nothing, but are no elevation model.
constexpr std::int64_t kMostNpySide = 1 << 24;

struct NpyType {
  char kind = 'f';  // of NumPy: f, i, u
  std::size_t bytes = 4;
  bool big_endian = false;
};

struct NpyHeader {
  NpyType type;
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  std::uint64_t data_at = 0;  // of the first byte after the header
};

// Returns what follows `'key':` in a dictionary of Python, without blanks in front.
std::string_view MemberOf(std::string_view text, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string word = fmt::format("{}{}{}", quote, key, quote);
    std::size_t at = text.find(word);
    if (at == std::string_view::npos) continue;
    at = text.find_first_not_of(" :", at + word.size());
    return at == std::string_view::npos ? std::string_view() : text.substr(at);
  }
  return {};
}

std::optional<NpyType> TypeOf(std::string_view descr) {
  if (descr.size() < 5 || (descr[0] != '\'' && descr[0] != '"') || descr[4] != descr[0]) return {};
  const std::string_view word = descr.substr(1, 3);
  const bool known = word.substr(1) == "f4" || word.substr(1) == "f8" || word.substr(1) == "i2" ||
                     word.substr(1) == "i4" || word.substr(1) == "u2";
  if (!known || std::string_view("<>=").find(word[0]) == std::string_view::npos) return {};
  return NpyType{word[1], static_cast<std::size_t>(word[2] - '0'), word[0] == '>'};
}

// Returns the two numbers of "(120, 70)"; nothing for any other text.
std::optional<std::array<std::int64_t, 2>> ShapeOf(std::string_view text) {
  if (!text.starts_with('(')) return {};
  std::array<std::int64_t, 2> sides{};
  for (std::size_t i = 0; i < 2; ++i) {
    text.remove_prefix(1);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), sides[i]);
    if (error != std::errc() || sides[i] < 0) return {};
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (!text.starts_with(i == 0 ? ',' : ')')) return {};
  }
  return sides;
}

std::uint64_t LittleEndian(std::string_view bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    number = number << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return number;
}

NpyHeader HeaderOf(const std::string& name, std::ifstream& file) {
  const auto take = [&](std::size_t count) {
    std::string bytes(count, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(count))) FailTruncated(name);
    return bytes;
  };
  const std::string version = take(kNpyMark.size() + 2).substr(kNpyMark.size());
  const std::size_t length_bytes = version[0] == 1 ? 2 : 4;
  if (version[0] < 1 || version[0] > 3) {
    FailUnsupported(name, fmt::format("is of version {} of NumPy's format", int{version[0]}),
                    "save it anew with numpy.save");
  }
  const std::uint64_t length = LittleEndian(take(length_bytes));
  if (length > kMostNpyHeader) FailDamaged(name, fmt::format("a header of {} bytes", length));
  const std::string text = take(length);
  NpyHeader header;
  header.data_at = kNpyMark.size() + 2 + length_bytes + length;
  const std::optional<NpyType> type = TypeOf(MemberOf(text, "descr"));
  if (!type) {
    FailUnsupported(name, "holds no plain numbers of a type that is read",
                    "save heights.astype('f4'): types f4, f8, i2, i4 and u2 are read");
  }
  header.type = *type;
  if (!MemberOf(text, "fortran_order").starts_with("False")) {
    FailUnsupported(name, "is not stored row by row (fortran_order)",
                    "save numpy.ascontiguousarray(heights)");
  }
  const auto shape = ShapeOf(MemberOf(text, "shape"));
  if (!shape) {
    FailUnsupported(name, "is no array of two dimensions", "save the rows and columns of one band");
  }
  header.rows = (*shape)[0];
  header.columns = (*shape)[1];
  return header;
}

template <typename Value>
double ValueAt(const char* bytes, bool swap) {
  std::array<char, sizeof(Value)> raw{};
  std::memcpy(raw.data(), bytes, raw.size());
  if (swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<Value>(raw));
}

double NumberAt(const NpyType& type, const char* bytes) {
  const bool swap = type.big_endian == (std::endian::native == std::endian::little);
  if (type.kind == 'f') {
    const double value =
        type.bytes == 4 ? ValueAt<float>(bytes, swap) : ValueAt<double>(bytes, swap);
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
  }
  if (type.kind == 'u') return ValueAt<std::uint16_t>(bytes, swap);
  return type.bytes == 2 ? ValueAt<std::int16_t>(bytes, swap) : ValueAt<std::int32_t>(bytes, swap);
}

class NpyRaster final : public ElevationRaster {
 public:
  NpyRaster(std::string name, std::ifstream file, const NpyHeader& header)
      : ElevationRaster(std::move(name),
                        {.format = "NumPy", .rows = header.rows, .columns = header.columns}),
        file_(std::move(file)),
        header_(header) {}

  std::vector<double> Read(const RasterWindow& window) override {
    EXPECT(window.rows * window.columns <= kMostWindowCells);
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(window.rows * window.columns));
    std::vector<char> row(static_cast<std::size_t>(window.columns) * header_.type.bytes);
    for (std::int64_t r = window.row; r < window.row + window.rows; ++r) {
      const auto cell = static_cast<std::uint64_t>(r * header_.columns + window.column);
      file_.clear();
      file_.seekg(static_cast<std::streamoff>(header_.data_at + cell * header_.type.bytes));
      if (!file_.read(row.data(), static_cast<std::streamsize>(row.size()))) FailTruncated(name());
      for (std::size_t at = 0; at < row.size(); at += header_.type.bytes) {
        heights.push_back(NumberAt(header_.type, row.data() + at));
      }
    }
    return heights;
  }

 private:
  std::ifstream file_;
  NpyHeader header_;
};

}  // namespace

bool IsNpy(std::string_view head) { return head.starts_with(kNpyMark); }

std::unique_ptr<ElevationRaster> OpenNpy(const fs::path& path) {
  const std::string name = path.string();
  std::ifstream file(path, std::ios::binary);
  const NpyHeader header = HeaderOf(name, file);
  if (std::min(header.rows, header.columns) < 1 ||
      std::max(header.rows, header.columns) > kMostNpySide) {
    FailUnsupported(name, fmt::format("has {} rows of {} columns", header.rows, header.columns),
                    "name an array with heights in it");
  }
  const auto cells =
      static_cast<std::uint64_t>(header.rows) * static_cast<std::uint64_t>(header.columns);
  if (fs::file_size(path) < header.data_at + cells * header.type.bytes) FailTruncated(name);
  return std::make_unique<NpyRaster>(name, std::move(file), header);
}

}  // namespace rockyard::image_files
