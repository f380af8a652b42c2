// Part of an image row.
#pragma once

namespace rockyard::messages {

// First and last column, counted as in StripeCamera.
struct ColumnRange {
  int first = 0;
  int last = -1;

  bool empty() const { return last < first; }
  bool Contains(double column_px) const { return column_px >= first && column_px <= last; }
};

}  // namespace rockyard::messages
