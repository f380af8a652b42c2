// A folder that a command fills with files: claimed before the work, whole after it. The commands
// stereo, vo, render, calibrate and cylinder fill one; other commands check files that they are
// asked to write, and quote words of commands, by it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"

namespace rockyard::batch {
class EmptyFolders;
class FolderClaim;
}  // namespace rockyard::batch

namespace rockyard::report {
class AtomicFile;
}  // namespace rockyard::report

namespace rockyard::campaign {

// A file that was written.
struct OutputFile {
  std::string what;
  std::filesystem::path path;
};

// Returns the names of files by what they are, as the JSON of commands lists them.
core::JsonValue FilesJson(std::span<const OutputFile> files);

// What to do where the folder holds something. In each case, what the same command has finished is
// set aside: files and folders of the names that are needed go to old-1 (or -2, ...) in the folder.
enum class ExistingFiles {
  kRefuse,    // refuses anything else
  kSetAside,  // sets aside whatever there is
  kResume,    // goes on with what the same request has begun there; begins where nothing is there
};

// What a command knows of its folder before it works.
struct OutputPlan {
  std::string command;                        // "stereo"
  std::vector<std::string> names;             // of all that it may write, in the folder itself
  std::vector<std::filesystem::path> inputs;  // files and folders that it reads; "": none
  // For a command that writes as it works: what has to be the same to go on. Else null.
  core::JsonValue request = {};
};

// The file by which a folder says which command of which build made what it holds, and whether that
// is all: {"command", "program", "finished", "request"}. Must stay: its name and members, as later
// programs read it before they touch the folder.
inline constexpr const char* kMadeByFile = "made_by.json";

// The folder of a command while the command works. Nothing is changed before the first WriteNow, or
// Finish: a folder that was made for work that throws earlier is gone again. Every failure of the
// machine is a core::MachineError or a batch::StoreError of that kind, and so is a lack of rights
// once something was changed.
class OutputFolder {
 public:
  // Makes the folder and claims it (batch::FolderClaim). Throws core::UserError where the folder
  // holds what `existing` refuses (for kResume what another request or none has begun), where it
  // holds an input by one of the names, or where it is an input itself.
  OutputFolder(std::filesystem::path path, ExistingFiles existing, OutputPlan plan);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Stages a file, which Finish brings to its place, and adds it to files().
  void Write(std::string_view what, std::string_view name, std::string_view bytes);

  // Writes a file that is in its place at once; `name` may have a folder of its own before it.
  void WriteNow(std::string_view name, std::string_view bytes);

  // Adds to files() what WriteNow or the command itself has written.
  void Tell(std::string_view what, std::string_view name) {
    files_.push_back({std::string(what), path_ / name});
  }

  // Returns where a file is, or is to be, that the command itself writes; after Begin.
  std::filesystem::path PathOf(std::string_view name) const { return path_ / name; }
  // Does what WriteNow does before it writes the first file. Later calls do nothing.
  void Begin();

  // Returns whether the work of an earlier call is gone on with.
  bool resumes() const { return resumes_; }

  // Brings all staged files to their places. Call it once. `finished`: whether the work is whole;
  // false where somebody asked for an end.
  void Finish(bool finished = true);

  const std::vector<OutputFile>& files() const { return files_; }

 private:
  void RefuseInputs() const;
  void ReadContents(ExistingFiles existing);
  void RequireSame(const core::JsonValue& maker) const;
  void SetAside();
  // Calls `action`. Where something was changed before, a failure of it is the machine's.
  void Try(const std::function<void()>& action) const;
  // Tries an `action` that changes the folder.
  void Change(const std::function<void()>& action);
  void CommitAll();
  void Stage(std::string_view name, std::string_view bytes);
  std::string Maker(bool finished) const;

  std::filesystem::path path_;
  OutputPlan plan_;
  std::unique_ptr<batch::FolderClaim> claim_;
  std::unique_ptr<batch::EmptyFolders> unused_;
  std::vector<std::unique_ptr<report::AtomicFile>> staged_;
  std::vector<OutputFile> files_;
  bool set_aside_ = false;  // before anything is written
  bool resumes_ = false;
  bool begun_ = false;
  bool changed_ = false;
};

// Throws core::UserError where a command cannot be meant to write `file`: it is a folder, a device
// or a pipe, a file of the run that lies in its folder, or in a folder that does not exist or
// cannot be written to. Call it before long work rather than after it; an empty name passes.
// `option` is the one to blame, such as "--out". Such files are written by
// report::WriteFileAtomically.
void CheckOutputFile(std::string_view option, const std::string& file);

// Throws core::UserError where the name of `file` does not end in `extension` (".html"), by which
// other programs know what is in it; an empty name passes.
void CheckExtension(std::string_view option, const std::string& file, std::string_view extension);

struct NamedFile {
  std::string option;
  std::string file;
};

// Throws core::UserError where two of a command's files are the same; empty names are none.
void CheckDistinct(std::span<const NamedFile> files);

// Returns a word as a POSIX shell reads it, for commands that people can copy: as it is where that
// is safe, else in single quotes. A word that a terminal would not show as it is
// (report::Printable) is written with octal numbers of its bytes ($'\342\200\256'), which bash,
// zsh and POSIX shells since 2024 read.
std::string ShellWord(std::string_view word);

// Returns a file or folder as a ShellWord that no command takes for an option: "./-x" for "-x".
std::string ShellPath(std::string_view path);

}  // namespace rockyard::campaign
