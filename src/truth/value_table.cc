#include "truth/value_table.h"

#include <bit>
#include <unordered_map>
#include <utility>

#include "core/check.h"

namespace rockyard::truth {
namespace {

// Most distinct values that are kept as a list. With 2 bytes a row a list pays as long as it has
// fewer entries than three quarters of the block; columns with more than a quarter seldom stay
// below that.
constexpr std::size_t kMostDistinct = ValueTable::kBlockRows / 4;
constexpr std::size_t kMostNarrow = 256;  // values that one byte tells apart

// The distinct values of a column in the order in which they come first, and the place of each
// value among them. Values are told apart by their bits, as zeros of either sign and NaNs have to
// come back. `values` is empty where there are more than kMostDistinct.
struct Distinct {
  std::vector<double> values;
  std::vector<std::uint16_t> which;
};

Distinct DistinctOf(std::span<const double> values) {
  std::unordered_map<std::uint64_t, std::uint16_t> known;
  Distinct distinct;
  for (const double value : values) {
    const auto number = static_cast<std::uint16_t>(distinct.values.size());
    const auto [at, fresh] = known.try_emplace(std::bit_cast<std::uint64_t>(value), number);
    if (fresh) distinct.values.push_back(value);
    if (distinct.values.size() > kMostDistinct) return {};
    distinct.which.push_back(at->second);
  }
  return distinct;
}

}  // namespace

ValueTable::Piece ValueTable::Packed(std::vector<double> values) {
  Distinct distinct = DistinctOf(values);
  if (distinct.values.empty()) return {.values = std::move(values), .narrow = {}, .wide = {}};
  Piece piece{.values = {}, .narrow = {}, .wide = {}};
  if (distinct.values.size() > kMostNarrow) {
    piece.wide = std::move(distinct.which);
  } else if (distinct.values.size() > 1) {
    for (const std::uint16_t which : distinct.which) {
      piece.narrow.push_back(static_cast<std::uint8_t>(which));
    }
  }
  piece.values = std::move(distinct.values);
  piece.values.shrink_to_fit();
  piece.narrow.shrink_to_fit();
  piece.wide.shrink_to_fit();
  return piece;
}

void ValueTable::Append(std::span<const double> row) {
  EXPECT(row.size() == columns_);
  plain_.insert(plain_.end(), row.begin(), row.end());
  if (++unfinished_ == kBlockRows) FinishBlock();
}

void ValueTable::FinishBlock() {
  std::vector<Piece>& block = blocks_.emplace_back();
  block.reserve(columns_);
  for (std::size_t column = 0; column < columns_; ++column) {
    std::vector<double> values(kBlockRows);
    for (std::size_t row = 0; row < kBlockRows; ++row)
      values[row] = plain_[row * columns_ + column];
    block.push_back(Packed(std::move(values)));
  }
  plain_.clear();
  unfinished_ = 0;
}

}  // namespace rockyard::truth
