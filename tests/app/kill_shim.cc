// Preloaded into the command: ends the process by SIGKILL before its Nth durable call, one of those
// that change what a later process finds on the disk, or has a full disk or no rights from that
// call on. What is to be brought to the disk at once stays in the memory of the machine, which
// outlives processes: that makes hundreds of runs fast.
//
// ROCKYARD_KILL_AT    N, counted from 1 over the process and those that it forks; 0: none
// ROCKYARD_FULL_AT    the same: this call and those after it that need room fail with ENOSPC
// ROCKYARD_DENIED_AT  the same: those that give something a name fail with EACCES
// ROCKYARD_KILL_MARK  a file that is made where that many calls came
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace {

// Shared with forked processes, so that only one of them dies, and only once.
std::atomic<long>* Counter() {
  static auto* const counter = static_cast<std::atomic<long>*>(
      mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
           -1, 0));
  return counter;
}

// Made before main, and so before any fork.
[[gnu::constructor]] void MakeCounter() { *Counter() = 0; }

long Wanted(const char* name) {
  const char* const at = std::getenv(name);
  return at == nullptr ? 0 : std::atol(at);
}

void LeaveMark() {
  static const char* const mark = std::getenv("ROCKYARD_KILL_MARK");
  syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT, 0600);
}

// The number of this call.
long CountCall() {
  static const long kill_at = Wanted("ROCKYARD_KILL_AT");
  const long call = ++*Counter();
  if (call == kill_at) {
    LeaveMark();
    syscall(SYS_kill, getpid(), SIGKILL);
  }
  return call;
}

// Whether that call fails: `at` is where it began, 0: never.
bool Fails(long call, long at, int error) {
  if (at == 0 || call < at) return false;
  LeaveMark();
  errno = error;
  return true;
}

bool LacksRoom(long call) {
  static const long at = Wanted("ROCKYARD_FULL_AT");
  return Fails(call, at, ENOSPC);
}

bool LacksRights(long call) {
  static const long at = Wanted("ROCKYARD_DENIED_AT");
  return Fails(call, at, EACCES);
}

// Counts a call that needs room: whether there is none by now.
bool IsFull() { return LacksRoom(CountCall()); }

// Counts a call that makes a file or a folder: whether it cannot by now.
bool CannotMake() {
  const long call = CountCall();
  return LacksRoom(call) || LacksRights(call);
}

template <typename Function>
Function* Next(Function* /*of this type*/, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// Of files, not of pipes, terminals and what a test has redirected.
bool IsOnDisk(int file) {
  struct stat status {};
  return file > STDERR_FILENO && fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

mode_t ModeOf(int flags, va_list& arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  if ((flags & O_CREAT) != 0 && CannotMake()) return -1;
  return Next(&open, "open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  if ((flags & O_CREAT) != 0 && CannotMake()) return -1;
  return Next(&open64, "open64")(path, flags, mode);
}

int fsync(int file) { return IsFull() || file < 0 ? -1 : 0; }

int fdatasync(int file) { return IsFull() || file < 0 ? -1 : 0; }

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  if (IsFull()) return -1;
  return Next(&pwrite, "pwrite")(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  if (IsFull()) return -1;
  return Next(&pwrite64, "pwrite64")(file, bytes, size, at);
}

ssize_t write(int file, const void* bytes, size_t size) {
  if (IsOnDisk(file) && IsFull()) return -1;
  return Next(&write, "write")(file, bytes, size);
}

ssize_t writev(int file, const iovec* pieces, int count) {
  if (IsOnDisk(file) && IsFull()) return -1;
  return Next(&writev, "writev")(file, pieces, count);
}

int ftruncate(int file, off_t size) noexcept {
  CountCall();
  return Next(&ftruncate, "ftruncate")(file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
  CountCall();
  return Next(&ftruncate64, "ftruncate64")(file, size);
}

int unlink(const char* path) noexcept {
  CountCall();
  return Next(&unlink, "unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  CountCall();
  return Next(&unlinkat, "unlinkat")(folder, path, flags);
}

int remove(const char* path) noexcept {
  CountCall();
  return Next(&remove, "remove")(path);
}

int rmdir(const char* path) noexcept {
  CountCall();
  return Next(&rmdir, "rmdir")(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (CannotMake()) return -1;
  return Next(&mkdir, "mkdir")(path, mode);
}

int rename(const char* from, const char* to) noexcept {
  if (LacksRights(CountCall())) return -1;
  return Next(&rename, "rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (LacksRights(CountCall())) return -1;
  return Next(&renameat2, "renameat2")(from_folder, from, to_folder, to, flags);
}

}  // extern "C"
