#include "batch/row_checksum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "batch/sqlite_database.h"
#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

// Of zlib.crc32(b"I" + pack("<q", 7) + b"R" + pack("<d", -0.0) + b"N" + b"T" + pack("<Q", 6) +
// "rock ä".encode()) in Python.
TEST(RowChecksum, IsTheCrc32OfTypesAndBytes) {
  RowChecksum checksum;
  checksum.Integer(7).Real(-0.0).Null().Text("rock \xc3\xa4");
  EXPECT_EQ(checksum.value(), 3763823285);
}

TEST(RowChecksum, GoesOnFromWhatCameBefore) {
  RowChecksum whole;
  whole.Integer(1).Text("a").Real(2.5);
  RowChecksum piecewise;
  piecewise.Integer(1);
  const std::int64_t first = piecewise.value();
  EXPECT_EQ(piecewise.Text("a").Real(2.5).value(), whole.value());
  piecewise.Restart(first);
  EXPECT_EQ(piecewise.Text("a").Real(2.5).value(), whole.value());
  piecewise.Restart();
  EXPECT_NE(piecewise.Text("a").Real(2.5).value(), whole.value());
}

TEST(RowChecksum, TellsTypesSignsAndLimitsOfTextsApart) {
  const auto sum = [](auto fill) {
    RowChecksum checksum;
    fill(checksum);
    return checksum.value();
  };
  EXPECT_NE(sum([](auto& c) { c.Integer(0); }), sum([](auto& c) { c.Real(0.0); }));
  EXPECT_NE(sum([](auto& c) { c.Real(0.0); }), sum([](auto& c) { c.Real(-0.0); }));
  EXPECT_NE(sum([](auto& c) { c.Real(1.0); }),
            sum([](auto& c) { c.Real(std::nextafter(1.0, 2.0)); }));
  EXPECT_NE(sum([](auto& c) { c.Text("ab").Text("c"); }),
            sum([](auto& c) { c.Text("a").Text("bc"); }));
  EXPECT_NE(sum([](auto& c) { c.Text(""); }), sum([](auto& c) { c.Null(); }));
  // SQLite keeps NaN as NULL.
  EXPECT_EQ(sum([](auto& c) { c.Real(std::numeric_limits<double>::quiet_NaN()); }),
            sum([](auto& c) { c.Null(); }));
}

TEST(RowChecksum, OfARowIsThatOfItsValues) {
  const core::TestFolder folder;
  const SqliteDatabase database(folder.path() / "a.sqlite", Access::kCreate);
  SqliteStatement row = database.Prepare("SELECT 7, -0.5, NULL, 'rock', 'not counted'");
  ASSERT_TRUE(row.Step());
  RowChecksum values;
  values.Integer(7).Real(-0.5).Null().Text("rock");
  RowChecksum columns;
  EXPECT_EQ(columns.Columns(row, 4).value(), values.value());
}

}  // namespace
}  // namespace rockyard::batch
