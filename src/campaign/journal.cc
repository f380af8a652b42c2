#include "campaign/journal.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "batch/communicator.h"
#include "batch/sqlite_database.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

enum Entry : std::int64_t { kNote, kProblem, kFolder, kTrials };

void ReadEntry(batch::PacketReader& packet, Account& account) {
  switch (packet.Integer()) {
    case kNote: {
      const auto kind = static_cast<NoteKind>(packet.Integer());
      account.notes.push_back({kind, packet.Text()});
      break;
    }
    case kProblem: {
      core::Problem problem;
      for (std::string* text : {&problem.path, &problem.reason, &problem.suggestion}) {
        *text = packet.Text();
      }
      account.problems.push_back(std::move(problem));
      break;
    }
    case kFolder:
      account.folder = packet.Text();
      break;
    case kTrials: {
      TrialCounts counts;
      for (std::int64_t* count : {&counts.planned, &counts.finished, &counts.faults}) {
        *count = packet.Integer();
      }
      account.trials = counts;
      break;
    }
    default:
      throw std::runtime_error("no entry of a journal");
  }
}

// Returns whether a name cannot be used as it is, whatever the machine has room for.
bool IsOfTheName(const std::error_code& code) {
  return code == std::errc::filename_too_long || code == std::errc::not_a_directory ||
         code == std::errc::no_such_file_or_directory || code == std::errc::permission_denied ||
         code == std::errc::too_many_symbolic_link_levels;
}

}  // namespace

Journal::Journal(const Observer& observer)
    : observer_(observer), file_(memfd_create("rockyard-journal", MFD_CLOEXEC)) {}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

void Journal::Fail(const std::vector<core::Problem>& problems) {
  if (problems.empty()) return;
  batch::PacketWriter packet;
  for (const core::Problem& problem : problems) {
    packet.Integer(kProblem).Text(problem.path).Text(problem.reason).Text(problem.suggestion);
  }
  Append(packet.bytes());
  if (observer_.problems) observer_.problems(problems);
}

void Journal::SetFolder(const std::filesystem::path& folder) {
  Append(batch::PacketWriter().Integer(kFolder).Text(folder.string()).bytes());
}

void Journal::SetTrials(const TrialCounts& trials) {
  batch::PacketWriter packet;
  packet.Integer(kTrials).Integer(trials.planned).Integer(trials.finished).Integer(trials.faults);
  Append(packet.bytes());
}

Account Journal::Read() const {
  const off_t size = lseek(file_, 0, SEEK_END);
  std::string bytes(size < 0 ? 0 : static_cast<std::size_t>(size), '\0');
  const ssize_t read = pread(file_, bytes.data(), bytes.size(), 0);
  bytes.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
  Account account;
  batch::PacketReader packet(bytes);
  try {
    while (!packet.AtEnd()) ReadEntry(packet, account);
  } catch (const std::runtime_error&) {
    // A process was killed while it wrote its entry.
  }
  return account;
}

// Processes that were forked share the place at which is written: each goes on behind the others.
// What is told counts; an account that the machine has no memory for is only shorter.
// NOLINTNEXTLINE(readability-make-member-function-const): it changes what Read gives
void Journal::Append(const std::string& bytes) {
  const char* at = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    const ssize_t written = write(file_, at, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += written;
    left -= static_cast<std::size_t>(written);
  }
}

void Journal::Write(const Note& note) {
  batch::PacketWriter packet;
  packet.Integer(kNote).Integer(static_cast<std::int64_t>(note.kind)).Text(note.text);
  Append(packet.bytes());
  if (observer_.note) observer_.note(note);
}

Outcome Guarded(Journal& journal, const std::function<Outcome()>& action) {
  try {
    return action();
  } catch (const batch::StoreError& error) {
    journal.Fail(error.problems());
    return batch::IsOfTheMachine(error.problem()) ? Outcome::kFailed : Outcome::kBadInput;
  } catch (const core::MachineError& error) {
    journal.Fail(error.problems());
    return Outcome::kFailed;
  } catch (const core::UserError& error) {
    journal.Fail(error.problems());
    return Outcome::kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    journal.Fail({{error.path1().string(), error.code().message(), "name another file or folder"}});
    return IsOfTheName(error.code()) ? Outcome::kBadInput : Outcome::kFailed;
  } catch (const std::bad_alloc&) {
    journal.Fail({{"memory", "is exhausted", "ask for fewer trials, threads or rocks"}});
  } catch (const std::exception& error) {
    journal.Fail({{"rockyard", error.what(), ""}});
  } catch (...) {
    journal.Fail({{"rockyard", "failed for an unknown reason", ""}});
  }
  return Outcome::kFailed;
}

WorkResult Recorded(const Observer& observer, const std::function<Outcome(Journal&)>& work) {
  Journal journal(observer);
  const Outcome outcome = Guarded(journal, [&] { return work(journal); });
  return {journal.Read(), outcome};
}

}  // namespace rockyard::campaign
