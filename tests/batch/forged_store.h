// Stores with changes that no checksum speaks against, as of trials that gave something else.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "batch/sqlite_database.h"
#include "batch/store_rows.h"

namespace rockyard::batch {

// Changes a store by `sql` and computes all its checksums anew.
inline void Forge(const std::filesystem::path& store, const std::string& sql) {
  SqliteDatabase database(store, Access::kChange);
  database.Execute(sql);
  std::map<std::int64_t, std::int64_t> beginnings;  // of the rows of trials, by cell
  SqliteStatement cells = database.Prepare("SELECT cell, fingerprint, seed FROM cells");
  while (cells.Step()) {
    RowChecksum checksum;
    checksum.Text(cells.Text(1)).Integer(static_cast<std::int64_t>(std::stoull(cells.Text(2))));
    beginnings[cells.Integer(0)] = checksum.value();
  }
  for (const std::string table :
       {"meta", "cells", "columns", "builds", "trials", "infrastructure_faults"}) {
    const bool trials = table == "trials";
    SqliteStatement count =
        database.Prepare("SELECT count(*) FROM pragma_table_info('" + table + "')");
    count.Step();
    const int values = static_cast<int>(count.Integer(0)) - (trials ? 2 : 1);
    SqliteStatement rows = database.Prepare("SELECT *, rowid FROM " + table);
    SqliteStatement seal =
        database.Prepare("UPDATE " + table + " SET row_checksum = ? WHERE rowid = ?");
    TableTally tally;
    while (rows.Step()) {
      const std::int64_t row = rows.Integer(values + (trials ? 2 : 1));
      RowChecksum checksum(trials ? beginnings[rows.Integer(0)] : 0);
      if (trials) {
        const std::int64_t sum = RowChecksum(checksum).Columns(rows, 3).value();
        database.Prepare("UPDATE trials SET outcome_checksum = ? WHERE rowid = ?")
            .Bind(0, sum)
            .Bind(1, row)
            .Step();
      }
      tally.Add(checksum.Columns(rows, values).value());
      seal.Bind(0, checksum.value()).Bind(1, row).Step();
      seal.Reset();
    }
    SetInventory(database, table, tally);
  }
}

}  // namespace rockyard::batch
