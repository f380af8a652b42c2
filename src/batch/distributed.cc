#include "batch/distributed.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "batch/communicator.h"

namespace rockyard::batch {
namespace {

using Clock = std::chrono::steady_clock;

// Tags of messages to rank 0, and what each message holds. campaign/campaign_process.cc has the
// other tags, from 10 on; all must differ.
constexpr int kReport = 1;  // records, trials wanted, 1 where the rank wants to end
constexpr int kBye = 2;     // records, trials that were not begun, trials that are overdue
// The tag of messages from rank 0.
constexpr int kBlock = 3;  // trials, 1 where it is the last

// Records are sent when trials are asked for, or after this time.
constexpr std::chrono::milliseconds kSendEvery{50};
// A rank with nothing else to say sends an empty report after this time. RankWatch::silence must be
// longer.
constexpr std::chrono::milliseconds kSignEvery{500};

// Sleeps the longer, the longer there is nothing to do: at most 2 ms, which threads with 1000
// trials per second do not notice.
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

// Computes on threads of its own until the source has no more trials. Its destructor closes the
// source and waits for the trials that were begun.
class Engine {
 public:
  Engine(std::span<const CellWork> work, WorkSource& source, int threads)
      : source_(source), thread_([=, this] {
          try {
            RunTrials(work, source_, threads);
          } catch (...) {
            failure_ = std::current_exception();
          }
          done_ = true;
        }) {}
  ~Engine() {
    source_.Close();
    thread_.join();
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // Returns whether RunTrials has ended. Throws what it has thrown.
  bool done() const {
    if (done_ && failure_) std::rethrow_exception(failure_);
    return done_;
  }

 private:
  WorkSource& source_;
  std::exception_ptr failure_;  // before done_
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

// Serves the other ranks from the source of rank 0.
class Desk {
 public:
  Desk(Communicator& communicator, LocalWorkSource& source, const RankWatch& watch)
      : communicator_(communicator),
        source_(source),
        watch_(watch),
        ranks_(static_cast<std::size_t>(communicator.size()), Rank{.heard = Clock::now()}) {
    ranks_[0].gone = true;
  }

  bool empty() const {
    return std::all_of(ranks_.begin(), ranks_.end(), [](const Rank& rank) { return rank.gone; });
  }

  // Reads what has come and answers what can be answered. Returns false where there was nothing to
  // do.
  bool Serve() {
    bool busy = false;
    while (const std::optional<Message> message = communicator_.Poll()) {
      Receive(*message);
      busy = true;
    }
    for (std::size_t rank = 1; rank < ranks_.size(); ++rank) {
      if (ranks_[rank].wanted > 0 && !ranks_[rank].closed && !ranks_[rank].gone)
        busy = Answer(static_cast<int>(rank)) || busy;
    }
    if (watch_.silence.count() > 0) GiveUpSilentRanks();
    if (overdue_) EndWhereNothingElseIsLeft();
    return busy;
  }

 private:
  struct Rank {
    Clock::time_point heard;  // the last time that it said anything
    std::set<TrialId> has{};  // trials that were sent to it and have not come back
    std::int64_t wanted = 0;
    bool closed = false;  // has its last block: it reads no other one after that
    bool gone = false;
  };

  void Receive(const Message& message) {
    if (message.tag != kReport && message.tag != kBye) {
      throw std::runtime_error("a rank says what it should not");
    }
    if (communicator_.given_up().contains(message.rank)) return;  // others have its trials
    Rank& rank = ranks_.at(static_cast<std::size_t>(message.rank));
    rank.heard = Clock::now();
    PacketReader packet(message.bytes);
    for (CellRecord& record : packet.Records()) {
      rank.has.erase({record.cell, static_cast<std::int64_t>(record.record.trial)});
      source_.Finish(std::move(record));
    }
    if (message.tag == kBye) return ReceiveBye(message.rank, packet);
    rank.wanted += packet.Integer();
    if (packet.Integer() == 1 && !rank.closed) SendBlock(message.rank, {}, true);
  }

  void ReceiveBye(int rank, PacketReader& packet) {
    ranks_[static_cast<std::size_t>(rank)].gone = true;
    for (const TrialId& id : packet.Trials()) source_.PutBack(id);
    const std::vector<TrialId> overdue = packet.Trials();
    if (overdue.empty()) return;
    overdue_ = true;
    communicator_.GiveUp(rank);
    if (watch_.overdue) watch_.overdue(overdue);
  }

  void GiveUpSilentRanks() {
    const Clock::time_point now = Clock::now();
    for (std::size_t i = 1; i < ranks_.size(); ++i) {
      Rank& rank = ranks_[i];
      if (rank.gone || now - rank.heard < watch_.silence) continue;
      rank.gone = true;
      for (const TrialId& id : rank.has) source_.PutBack(id);
      communicator_.GiveUp(static_cast<int>(i));
      if (watch_.silent) watch_.silent(static_cast<int>(i), rank.has.size());
    }
  }

  // Closes the source where only trials that stay pending are missing: a round with such a trial
  // never ends, and nobody is to wait for it.
  void EndWhereNothingElseIsLeft() {
    const bool idle = std::all_of(ranks_.begin(), ranks_.end(),
                                  [](const Rank& rank) { return rank.gone || rank.has.empty(); });
    if (!idle) return;
    const WorkPlan::NextStep next = source_.TryTake();
    if (next.step == WorkPlan::Step::kTrial) return source_.PutBack(next.id);
    source_.Close();
  }

  // Sends the rank its block. Returns false while a round of the plan goes on that has no trial
  // left to hand out.
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
    ranks_[rank].has.insert(block.begin(), block.end());
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
  const RankWatch& watch_;
  std::vector<Rank> ranks_;
  bool overdue_ = false;  // a trial of another rank stays pending
};

// The talk of another rank with rank 0.
class Client {
 public:
  Client(Communicator& communicator, RemoteWorkSource& source, const std::atomic<bool>& stop)
      : communicator_(communicator), source_(source), stop_(stop) {}

  bool last() const { return last_; }

  // Reads what rank 0 has sent and reports to it. Returns false where there was nothing to do.
  bool Talk() {
    bool busy = false;
    while (const std::optional<Message> message = communicator_.Poll()) {
      Receive(*message);
      busy = true;
    }
    return Report() || busy;
  }

  void SayBye(const std::vector<TrialId>& overdue) {
    communicator_.Send(0, kBye,
                       PacketWriter()
                           .Records(source_.Collect())
                           .Trials(source_.Untaken())
                           .Trials(overdue)
                           .bytes());
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
    const bool ends = stop_ && !said_end_ && !last_;
    const std::int64_t wanted = asked_ || stop_ || last_ ? 0 : source_.Wanted();
    const bool says = wanted > 0 || ends;
    const Clock::time_point now = Clock::now();
    if (!says && now < next_send_) return false;
    const std::vector<CellRecord> records = source_.Collect();
    if (!says && records.empty() && now < next_sign_) return false;
    communicator_.Send(
        0, kReport, PacketWriter().Records(records).Integer(wanted).Integer(ends ? 1 : 0).bytes());
    asked_ = asked_ || wanted > 0;
    said_end_ = said_end_ || ends;
    next_send_ = now + kSendEvery;
    next_sign_ = now + kSignEvery;
    return true;
  }

  Communicator& communicator_;
  RemoteWorkSource& source_;
  const std::atomic<bool>& stop_;
  bool asked_ = false;     // and not answered
  bool said_end_ = false;  // this rank wants to end
  bool last_ = false;      // rank 0 has no more
  Clock::time_point next_send_{};
  Clock::time_point next_sign_{};
};

}  // namespace

void OverdueTrials::Tell(std::vector<TrialId> trials) {
  const std::lock_guard lock(mutex_);
  trials_ = std::move(trials);
}

std::optional<std::vector<TrialId>> OverdueTrials::told() const {
  const std::lock_guard lock(mutex_);
  return trials_;
}

void RunTrialsOnRanks(Communicator& communicator, std::span<const CellWork> work,
                      LocalWorkSource& source, int threads, const RankWatch& watch,
                      const OverdueTrials& overdue,
                      const std::function<void(const std::vector<TrialId>&)>& give_up) {
  const Engine engine(work, source, threads);
  Desk desk(communicator, source, watch);
  Idleness idleness;
  while (!engine.done() || !desk.empty()) {
    idleness.Rest(desk.Serve());
    if (engine.done() || !desk.empty()) continue;
    if (const std::optional<std::vector<TrialId>> own = overdue.told()) give_up(*own);
  }
}

void ServeBatch(Communicator& communicator, std::span<const CellWork> work, int threads,
                const std::atomic<bool>& stop, const OverdueTrials& overdue) {
  RemoteWorkSource source(threads, stop);
  Client client(communicator, source, stop);
  const Engine engine(work, source, threads);
  Idleness idleness;
  while (!engine.done() || !client.last()) {
    idleness.Rest(client.Talk());
    const std::optional<std::vector<TrialId>> hang = overdue.told();
    if (!hang) continue;
    client.SayBye(*hang);
    // Messages that still come are read and dropped: this rank is given up.
    while (!engine.done()) idleness.Rest(communicator.Poll().has_value());
    return;
  }
  client.SayBye({});
}

std::optional<TrialId> RemoteWorkSource::Take() {
  std::unique_lock lock(mutex_);
  ++idle_;
  while (waiting_.empty() && !closed_ && !stop_) added_.wait_for(lock, kStopCheck);
  --idle_;
  if (waiting_.empty() || closed_ || stop_) return std::nullopt;
  const TrialId id = waiting_.front();
  waiting_.pop_front();
  taken_.push_back({id, Clock::now()});
  return id;
}

void RemoteWorkSource::Finish(CellRecord record) {
  const std::lock_guard lock(mutex_);
  const TrialId id{record.cell, static_cast<std::int64_t>(record.record.trial)};
  const auto taken = std::find_if(taken_.begin(), taken_.end(),
                                  [&](const Taken& candidate) { return candidate.id == id; });
  if (taken != taken_.end()) {
    busy_s_ += std::chrono::duration<double>(Clock::now() - taken->at).count();
    ++count_;
    taken_.erase(taken);
  }
  finished_.push_back(std::move(record));
}

void RemoteWorkSource::Add(const std::vector<TrialId>& trials) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), trials.begin(), trials.end());
  }
  added_.notify_all();
}

void RemoteWorkSource::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  added_.notify_all();
}

std::int64_t RemoteWorkSource::Wanted() const {
  const std::lock_guard lock(mutex_);
  double ahead = count_ == 0 ? 0.0 : static_cast<double>(threads_) * kBlock_s;
  if (busy_s_ > 0.0) ahead *= static_cast<double>(count_) / busy_s_;
  const auto block = static_cast<std::int64_t>(std::min<double>(ahead, kLargestBlock));
  const auto held = static_cast<std::int64_t>(waiting_.size());
  if (held < idle_) return std::max<std::int64_t>(block, idle_) - held;
  return 2 * held < block ? block - held : 0;
}

std::vector<CellRecord> RemoteWorkSource::Collect() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, {});
}

std::vector<TrialId> RemoteWorkSource::Untaken() {
  const std::lock_guard lock(mutex_);
  const std::deque<TrialId> untaken = std::exchange(waiting_, {});
  return {untaken.begin(), untaken.end()};
}

}  // namespace rockyard::batch
