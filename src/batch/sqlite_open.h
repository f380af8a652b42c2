// How the file of a store is opened, above all by those who only read it.
#pragma once

#include <filesystem>
#include <memory>

struct sqlite3;

namespace rockyard::batch {

struct CloseSqlite {
  void operator()(sqlite3* database) const;
};
using SqliteHandle = std::unique_ptr<sqlite3, CloseSqlite>;

// A connection, and SQLite's code of its first statement: where that failed, the connection knows
// why.
struct OpenedSqlite {
  SqliteHandle database;
  int code = 0;
};

// `flags`: SQLITE_OPEN_*.
OpenedSqlite OpenSqlite(const std::filesystem::path& path, int flags);

// Opens a store to read it, in such a way that no file is left beside it and no right to write
// there is needed.
//
// A store that ended cleanly is one file, and read as it lies. One that is being written has its
// log and the shared memory of that log, through which SQLite reads the last commit. Everything
// else is read from a private copy: a store whose run was killed, where the reader may not write
// the shared memory or the disk has no room for it; and one without shared memory, which SQLite
// would make and leave there. The copy is taken with its logs, so that it is the last commit, in
// the folder for temporary files; it is gone from there when this returns and takes room until the
// connection is closed.
//
// Throws StoreError: kFull, kOpenFiles or kUnwritable where the copy cannot be made, kInUse where
// the store changes all the time meanwhile.
OpenedSqlite OpenToRead(const std::filesystem::path& path);

}  // namespace rockyard::batch
