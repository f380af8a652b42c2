// Part of an image row.
#pragma once

namespace rockyard::messages {

// First and last column, counted as in Camera.
struct ColumnRange {
  int first = 0;
  int last = -1;

  bool empty() const { return last < first; }
  bool Contains(double column_px) const { return column_px >= first && column_px <= last; }
};

// All columns of an image; of an even number, one more to the left of the axis than to the right.
inline ColumnRange ImageColumns(int columns) { return {-columns / 2, columns - columns / 2 - 1}; }

}  // namespace rockyard::messages
