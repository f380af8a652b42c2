// Stores as programs before the checksums wrote them.
#pragma once

#include <string>

#include "batch/sqlite_database.h"

namespace rockyard::batch {

// Makes one of version 2 out of a store of version 3, and then changes it by `sql`: no checksum
// speaks against it.
inline void MakeOlder(const std::filesystem::path& store, const std::string& sql = "") {
  SqliteDatabase database(store, Access::kChange);
  database.Execute("DROP TABLE inventory; ALTER TABLE trials DROP COLUMN outcome_checksum");
  for (const char* table :
       {"meta", "cells", "columns", "builds", "trials", "infrastructure_faults"}) {
    database.Execute(std::string("ALTER TABLE ") + table + " DROP COLUMN row_checksum");
  }
  database.Execute("ALTER TABLE cells DROP COLUMN most_planned");
  database.Execute("UPDATE meta SET value = '2' WHERE key = 'schema_version'");
  database.Execute(sql);
}

}  // namespace rockyard::batch
