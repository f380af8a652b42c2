// How the processes of one campaign talk to each other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "batch/campaign.h"

namespace rockyard::batch {

struct Message {
  int rank = 0;  // it comes from
  int tag = 0;
  std::string bytes;
};

// Point-to-point messages between ranks 0 .. size()-1. Messages from one rank to another arrive in
// order. Only the thread that made it may call it.
class Communicator {
 public:
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

  // Never waits for the receiver: two ranks may send to each other at the same time, whatever the
  // size. Bytes that are under way move on in Poll and at the end.
  virtual void Send(int rank, int tag, const std::string& bytes) = 0;

  // The next message, if one is there.
  virtual std::optional<Message> Poll() = 0;

  // Ends this process and all other ranks at once, with that exit code: for a job with a rank that
  // no longer answers, which an ordinary end would wait for.
  [[noreturn]] virtual void Abort(int exit_code) = 0;

  // A rank that nobody waits for any more: the job ends with Abort.
  void GiveUp(int rank) { given_up_.insert(rank); }
  const std::set<int>& given_up() const { return given_up_; }

 private:
  std::set<int> given_up_;
};

// Where this process stands among those that mpirun (or srun) started, as its environment says:
// known before MPI starts, so that plain runs pay nothing for it and messages need no MPI.
struct Launch {
  int rank = 0;
  int ranks = 1;
  int local_ranks = 1;  // on this machine
};
std::optional<Launch> FindLaunch();

// Starts MPI (MPI_THREAD_FUNNELED: the calling thread alone speaks it) and ends it with the last
// reference. A rank that ends without that takes the others with it. Once per process. Throws
// core::UserError in a build without MPI.
std::unique_ptr<Communicator> StartMpi();

// Bytes of messages between ranks, and of processes that share a campaign's journal: the bits of
// every number, for machines of one kind. No file is of this form, so that it may change.

class PacketWriter {
 public:
  PacketWriter& Integer(std::int64_t value);
  PacketWriter& Real(double value);
  PacketWriter& Text(const std::string& text);
  PacketWriter& Trials(const std::vector<TrialId>& trials);
  PacketWriter& Records(const std::vector<CellRecord>& records);

  const std::string& bytes() const { return bytes_; }

 private:
  template <typename Value>
  PacketWriter& Bits(Value value);

  std::string bytes_;
};

// Reads what a PacketWriter wrote, in the same order. Throws
// std::runtime_error where the packet is too short: the ranks are no builds of one program.
class PacketReader {
 public:
  explicit PacketReader(const std::string& bytes) : bytes_(bytes) {}

  bool AtEnd() const { return at_ == bytes_.size(); }

  std::int64_t Integer();
  double Real();
  std::string Text();
  std::vector<TrialId> Trials();
  std::vector<CellRecord> Records();

 private:
  template <typename Value>
  Value Bits();

  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace rockyard::batch
