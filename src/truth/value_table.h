// The values of many records in less memory than one vector each takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rockyard::truth {

// Rows of equally many values, which keep their bits. Rows are appended only. A block of kBlockRows
// rows holds each column as its distinct values and, of each row, which of them it is; plainly
// where there are many: 0, 1, 2 or 8 bytes a value. About 350 bytes a row of a drive, whose 80
// columns are 640; the last, unfinished block is plain. Reading is safe from any number of threads.
class ValueTable {
 public:
  static constexpr std::size_t kBlockRows = 4096;

  explicit ValueTable(std::size_t columns) : columns_(columns) {}

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return blocks_.size() * kBlockRows + unfinished_; }

  // `row` has a value for each column. Fewer than 2^32 rows. Cost: about 20 ns a value.
  void Append(std::span<const double> row);

  // Requires row < rows() and column < columns().
  double At(std::size_t row, std::size_t column) const {
    const std::size_t block = row / kBlockRows;
    if (block == blocks_.size()) return plain_[(row % kBlockRows) * columns_ + column];
    return blocks_[block][column].At(row % kBlockRows);
  }

 private:
  // One column of one block.
  struct Piece {
    std::vector<double> values;        // distinct ones, or one for each row
    std::vector<std::uint8_t> narrow;  // which of up to 256, or empty
    std::vector<std::uint16_t> wide;   // which of more, or empty
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
  std::vector<double> plain_;  // of the unfinished block, row by row
  std::size_t unfinished_ = 0;
};

}  // namespace rockyard::truth
