/// @file
/// The values of many records in less memory than one vector each takes, and those of one record:
/// its own, or a row of a table that many share.
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

/// Rows of equally many values, which keep their bits. Rows are appended only. A block of
/// kBlockRows rows holds each column as its distinct values and, of each row, which of them it is;
/// plainly where there are many: 0, 1, 2 or 8 bytes a value. That is about half of what the columns
/// of a drive take plainly, as many of them are constants or counts; the last, unfinished block is
/// plain. Reading is safe from any number of threads.
class ValueTable {
 public:
  static constexpr std::size_t kBlockRows = 4096;

  /// An empty table of that many columns.
  explicit ValueTable(std::size_t columns) : columns_(columns) {}

  /// Return its size.
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return blocks_.size() * kBlockRows + unfinished_; }

  /// `row` has a value for each column. Fewer than 2^32 rows. Cost: about 20 ns a value.
  void Append(std::span<const double> row);

  /// Requires row < rows() and column < columns().
  double At(std::size_t row, std::size_t column) const {
    const std::size_t block = row / kBlockRows;
    if (block == blocks_.size()) return plain_[(row % kBlockRows) * columns_ + column];
    return blocks_[block][column].At(row % kBlockRows);
  }

 private:
  /// One column of one block.
  struct Piece {
    std::vector<double> values;        ///< distinct ones, or one for each row
    std::vector<std::uint8_t> narrow;  ///< which of up to 256, or empty
    std::vector<std::uint16_t> wide;   ///< which of more, or empty
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

/// Reads like a vector of doubles. What changes values of a row first copies it, and so does the
/// operator [] of a record that is not const: the table never changes. Two threads may read one.
class RecordValues {
 public:
  RecordValues() = default;
  /// Values of its own.
  RecordValues(std::initializer_list<double> values) : own_(values) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a vector of doubles is what this stands for.
  RecordValues(std::vector<double> values) : own_(std::move(values)) {}
  /// Row `row` of a table, which it keeps alive.
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

  /// Like those of a vector; each copies a row of a table first.
  void push_back(double value) { Own().push_back(value); }
  void reserve(std::size_t size) { Own().reserve(size); }
  void assign(std::size_t size, double value) { Own().assign(size, value); }
  void clear() { *this = {}; }
  /// Lets go of the table, which would live as long as this.
  void Detach() { Own(); }

  /// By value; NaN equals nothing.
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
