// What comes up in a piece of work: told at once, and kept for whoever asked for it. All work of
// this folder that returns a WorkResult has a journal; the command line turns what commands throw
// into one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/work.h"
#include "core/error.h"

namespace rockyard::campaign {

// Notes, problems and counts of a piece of work, kept in memory that processes share: what a forked
// worker writes is there when the worker has ended, however it did. Not for several threads at
// once. Limit: where a process is killed while it writes an entry, that entry and those after it
// are lost.
class Journal {
 public:
  // `observer` must outlive the journal. Where the machine has no memory the account stays empty.
  explicit Journal(const Observer& observer);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void Remark(const std::string& text) { Write({NoteKind::kRemark, text}); }
  void Warn(const std::string& text) { Write({NoteKind::kWarning, text}); }
  void Fail(const std::vector<core::Problem>& problems);
  // Keeps folder and counts for the account; the observer is not told. The last of each counts.
  void SetFolder(const std::filesystem::path& folder);
  void SetTrials(const TrialCounts& trials);

  Account Read() const;

 private:
  void Write(const Note& note);
  void Append(const std::string& bytes);

  const Observer& observer_;
  int file_;
};

// Returns what `action` returns. An exception out of it goes into the journal and becomes an
// outcome: kFailed where the machine failed (core::MachineError, or a batch::StoreError for which
// batch::IsOfTheMachine holds), kBadInput for any other core::UserError and for a file name that
// cannot be used, kFailed for anything else.
Outcome Guarded(Journal& journal, const std::function<Outcome()>& action);

// Calls `work` with a journal of its own, guarded as by Guarded, and returns the outcome with the
// account.
WorkResult Recorded(const Observer& observer, const std::function<Outcome(Journal&)>& work);

}  // namespace rockyard::campaign
