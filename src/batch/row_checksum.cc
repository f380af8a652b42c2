#include "batch/row_checksum.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>

#include "batch/sqlite_database.h"

namespace rockyard::batch {

void RowChecksum::Restart(std::int64_t before) {
  sum_ = static_cast<std::uint32_t>(before);
  bytes_.clear();
}

RowChecksum& RowChecksum::Null() {
  bytes_ += 'N';
  return *this;
}

RowChecksum& RowChecksum::Integer(std::int64_t value) {
  Number('I', static_cast<std::uint64_t>(value));
  return *this;
}

RowChecksum& RowChecksum::Real(double value) {
  if (std::isnan(value)) return Null();
  Number('R', std::bit_cast<std::uint64_t>(value));
  return *this;
}

RowChecksum& RowChecksum::Text(std::string_view value) {
  Number('T', value.size());
  bytes_ += value;
  return *this;
}

RowChecksum& RowChecksum::Columns(const SqliteStatement& row, int columns) {
  for (int column = 0; column < columns; ++column) {
    switch (row.Type(column)) {
      case ValueType::kNull:
        Null();
        break;
      case ValueType::kInteger:
        Integer(row.Integer(column));
        break;
      case ValueType::kReal:
        Real(row.Real(column));
        break;
      case ValueType::kText:
        Text(row.Text(column));
        break;
    }
  }
  return *this;
}

std::int64_t RowChecksum::value() {
  const auto* bytes = reinterpret_cast<const Bytef*>(bytes_.data());
  sum_ = static_cast<std::uint32_t>(crc32_z(sum_, bytes, bytes_.size()));
  bytes_.clear();
  return sum_;
}

void RowChecksum::Number(char type, std::uint64_t bits) {
  std::array<char, 9> bytes{type};
  for (std::size_t i = 1; i < bytes.size(); ++i, bits >>= 8) bytes[i] = static_cast<char>(bits);
  bytes_.append(bytes.data(), bytes.size());
}

}  // namespace rockyard::batch
