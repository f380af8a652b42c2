#include "campaign/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "campaign/open_run.h"
#include "core/check.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/provenance.h"
#include "report/atomic_file.h"
#include "report/line_text.h"
#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

bool IsThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

bool IsNull(const core::JsonValue& value) { return value.Is(core::JsonValue::Type::kNull); }

std::string TextOf(const core::JsonValue& object, std::string_view key) {
  const core::JsonValue* value = object.Find(key);
  return value != nullptr && value->Is(core::JsonValue::Type::kText) ? value->text() : "";
}

// Makes paths canonical, and each folder once: thousands of images share a few.
class CanonicalPaths {
 public:
  fs::path Of(const fs::path& path) {
    if (fs::is_symlink(path) || !path.has_filename()) return fs::weakly_canonical(path);
    const auto [known, is_new] = folders_.try_emplace(path.parent_path());
    if (is_new) known->second = fs::weakly_canonical(fs::absolute(path).parent_path());
    return known->second / path.filename();
  }

 private:
  std::map<fs::path, fs::path> folders_;
};

// Returns the keys by which two requests differ.
std::string DifferenceOf(const core::JsonValue& a, const core::JsonValue& b) {
  std::string keys;
  for (const core::JsonMember& member : b.members()) {
    const core::JsonValue* other = a.Find(member.key);
    if (other != nullptr && core::DumpJson(*other) == core::DumpJson(member.value)) continue;
    keys += (keys.empty() ? "" : ", ") + member.key;
  }
  return keys;
}

}  // namespace

core::JsonValue FilesJson(std::span<const OutputFile> files) {
  core::JsonValue json = core::JsonValue::Object();
  for (const OutputFile& file : files) {
    json.Set(file.what, core::JsonValue(file.path.filename().string()));
  }
  return json;
}

OutputFolder::OutputFolder(fs::path path, ExistingFiles existing, OutputPlan plan)
    : path_(std::move(path)), plan_(std::move(plan)) {
  plan_.names.emplace_back(kMadeByFile);
  RefuseInputs();
  ReadContents(existing);
  claim_ = std::make_unique<batch::FolderClaim>(path_);
  unused_ = std::make_unique<batch::EmptyFolders>(claim_->made());
}

OutputFolder::~OutputFolder() = default;

void OutputFolder::RefuseInputs() const {
  const fs::path folder = fs::weakly_canonical(path_);
  CanonicalPaths canonical;
  for (const fs::path& input : plan_.inputs) {
    if (input.empty()) continue;
    const fs::path inside = canonical.Of(input).lexically_relative(folder);
    const fs::path first = inside.empty() ? fs::path() : *inside.begin();
    const bool is_written = first == "." || std::find(plan_.names.begin(), plan_.names.end(),
                                                      first) != plan_.names.end();
    if (!is_written) continue;
    throw core::UserError(
        "--out",
        first == "." ? fmt::format("is {}, which is read", path_.string())
                     : fmt::format("would replace {}, which is read", (path_ / inside).string()),
        "name another folder");
  }
}

void OutputFolder::ReadContents(ExistingFiles existing) {
  if (!fs::is_directory(path_)) return;  // a file is refused by the claim
  const auto left_by_the_killed = [&](const fs::path& entry) {
    return core::IsTemporaryOf(batch::StorePath(path_), entry) ||  // of the claim
           std::any_of(plan_.names.begin(), plan_.names.end(),
                       [&](const auto& name) { return core::IsTemporaryOf(name, entry); });
  };
  const bool holds_something = std::any_of(
      fs::directory_iterator(path_), fs::directory_iterator(),
      [&](const fs::directory_entry& entry) { return !left_by_the_killed(entry.path()); });
  set_aside_ = holds_something && existing == ExistingFiles::kSetAside;
  if (!holds_something || set_aside_) return;
  if (!IsThere(path_ / kMadeByFile)) {
    throw core::UserError(
        path_.string(),
        fmt::format("is not empty and holds nothing of `rockyard {}`", plan_.command),
        existing == ExistingFiles::kResume
            ? "choose another folder with --out, or write into it with --force in place of "
              "--resume, which sets files of the names it needs aside"
            : "choose another folder with --out, or write into it with --force, which sets files "
              "of the names it needs aside");
  }
  const core::JsonValue maker = core::LoadJsonFileAlone(path_ / kMadeByFile);
  if (existing == ExistingFiles::kResume) {
    RequireSame(maker);
    resumes_ = true;
    return;
  }
  const std::string command = TextOf(maker, "command");
  const core::JsonValue* finished = maker.Find("finished");
  const bool is_whole =
      finished != nullptr && finished->Is(core::JsonValue::Type::kBoolean) && finished->boolean();
  set_aside_ = command == plan_.command && is_whole;
  if (set_aside_) return;
  const bool may_resume = command == plan_.command && !IsNull(plan_.request);
  throw core::UserError(
      path_.string(),
      fmt::format("holds what `rockyard {}` {}", command,
                  is_whole ? "made" : "began and did not finish"),
      fmt::format("{}set it aside by --force (nothing is deleted), or choose another folder with "
                  "--out",
                  may_resume ? "go on with it by --resume, " : ""));
}

void OutputFolder::RequireSame(const core::JsonValue& maker) const {
  const auto refuse = [&](const std::string& reason, const std::string& suggestion) {
    throw core::UserError(path_.string(), reason, suggestion);
  };
  const std::string command = TextOf(maker, "command");
  if (command != plan_.command) {
    refuse(fmt::format("holds what `rockyard {}` made", command), "choose another folder");
  }
  const std::string program = TextOf(maker, "program");
  if (program != core::VersionLine()) {
    refuse(fmt::format("was begun by {}, this is {}", program, core::VersionLine()),
           "use the program that began it, or set it aside by --force in place of --resume");
  }
  const core::JsonValue* request = maker.Find("request");
  const std::string differs =
      DifferenceOf(request == nullptr ? core::JsonValue::Object() : *request, plan_.request);
  if (!differs.empty()) {
    refuse("was begun with other " + differs,
           "give what it was begun with, or set it aside by --force in place of --resume");
  }
}

void OutputFolder::SetAside() {
  fs::path aside;
  for (int number = 1; aside.empty() || IsThere(aside); ++number) {
    aside = path_ / fmt::format("old-{}", number);
  }
  std::error_code error;
  for (const std::string& name : plan_.names) {
    if (!IsThere(path_ / name)) continue;
    Change([&] {
      fs::create_directory(aside, error);
      if (!error) fs::rename(path_ / name, aside / name, error);
      if (!error) return;
      std::error_code ignored;
      fs::remove(aside, ignored);  // where it is empty
      core::FailOnDisk(path_ / name, "cannot be set aside", error);
    });
  }
  if (IsThere(aside)) files_.push_back({"what was there", aside});
}

std::string OutputFolder::Maker(bool finished) const {
  core::JsonValue maker = report::ObjectTree("command", plan_.command, "program",
                                             core::VersionLine(), "finished", finished);
  if (!IsNull(plan_.request)) maker.Set("request", plan_.request);
  return core::DumpJson(maker);
}

void OutputFolder::Try(const std::function<void()>& action) const {
  try {
    action();
  } catch (const core::UserError& error) {
    if (!changed_ || core::IsMachineFailure(error)) throw;
    throw core::MachineError(error.problems());
  }
}

void OutputFolder::Change(const std::function<void()>& action) {
  Try(action);
  changed_ = true;
}

void OutputFolder::Begin() {
  if (std::exchange(begun_, true)) return;
  if (set_aside_) SetAside();
  if (!IsNull(plan_.request)) {
    Change([&] { report::WriteFileAtomically(path_ / kMadeByFile, Maker(false)); });
  }
}

void OutputFolder::Write(std::string_view what, std::string_view name, std::string_view bytes) {
  Stage(name, bytes);
  Tell(what, name);
}

void OutputFolder::Stage(std::string_view name, std::string_view bytes) {
  EXPECT(std::find(plan_.names.begin(), plan_.names.end(), name) != plan_.names.end());
  Try([&] {
    staged_.push_back(std::make_unique<report::AtomicFile>(path_ / name));
    staged_.back()->Write(bytes);
    staged_.back()->Sync();
  });
}

void OutputFolder::WriteNow(std::string_view name, std::string_view bytes) {
  const fs::path file = name;
  EXPECT(std::find(plan_.names.begin(), plan_.names.end(), *file.begin()) != plan_.names.end());
  Begin();
  Change([&] {
    std::error_code error;
    if (file.has_parent_path()) fs::create_directory(path_ / file.parent_path(), error);
    if (error) core::FailOnDisk(path_ / file.parent_path(), "cannot be made", error);
    report::WriteFileAtomically(path_ / file, bytes);
  });
}

void OutputFolder::Finish(bool finished) {
  Begin();
  Change([&] {
    // Must be the last to be committed: only then does the folder say that it is whole.
    Stage(kMadeByFile, Maker(finished));
    CommitAll();
  });
  staged_.clear();
}

// Commits all staged files or none. What had their names was set aside, or belongs to the work that
// is gone on with.
void OutputFolder::CommitAll() {
  std::size_t committed = 0;
  try {
    for (; committed < staged_.size(); ++committed) staged_[committed]->Commit();
  } catch (...) {
    std::error_code ignored;
    while (committed > 0) fs::remove(staged_[--committed]->path(), ignored);
    throw;
  }
}

void CheckOutputFile(std::string_view option, const std::string& file) {
  if (file.empty()) return;
  std::error_code error;
  if (!fs::is_directory(fs::absolute(file, error).parent_path(), error)) {
    throw core::UserError(std::string(option), "is in a folder that does not exist: " + file,
                          "make the folder first");
  }
  if (fs::is_directory(file, error)) {
    throw core::UserError(std::string(option), "is a folder: " + file, "name a file");
  }
  // A device or a pipe would be replaced by the file rather than written to.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw core::UserError(std::string(option), "is there and is no regular file: " + file,
                          "name a file");
  }
  if (IsRunFile(fs::path(file).filename()) &&
      batch::HoldsStore(fs::absolute(file, error).parent_path())) {
    throw core::UserError(std::string(option), "is a file of the run itself: " + file,
                          "choose another name");
  }
  if (!core::HasRoomForTemporary(file)) {
    throw core::UserError(std::string(option), "has too long a name: " + file, "shorten it");
  }
  // Files are made beside their place and renamed, so that the folder is what counts.
  if (access(fs::absolute(file, error).parent_path().c_str(), W_OK) != 0) {
    throw core::UserError(std::string(option), "is in a folder that cannot be written to: " + file,
                          "check its permissions, or name a file elsewhere");
  }
}

void CheckExtension(std::string_view option, const std::string& file, std::string_view extension) {
  if (file.empty() || fs::path(file).extension() == extension) return;
  throw core::UserError(std::string(option), fmt::format("does not end in {}: {}", extension, file),
                        fmt::format("name a file such as report{}", extension));
}

void CheckDistinct(std::span<const NamedFile> files) {
  const auto normal = [](const NamedFile& file) { return fs::path(file.file).lexically_normal(); };
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].file.empty() || normal(files[i]) != normal(files[j])) continue;
      throw core::UserError(files[i].option,
                            "is the same file as " + files[j].option + ": " + files[i].file,
                            "name another file");
    }
  }
}

namespace {

std::string InNumbers(std::string_view word) {
  std::string quoted = "$'";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7f && c != '\'' && c != '\\';
    quoted += plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return quoted + '\'';
}

}  // namespace

std::string ShellWord(std::string_view word) {
  constexpr std::string_view kSafe = "-_./=:,+@%";
  const bool safe = !word.empty() && std::all_of(word.begin(), word.end(), [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x80 && (std::isalnum(byte) != 0 || kSafe.find(c) != std::string_view::npos);
  });
  if (safe) return std::string(word);
  if (report::Printable(word) != word) return InNumbers(word);
  std::string quoted(1, '\'');
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + '\'';
}

std::string ShellPath(std::string_view path) {
  return ShellWord((path.starts_with('-') ? "./" : "") + std::string(path));
}

}  // namespace rockyard::campaign
