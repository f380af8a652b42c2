// Preloaded into the command: one allocation finds no memory, whoever asks for it.
//
// ROCKYARD_STARVED_AT  its number, counted from 1 over the process and those that it forks; 0: none
// ROCKYARD_STARVED_OF  a file for how many there were, written when the process ends
#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

// What glibc's own names stand for.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

// Shared with forked processes, so that it happens once. Null before main, when nothing is counted.
std::atomic<long>* counter = nullptr;
long starved_at = 0;

[[gnu::constructor]] void Begin() {
  if (const char* const at = std::getenv("ROCKYARD_STARVED_AT")) starved_at = std::atol(at);
  void* const shared = mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  counter = new (shared) std::atomic<long>(0);
}

[[gnu::destructor]] void End() {
  const char* const path = std::getenv("ROCKYARD_STARVED_OF");
  if (path == nullptr) return;
  std::FILE* const file = std::fopen(path, "w");
  std::fprintf(file, "%ld\n", counter->load());
  std::fclose(file);
}

bool IsStarved() {
  if (counter == nullptr || ++*counter != starved_at) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" {

void* malloc(size_t size) { return IsStarved() ? nullptr : __libc_malloc(size); }

void* calloc(size_t count, size_t size) {
  return IsStarved() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* block, size_t size) {
  return IsStarved() ? nullptr : __libc_realloc(block, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  return IsStarved() ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** block, size_t alignment, size_t size) {
  *block = IsStarved() ? nullptr : __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

}  // extern "C"
