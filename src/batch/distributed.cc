#include "batch/distributed.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "batch/packet.h"
#include "batch/remote_work.h"

namespace rockyard::batch {
namespace {

using Clock = std::chrono::steady_clock;

// To rank 0.
constexpr int kReport = 1;  // records, trials wanted, 1 where the rank wants to end
constexpr int kBye = 2;     // records, trials that were not begun
// From rank 0.
constexpr int kBlock = 3;  // trials, 1 where it is the last

// Records are sent when trials are asked for, or after this.
constexpr std::chrono::milliseconds kSendEvery{50};

// Sleeps longer the longer there is nothing to do: at most 2 ms, which 1000 trials per second and
// thread do not notice.
class Idleness {
 public:
  void Rest(bool busy) {
    pause_ = busy ? kShort : std::min(2 * pause_, kLong);
    if (!busy) std::this_thread::sleep_for(pause_);
  }

 private:
  static constexpr std::chrono::microseconds kShort{50};
  static constexpr std::chrono::microseconds kLong{2000};
  std::chrono::microseconds pause_ = kShort;
};

// Computes until the source has no more trials, or this ends: then what was begun is finished.
class Engine {
 public:
  Engine(std::span<const CellWork> work, WorkSource& source, int threads)
      : source_(source), thread_([=, this] {
          RunTrials(work, source_, threads);
          done_ = true;
        }) {}
  ~Engine() {
    source_.Close();
    thread_.join();
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  bool done() const { return done_; }

 private:
  WorkSource& source_;
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

// Serves the other ranks from the source of rank 0.
class Desk {
 public:
  Desk(Communicator& communicator, LocalWorkSource& source)
      : communicator_(communicator),
        source_(source),
        ranks_(static_cast<std::size_t>(communicator.size())) {
    ranks_[0].gone = true;
  }

  bool empty() const {
    return std::all_of(ranks_.begin(), ranks_.end(), [](const Rank& rank) { return rank.gone; });
  }

  // Reads what has come and answers what can be answered; false where there was nothing to do.
  bool Serve() {
    bool busy = false;
    while (const std::optional<Message> message = communicator_.Poll()) {
      Receive(*message);
      busy = true;
    }
    for (std::size_t rank = 1; rank < ranks_.size(); ++rank) {
      if (ranks_[rank].wanted > 0 && !ranks_[rank].closed)
        busy = Answer(static_cast<int>(rank)) || busy;
    }
    return busy;
  }

 private:
  struct Rank {
    std::int64_t wanted = 0;
    bool closed = false;  // has its last block: it reads no other one after that
    bool gone = false;
  };

  void Receive(const Message& message) {
    if (message.tag != kReport && message.tag != kBye) {
      throw std::runtime_error("a rank says what it should not");
    }
    Rank& rank = ranks_.at(static_cast<std::size_t>(message.rank));
    PacketReader packet(message.bytes);
    for (CellRecord& record : packet.Records()) source_.Finish(std::move(record));
    if (message.tag == kBye) {
      rank.gone = true;
      for (const TrialId& id : packet.Trials()) source_.PutBack(id);
      return;
    }
    rank.wanted += packet.Integer();
    if (packet.Integer() == 1 && !rank.closed) SendBlock(message.rank, {}, true);
  }

  // False while a round of the plan goes on that has no trial left to hand out.
  bool Answer(int rank) {
    std::vector<TrialId> block;
    WorkPlan::NextStep next{WorkPlan::Step::kTrial};
    while (static_cast<std::int64_t>(block.size()) < ranks_[rank].wanted) {
      next = source_.TryTake();
      if (next.step != WorkPlan::Step::kTrial) break;
      block.push_back(next.id);
    }
    const bool last = next.step == WorkPlan::Step::kDone;
    if (block.empty() && !last) return false;
    SendBlock(rank, block, last);
    return true;
  }

  void SendBlock(int rank, const std::vector<TrialId>& block, bool last) {
    communicator_.Send(rank, kBlock, PacketWriter().Trials(block).Integer(last ? 1 : 0).bytes());
    ranks_[rank].wanted = 0;
    ranks_[rank].closed = last;
  }

  Communicator& communicator_;
  LocalWorkSource& source_;
  std::vector<Rank> ranks_;
};

// The talk of another rank with rank 0.
class Client {
 public:
  Client(Communicator& communicator, RemoteWorkSource& source, const std::atomic<bool>& stop)
      : communicator_(communicator), source_(source), stop_(stop) {}

  bool last() const { return last_; }

  // False where there was nothing to do.
  bool Talk() {
    bool busy = false;
    while (const std::optional<Message> message = communicator_.Poll()) {
      Receive(*message);
      busy = true;
    }
    return Report() || busy;
  }

  void SayBye() {
    communicator_.Send(0, kBye,
                       PacketWriter().Records(source_.Collect()).Trials(source_.Untaken()).bytes());
  }

 private:
  void Receive(const Message& message) {
    if (message.tag != kBlock) throw std::runtime_error("rank 0 has given up");
    PacketReader packet(message.bytes);
    source_.Add(packet.Trials());
    last_ = packet.Integer() == 1;
    asked_ = false;
    if (last_) source_.Close();
  }

  bool Report() {
    if (last_) return false;
    const bool ends = stop_ && !said_end_;
    const std::int64_t wanted = asked_ || stop_ ? 0 : source_.Wanted();
    if (wanted == 0 && !ends && Clock::now() < next_send_) return false;
    const std::vector<CellRecord> records = source_.Collect();
    if (wanted == 0 && !ends && records.empty()) return false;
    communicator_.Send(
        0, kReport, PacketWriter().Records(records).Integer(wanted).Integer(ends ? 1 : 0).bytes());
    asked_ = asked_ || wanted > 0;
    said_end_ = said_end_ || ends;
    next_send_ = Clock::now() + kSendEvery;
    return true;
  }

  Communicator& communicator_;
  RemoteWorkSource& source_;
  const std::atomic<bool>& stop_;
  bool asked_ = false;     // and not answered
  bool said_end_ = false;  // this rank wants to end
  bool last_ = false;      // rank 0 has no more
  Clock::time_point next_send_{};
};

}  // namespace

void RunTrialsOnRanks(Communicator& communicator, std::span<const CellWork> work,
                      LocalWorkSource& source, int threads) {
  const Engine engine(work, source, threads);
  Desk desk(communicator, source);
  Idleness idleness;
  while (!engine.done() || !desk.empty()) idleness.Rest(desk.Serve());
}

void ServeBatch(Communicator& communicator, std::span<const CellWork> work, int threads,
                const std::atomic<bool>& stop) {
  RemoteWorkSource source(threads, stop);
  Client client(communicator, source, stop);
  {
    const Engine engine(work, source, threads);
    Idleness idleness;
    while (!engine.done() || !client.last()) idleness.Rest(client.Talk());
  }
  client.SayBye();
}

}  // namespace rockyard::batch
