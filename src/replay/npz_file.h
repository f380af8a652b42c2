// Arrays of numbers and texts as a NumPy file (.npz): a zip archive of one .npy for each. Trace
// files (trace_npz.h) are such files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::replay {

// Collects arrays, and writes them in the order in which they came. numpy.load reads them without
// pickle. Arrays are row-major and little endian, of float64 (<f8), int64 (<i8), bool (|b1) or
// texts (<U: UTF-32, all padded to the longest; what is no UTF-8 becomes U+FFFD).
class NpzFile {
 public:
  using Shape = std::vector<std::size_t>;

  // Each adds an array. The product of the shape must be the number of values, and the name new.
  void AddReals(std::string_view name, std::span<const double> values, const Shape& shape);
  void AddIntegers(std::string_view name, std::span<const std::int64_t> values, const Shape& shape);
  void AddFlags(std::string_view name, std::span<const std::uint8_t> values, const Shape& shape);
  void AddTexts(std::string_view name, std::span<const std::string> texts);
  // Adds a text as an array without dimensions.
  void AddText(std::string_view name, const std::string& text);

  // Returns the file. Must stay: the same arrays give the same bytes, whenever and wherever they
  // are written. Throws std::runtime_error where memory ends.
  std::string Bytes() const;

 private:
  struct Entry {
    std::string name;
    std::string npy;
  };

  void Add(std::string_view name, std::string_view type, const Shape& shape, std::size_t values,
           std::span<const std::byte> data);

  std::vector<Entry> entries_;
};

}  // namespace rockyard::replay
