// The communicator over MPI, what stands for it in a build without MPI, and FindLaunch (declared in
// communicator.h). No record depends on it.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <string_view>

#include "batch/communicator.h"
#include "core/error.h"

#ifdef ROCKYARD_MPI
#include <mpi.h>
#endif

namespace rockyard::batch {
namespace {

std::optional<int> NumberOf(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  const std::string_view digits = text;
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool good = error == std::errc() && end == digits.data() + digits.size() && value >= 0;
  return good ? std::optional(value) : std::nullopt;
}

// The environment variables in which launchers tell rank, ranks and ranks on this machine: Open
// MPI's mpirun, MPICH's, and srun --mpi.
struct Names {
  const char* rank;
  const char* ranks;
  const char* local_ranks;
};
constexpr std::array kLaunchers = {
    Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE"},
    Names{"PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"},
    Names{"PMIX_RANK", "SLURM_NTASKS", "SLURM_NTASKS_PER_NODE"}};

}  // namespace

std::optional<Launch> FindLaunch() {
  for (const Names& names : kLaunchers) {
    const std::optional<int> rank = NumberOf(names.rank);
    const std::optional<int> ranks = NumberOf(names.ranks);
    if (!rank || !ranks || *rank >= *ranks) continue;
    return Launch{*rank, *ranks, std::max(NumberOf(names.local_ranks).value_or(1), 1)};
  }
  return std::nullopt;
}

#ifdef ROCKYARD_MPI

namespace {

// The communicator over MPI. Errors of MPI end every rank, as is MPI's default.
class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
      MPI_Finalize();
      throw core::UserError("MPI", "allows no threads", "use another MPI library, or no mpirun");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiCommunicator() override {
    for (Outgoing& message : outgoing_) MPI_Wait(&message.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void Send(int rank, int tag, const std::string& bytes) override {
    Outgoing& message = outgoing_.emplace_back(Outgoing{bytes, MPI_REQUEST_NULL});
    MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, rank, tag,
              MPI_COMM_WORLD, &message.request);
    ForgetSent();
  }

  std::optional<Message> Poll() override {
    ForgetSent();
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(size, '\0')};
    MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return message;
  }

  [[noreturn]] void Abort(int exit_code) override {
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();  // MPI_Abort returns only where MPI itself is broken
  }

 private:
  struct Outgoing {
    std::string bytes;  // MPI's until it is sent
    MPI_Request request;
  };

  void ForgetSent() {
    std::erase_if(outgoing_, [](Outgoing& message) {
      int sent = 0;
      MPI_Test(&message.request, &sent, MPI_STATUS_IGNORE);
      return sent != 0;
    });
  }

  int rank_ = 0;
  int size_ = 1;
  std::list<Outgoing> outgoing_;  // which stay where they are
};

}  // namespace

std::unique_ptr<Communicator> StartMpi() { return std::make_unique<MpiCommunicator>(); }

#else

std::unique_ptr<Communicator> StartMpi() {
  throw core::UserError("MPI", "is not in this build of the program",
                        "install it (scripts/install_dependencies.sh mpi), configure and build "
                        "again, or use --shard and `rockyard merge` in place of mpirun");
}

#endif

}  // namespace rockyard::batch
