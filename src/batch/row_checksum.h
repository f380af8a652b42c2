// A checksum of the values of one row of a store.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rockyard::batch {

class SqliteStatement;

// CRC-32 (zlib) over the values in order, each one with its type: a letter, then eight
// little-endian bytes of a number, or the length and the bytes of a text. Numbers count by their
// bits; NaN counts as the NULL that SQLite makes of it.
//
// Finds accidents: one that changes a row goes unseen with probability 2^-32. No protection against
// anyone who changes the checksum as well.
class RowChecksum {
 public:
  // Begins with the checksum of what came before, or of nothing.
  explicit RowChecksum(std::int64_t before = 0) { Restart(before); }
  void Restart(std::int64_t before = 0);

  RowChecksum& Null();
  RowChecksum& Integer(std::int64_t value);
  RowChecksum& Real(double value);
  RowChecksum& Text(std::string_view value);
  // What stands in the first columns of a row that has been read.
  RowChecksum& Columns(const SqliteStatement& row, int columns);

  // Of all that came so far: 0 .. 2^32-1. More may follow.
  std::int64_t value();

 private:
  void Number(char type, std::uint64_t bits);

  std::uint32_t sum_ = 0;
  std::string bytes_;  // not yet in the sum
};

}  // namespace rockyard::batch
