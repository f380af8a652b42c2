// How the processes of one campaign talk to each other: messages between the ranks that mpirun
// started, and the bytes of these messages. distributed.h and the start and end of a campaign on
// ranks (campaign/campaign_process.h) talk by it; the journal of a campaign is made of the same
// bytes; commands ask FindLaunch whether mpirun started them.
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
// order. Only the thread that made a communicator may call it.
class Communicator {
 public:
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

  // Returns without waiting for the receiver: two ranks may send to each other at the same time,
  // whatever the size. Bytes that are under way move on in Poll and at the end.
  virtual void Send(int rank, int tag, const std::string& bytes) = 0;

  // Returns the next message, if one is there.
  virtual std::optional<Message> Poll() = 0;

  // Ends this process and all other ranks at once, with that exit code. It is for a job with a rank
  // that no longer answers: an ordinary end would wait for that rank.
  [[noreturn]] virtual void Abort(int exit_code) = 0;

  // Notes a rank that nobody waits for any more; the caller must end the job with Abort.
  void GiveUp(int rank) { given_up_.insert(rank); }
  const std::set<int>& given_up() const { return given_up_; }

 private:
  std::set<int> given_up_;
};

// Where this process stands among those that mpirun (or srun) started, as its environment says. It
// is known before MPI starts, so that plain runs pay nothing for it.
struct Launch {
  int rank = 0;
  int ranks = 1;
  int local_ranks = 1;  // on this machine
};
std::optional<Launch> FindLaunch();

// Starts MPI (MPI_THREAD_FUNNELED: the calling thread alone speaks it); the end of the communicator
// ends MPI. A rank whose process ends without that takes the others with it. Call it once per
// process. Throws core::UserError in a build without MPI.
std::unique_ptr<Communicator> StartMpi();

// Writes the bytes of messages between ranks, and of the journal that the processes of a campaign
// share: the bits of every number, for machines of one kind. No file has this form, so that it may
// change.
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

// Reads what a PacketWriter wrote, in the same order. Throws std::runtime_error where the packet is
// too short: then the ranks are no builds of one program.
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
