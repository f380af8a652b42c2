#include "python/waiting.h"

#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "core/error.h"

namespace rockyard::python {

namespace py = pybind11;

Contact::Contact() {
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw core::MachineError("memory", "is short", "end other programs");
  shared_ = new (memory) Shared;
}

Contact::~Contact() { munmap(shared_, sizeof(Shared)); }

namespace {

thread_local bool forks_with_python = false;
thread_local PyGILState_STATE lock_of_fork;

void BeforeFork() {
  if (forks_with_python) lock_of_fork = PyGILState_Ensure();
}
void AfterForkInParent() {
  if (forks_with_python) PyGILState_Release(lock_of_fork);
}
void AfterForkInChild() {
  if (!forks_with_python) return;
  PyOS_AfterFork_Child();
  // The state of this thread stays: an interpreter that had none would have no first one again.
  PyEval_SaveThread();
}

// The work that this process waits for. Used under the interpreter's lock.
struct UnderWay {
  std::set<const Contact*> contacts;
  pid_t process = getpid();

  // A fork waits for nothing that its parent began.
  std::set<const Contact*>& Own() {
    if (process != getpid()) {
      contacts.clear();
      process = getpid();
    }
    return contacts;
  }
};

UnderWay& TheWork() {
  static UnderWay& under_way = *new UnderWay;  // outlives every thread
  return under_way;
}

class Noted {
 public:
  explicit Noted(const Contact& contact) : contact_(contact) { TheWork().Own().insert(&contact_); }
  ~Noted() { TheWork().Own().erase(&contact_); }
  Noted(const Noted&) = delete;
  Noted& operator=(const Noted&) = delete;

 private:
  const Contact& contact_;
};

constexpr std::chrono::milliseconds kListen{20};

// The end of the work, waited for.
class End {
 public:
  void Come(std::exception_ptr thrown) {
    {
      const std::lock_guard lock(mutex_);
      thrown_ = std::move(thrown);
      is_there_ = true;
    }
    changed_.notify_one();
  }
  bool IsThereWithin(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return is_there_; });
  }
  const std::exception_ptr& thrown() const { return thrown_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_there_ = false;
  std::exception_ptr thrown_;
};

}  // namespace

ForksWithPython::ForksWithPython() {
  static const int registered = pthread_atfork(BeforeFork, AfterForkInParent, AfterForkInChild);
  if (registered != 0) throw core::MachineError("memory", "is short", "end other programs");
  forks_with_python = true;
}

ForksWithPython::~ForksWithPython() { forks_with_python = false; }

void EndWork() {
  while (!TheWork().Own().empty()) {
    for (const Contact* contact : TheWork().Own()) contact->Stop();
    const py::gil_scoped_release released;
    std::this_thread::sleep_for(kListen);
  }
}

void Await(std::function<void(const Contact&)> work, const py::object& progress) {
  // What both threads use, on no stack.
  struct Job {
    std::function<void(const Contact&)> work;
    Contact contact;
    End end;
  };
  const auto job = std::make_shared<Job>();
  job->work = std::move(work);
  const Contact& contact = job->contact;
  End& end = job->end;
  const Noted noted(contact);
  const pid_t process = getpid();
  std::thread thread([job] {
    std::exception_ptr thrown;
    try {
      job->work(job->contact);
    } catch (...) {
      thrown = std::current_exception();
    }
    job->end.Come(thrown);
  });
  std::optional<py::error_already_set> raised;
  std::pair<std::int64_t, std::int64_t> shown{-1, -1};
  const auto listen = [&] {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const std::pair<std::int64_t, std::int64_t> now{contact.shared_->finished,
                                                      contact.shared_->planned};
      if (!progress.is_none() && now != shown && now.second > 0) progress(now.first, now.second);
      shown = now;
    } catch (py::error_already_set& error) {
      if (!raised) raised.emplace(std::move(error));
    }
    if (getpid() != process) {  // `progress` has forked: the work goes on in the parent
      thread.detach();
      if (raised) throw std::move(*raised);
      throw core::UserError("process", "was forked while it waited for a run",
                            "let functions of progress start programs, and fork elsewhere");
    }
    if (raised) contact.Stop();
  };
  bool ended = false;
  while (!ended) {
    {
      const py::gil_scoped_release released;
      ended = end.IsThereWithin(kListen);
    }
    listen();
  }
  {
    const py::gil_scoped_release released;
    thread.join();
  }
  if (raised) throw std::move(*raised);
  if (end.thrown()) std::rethrow_exception(end.thrown());
}

}  // namespace rockyard::python
