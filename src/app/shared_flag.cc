#include "app/shared_flag.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "core/error.h"

namespace rockyard::app {

static_assert(std::atomic<bool>::is_always_lock_free, "a lock would be of one process alone");

SharedFlag::SharedFlag() {
  void* memory =
      mmap(nullptr, sizeof(*set_), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw core::UserError("memory", std::strerror(errno), "end other programs");
  }
  set_ = new (memory) std::atomic<bool>(false);
}

SharedFlag::~SharedFlag() { munmap(set_, sizeof(*set_)); }

}  // namespace rockyard::app
