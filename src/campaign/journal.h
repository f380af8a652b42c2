// What comes up in a piece of work: told at once, and kept for whoever asked for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/work.h"
#include "core/error.h"

namespace rockyard::campaign {

// Kept in memory that processes share: what a forked worker writes is there when it has ended,
// however it did. Not for several threads at once. Limit: an entry that a process is killed over
// is lost with those after it.
class Journal {
 public:
  // `observer` must outlive this. Where the machine has no memory the account stays empty.
  explicit Journal(const Observer& observer);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void Remark(const std::string& text) { Write({NoteKind::kRemark, text}); }
  void Warn(const std::string& text) { Write({NoteKind::kWarning, text}); }
  void Fail(const std::vector<core::Problem>& problems);
  // Not told: for the account alone. The last of each counts.
  void SetFolder(const std::filesystem::path& folder);
  void SetTrials(const TrialCounts& trials);

  Account Read() const;

 private:
  void Write(const Note& note);
  void Append(const std::string& bytes);

  const Observer& observer_;
  int file_;
};

// What `action` returns. An exception out of it fails in the journal: kBadInput for
// core::UserError, kFailed for anything else, and where the machine failed: core::MachineError, and
// a batch::StoreError of a full disk or too many open files.
Outcome Guarded(Journal& journal, const std::function<Outcome()>& action);

// The same with a journal of its own.
WorkResult Recorded(const Observer& observer, const std::function<Outcome(Journal&)>& work);

}  // namespace rockyard::campaign
