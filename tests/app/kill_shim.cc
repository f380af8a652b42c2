// Preloaded into the command: ends the process by SIGKILL before its Nth durable call, one of those
// that change what a later process finds on the disk. What is to be brought to the disk at once
// stays in the memory of the machine, which outlives processes: that makes hundreds of runs fast.
//
// ROCKYARD_KILL_AT    N, counted from 1 over the process and those that it forks; 0: none
// ROCKYARD_KILL_MARK  a file that is made where that many calls came
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
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

void CountCall() {
  static const char* const at = std::getenv("ROCKYARD_KILL_AT");
  static const char* const mark = std::getenv("ROCKYARD_KILL_MARK");
  if (at == nullptr || mark == nullptr || ++*Counter() != std::atol(at)) return;
  syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT, 0600);
  syscall(SYS_kill, getpid(), SIGKILL);
}

template <typename Function>
Function* Next(Function* /*of this type*/, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
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
  if ((flags & O_CREAT) != 0) CountCall();
  return Next(&open, "open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  if ((flags & O_CREAT) != 0) CountCall();
  return Next(&open64, "open64")(path, flags, mode);
}

int fsync(int file) {
  CountCall();
  return file < 0 ? -1 : 0;
}

int fdatasync(int file) {
  CountCall();
  return file < 0 ? -1 : 0;
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  CountCall();
  return Next(&pwrite, "pwrite")(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  CountCall();
  return Next(&pwrite64, "pwrite64")(file, bytes, size, at);
}

// Of files, not of pipes and terminals.
ssize_t write(int file, const void* bytes, size_t size) {
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) CountCall();
  return Next(&write, "write")(file, bytes, size);
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
  CountCall();
  return Next(&mkdir, "mkdir")(path, mode);
}

int rename(const char* from, const char* to) noexcept {
  CountCall();
  return Next(&rename, "rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  CountCall();
  return Next(&renameat2, "renameat2")(from_folder, from, to_folder, to, flags);
}

}  // extern "C"
