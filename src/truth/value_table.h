/// @file
/// The values of one record: its own, or a row of a table that many records share. Stores that are
/// read put their records into one table, which takes less memory than a vector for each record. It
/// lies in memory alone: no file has its form, which may change as long as no bit of a value does.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rockyard::truth {

/// Rows of equally many values. Must stay: values keep their bits, as hashes go over them. Rows are
/// appended only. A block of kBlockRows rows holds each column as a list of its distinct values and
/// the place of each row's value in that list, or, where there are many distinct values, as the
/// values themselves: 0, 1, 2 or 8 bytes a value. Columns of a drive, many of which are constants
/// or counts, take about half of the memory so. The last, unfinished block holds the values
/// themselves. Reading is safe from any number of threads.
class ValueTable {
 public:
  static constexpr std::size_t kBlockRows = 4096;

  /// Makes an empty table of that many columns.
  explicit ValueTable(std::size_t columns) : columns_(columns) {}

  /// Return the size of the table.
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return blocks_.size() * kBlockRows + unfinished_; }

  /// Appends a row with a value for each column. A table holds fewer than 2^32 rows. Cost: about 20
  /// ns a value.
  void Append(std::span<const double> row);

  /// Returns one value. Requires row < rows() and column < columns().
  double At(std::size_t row, std::size_t column) const {
    const std::size_t block = row / kBlockRows;
    if (block == blocks_.size()) return plain_[(row % kBlockRows) * columns_ + column];
    return blocks_[block][column].At(row % kBlockRows);
  }

 private:
  /// One column of one block.
  struct Piece {
    std::vector<double> values;        ///< the distinct values, or one for each row
    std::vector<std::uint8_t> narrow;  ///< place of each row's value among up to 256, or empty
    std::vector<std::uint16_t> wide;   ///< place of each row's value among more, or empty
    double At(std::size_t row) const {
      if (!narrow.empty()) return values[narrow[row]];
      if (!wide.empty()) return values[wide[row]];
      return values.size() == 1 ? values.front() : values[row];
    }
  };
  static Piece Packed(std::vector<double> values);
  void FinishBlock();

  std::size_t columns_;
  std::vector<std::vector<Piece>> blocks_;
  std::vector<double> plain_;  ///< of the unfinished block, row by row
  std::size_t unfinished_ = 0;
};

/// The values of one record, which read like a vector of doubles. Whatever may change values copies
/// the row of the table first, the operator [] of values that are not const as well, so that the
/// table never changes. Any number of threads may read the same const values.
class RecordValues {
 public:
  RecordValues() = default;
  /// Takes values of its own.
  RecordValues(std::initializer_list<double> values) : own_(values) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a vector of doubles is what this stands for.
  RecordValues(std::vector<double> values) : own_(std::move(values)) {}
  /// Refers to row `row` of a table, which the values keep alive.
  RecordValues(std::shared_ptr<const ValueTable> table, std::size_t row)
      : table_(std::move(table)), row_(static_cast<std::uint32_t>(row)) {}

  std::size_t size() const { return table_ ? table_->columns() : own_.size(); }
  bool empty() const { return size() == 0; }

  /// Requires i < size(); at() throws std::out_of_range.
  double operator[](std::size_t i) const { return table_ ? table_->At(row_, i) : own_[i]; }
  double& operator[](std::size_t i) { return Own()[i]; }
  double at(std::size_t i) const {
    if (i >= size()) throw std::out_of_range("a record has no such value");
    return (*this)[i];
  }
  double front() const { return (*this)[0]; }
  double& back() { return Own().back(); }

  /// A forward iterator over the values, which it gives back by value.
  class ConstIterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = double;
    using difference_type = std::ptrdiff_t;
    using pointer = const double*;
    using reference = double;
    ConstIterator() = default;
    ConstIterator(const RecordValues& values, std::size_t at) : values_(&values), at_(at) {}
    double operator*() const { return (*values_)[at_]; }
    ConstIterator& operator++() {
      ++at_;
      return *this;
    }
    ConstIterator operator++(int) {
      const ConstIterator before = *this;
      ++at_;
      return before;
    }
    bool operator==(const ConstIterator&) const = default;

   private:
    const RecordValues* values_ = nullptr;
    std::size_t at_ = 0;
  };
  using value_type = double;
  using const_iterator = ConstIterator;
  ConstIterator begin() const { return {*this, 0}; }
  ConstIterator end() const { return {*this, size()}; }

  /// As those of a vector. push_back, reserve and assign copy a row of a table first.
  void push_back(double value) { Own().push_back(value); }
  void reserve(std::size_t size) { Own().reserve(size); }
  void assign(std::size_t size, double value) { Own().assign(size, value); }
  void clear() { *this = {}; }
  /// Copies the row and lets go of the table, which would else live as long as these values.
  void Detach() { Own(); }

  /// Compares value by value; NaN equals nothing.
  friend bool operator==(const RecordValues& a, const RecordValues& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::vector<double>& Own() {
    if (table_) *this = std::vector<double>(begin(), end());
    return own_;
  }

  std::vector<double> own_;  ///< empty where there is a table
  std::shared_ptr<const ValueTable> table_;
  std::uint32_t row_ = 0;
};

}  // namespace rockyard::truth
