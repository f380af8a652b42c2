// Several ranks as threads of this process: the protocol without MPI. The real thing is tested with
// the command (tests/app/cli_mpi_test.cc).
#include "batch/distributed.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "batch/batch_session.h"
#include "batch/communicator.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "core/wait_until.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

constexpr std::int64_t kTrials = 300;

// Mailboxes of all ranks.
struct Post {
  explicit Post(int ranks) : boxes(static_cast<std::size_t>(ranks)) {}
  std::mutex mutex;
  std::vector<std::deque<Message>> boxes;
};

class PostCommunicator final : public Communicator {
 public:
  PostCommunicator(Post& post, int rank) : post_(post), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(post_.boxes.size()); }
  void Send(int rank, int tag, const std::string& bytes) override {
    const std::lock_guard lock(post_.mutex);
    post_.boxes.at(static_cast<std::size_t>(rank)).push_back({rank_, tag, bytes});
  }
  std::optional<Message> Poll() override {
    const std::lock_guard lock(post_.mutex);
    std::deque<Message>& box = post_.boxes[static_cast<std::size_t>(rank_)];
    if (box.empty()) return std::nullopt;
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  [[noreturn]] void Abort(int exit_code) override { std::_Exit(exit_code); }

 private:
  Post& post_;
  int rank_;
};

std::string PlainHash() { return FakeHash(kTrials); }

class Cluster {
 public:
  using Hook = std::function<void(int rank, std::uint64_t trial)>;

  explicit Cluster(int ranks)
      : stops_(static_cast<std::size_t>(ranks)),
        overdue_(static_cast<std::size_t>(ranks)),
        post_(ranks) {}

  BatchResult Run(ResultStore& store, const BatchOptions& options, const Hook& hook) {
    std::vector<std::thread> others;
    for (int rank = 1; rank < size(); ++rank) {
      others.emplace_back([this, rank, &options, &hook] {
        PostCommunicator communicator(post_, rank);
        const FakeExperiment experiment = Experiment(rank, hook);
        const CellWork work{&experiment, 1};
        ServeBatch(communicator, std::span(&work, 1), options.threads, stop(rank), overdue(rank));
      });
    }
    PostCommunicator communicator(post_, 0);
    const FakeExperiment experiment = Experiment(0, hook);
    const CellWork work{&experiment, 1};
    BatchSession session(store, options, stop(0), {});
    RunTrialsOnRanks(communicator, std::span(&work, 1), session.source(), options.threads, watch_,
                     overdue(0), give_up_);
    given_up_ = communicator.given_up();
    ended_ = true;
    for (std::thread& other : others) other.join();
    return session.Close();
  }

  std::atomic<bool>& stop(int rank) { return stops_[static_cast<std::size_t>(rank)]; }
  OverdueTrials& overdue(int rank) { return overdue_[static_cast<std::size_t>(rank)]; }
  RankWatch& watch() { return watch_; }
  void SetGiveUp(std::function<void(const std::vector<TrialId>&)> give_up) {
    give_up_ = std::move(give_up);
  }
  const std::set<int>& given_up() const { return given_up_; }
  // Rank 0 waits for nobody any more.
  bool ended() const { return ended_; }
  int size() const { return static_cast<int>(stops_.size()); }
  // By rank, of trials that began there.
  std::map<int, int> begun() const { return begun_; }
  int ranks_begun() {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(begun_.size());
  }
  int total() const {
    int sum = 0;
    for (const auto& [rank, count] : begun_) sum += count;
    return sum;
  }

 private:
  FakeExperiment Experiment(int rank, const Hook& hook) {
    return FakeExperiment([this, rank, &hook](std::uint64_t trial) {
      {
        const std::lock_guard lock(mutex_);
        ++begun_[rank];
      }
      if (hook) hook(rank, trial);
    });
  }

  std::vector<std::atomic<bool>> stops_;
  std::vector<OverdueTrials> overdue_;
  RankWatch watch_;
  std::function<void(const std::vector<TrialId>&)> give_up_;
  std::set<int> given_up_;
  std::atomic<bool> ended_ = false;
  Post post_;
  std::mutex mutex_;
  std::map<int, int> begun_;
};

BatchOptions Options(int threads) {
  return {.threads = threads, .interval = std::chrono::milliseconds(5)};
}

void Sleep(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

class Distributed : public testing::Test {
 protected:
  core::TestFolder folder_;
  ResultStore store_ = ResultStore::Create(folder_.path(), FakeIdentity(), kTrials);
  const std::atomic<bool> stop_ = false;
};

class Ranks : public Distributed, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(Ranks, SameHashAndEveryTrialOnce) {
  const int ranks = GetParam().first;
  const int threads = GetParam().second;
  Cluster cluster(ranks);
  // No trial ends before every rank has one, however slow the machine starts their threads.
  const BatchResult result = cluster.Run(store_, Options(threads), [&](int, std::uint64_t) {
    core::WaitUntil([&] { return cluster.ranks_begun() >= ranks; });
    Sleep(1);
  });
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
  EXPECT_EQ(cluster.total(), kTrials);
  EXPECT_EQ(cluster.begun().size(), static_cast<std::size_t>(ranks)) << "every rank had some";
}

INSTANTIATE_TEST_SUITE_P(RanksAndThreads, Ranks,
                         testing::Values(std::pair(1, 1), std::pair(2, 1), std::pair(3, 1),
                                         std::pair(2, 3), std::pair(5, 2)));

TEST_F(Distributed, TrialsWithoutCost) {
  Cluster cluster(3);
  EXPECT_EQ(cluster.Run(store_, Options(2), {}).end, BatchEnd::kFinished);
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
}

TEST_F(Distributed, NothingToDo) {
  Cluster(2).Run(store_, Options(1), {});
  Cluster again(3);
  EXPECT_EQ(again.Run(store_, Options(1), {}).end, BatchEnd::kFinished);
  EXPECT_EQ(again.total(), 0);
}

// One that takes 20 times as long must not hold trials that others could have done.
TEST_F(Distributed, SlowRankGetsFewTrials) {
  Cluster cluster(2);
  std::atomic<int> of_the_fast = 0;
  cluster.Run(store_, Options(1), [&](int rank, std::uint64_t) {
    Sleep(2);
    if (rank == 0) {
      ++of_the_fast;
      return;
    }
    // Until the other one has done 20, or has nothing to do.
    const int begin = of_the_fast;
    for (int last = begin, idle = 0; of_the_fast < begin + 20 && idle < 300; Sleep(1)) {
      idle = of_the_fast == last ? idle + 1 : 0;
      last = of_the_fast;
    }
  });
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
  EXPECT_GE(cluster.begun()[1], 1);
  EXPECT_LE(cluster.begun()[1], 45) << "of 300; a fair share would be 15";
}

TEST_F(Distributed, RankThatStopsGivesBackWhatItHasNotBegun) {
  Cluster cluster(3);
  const BatchResult result = cluster.Run(store_, Options(2), [&](int rank, std::uint64_t) {
    Sleep(2);
    if (rank == 1) cluster.stop(1) = true;
  });
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
  EXPECT_EQ(cluster.total(), kTrials);
  EXPECT_LE(cluster.begun()[1], 2) << "one for each thread";
}

TEST_F(Distributed, StopOfRankZeroEndsAllAndAnotherNumberOfRanksGoesOn) {
  Cluster cluster(3);
  const BatchResult result = cluster.Run(store_, Options(1), [&](int, std::uint64_t trial) {
    Sleep(2);
    if (trial == 50) cluster.stop(0) = true;
  });
  EXPECT_EQ(result.end, BatchEnd::kStopped);
  EXPECT_EQ(static_cast<int>(store_.Load().size()), cluster.total()) << "all that began is stored";
  EXPECT_LT(cluster.total(), kTrials);
  EXPECT_EQ(Cluster(2).Run(store_, Options(2), {}).end, BatchEnd::kFinished);
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
}

// A rank that says nothing is given up, its trials are run by others, and the campaign is whole.
TEST_F(Distributed, TrialsOfASilentRankAreGivenToOthers) {
  Post post(3);
  std::atomic<bool> asked = false;
  std::thread frozen([&] {
    PostCommunicator other(post, 2);
    other.Send(0, 1, PacketWriter().Records({}).Integer(5).Integer(0).bytes());
    asked = true;
  });
  const FakeExperiment experiment([](std::uint64_t) { Sleep(1); });
  const CellWork work{&experiment, 1};
  const std::atomic<bool> never = false;
  const OverdueTrials none;
  std::thread other([&] {
    PostCommunicator communicator(post, 1);
    ServeBatch(communicator, std::span(&work, 1), 1, never, none);
  });
  BatchSession session(store_, Options(1), never, {});
  PostCommunicator communicator(post, 0);
  std::vector<std::pair<int, std::size_t>> silent;
  const RankWatch watch{
      .silence = std::chrono::milliseconds(5000),
      .silent = [&](int rank, std::size_t trials) { silent.emplace_back(rank, trials); }};
  RunTrialsOnRanks(communicator, std::span(&work, 1), session.source(), 1, watch, none, {});
  frozen.join();
  other.join();
  EXPECT_EQ(session.Close().end, BatchEnd::kFinished);
  EXPECT_THAT(silent, testing::ElementsAre(std::pair<int, std::size_t>(2, 5)));
  EXPECT_THAT(communicator.given_up(), testing::ElementsAre(2));
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
}

// A long trial is no silence: the thread that talks says that the rank is there.
TEST_F(Distributed, ALongTrialIsNoSilence) {
  Cluster cluster(2);
  cluster.watch().silence = std::chrono::milliseconds(5000);
  std::atomic<bool> slept = false;
  const BatchResult result = cluster.Run(store_, Options(1), [&](int rank, std::uint64_t) {
    if (rank == 1 && !slept.exchange(true)) Sleep(7000);
    while (!slept) Sleep(1);  // however late the other rank begins
  });
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_TRUE(slept);
  EXPECT_TRUE(cluster.given_up().empty());
}

// What a rank says after it was given up is not counted twice, nor does it get another trial.
TEST_F(Distributed, ARankThatComesBackIsNotHeard) {
  Post post(2);
  PostCommunicator other(post, 1);
  BatchSession session(store_, Options(1), stop_, {});
  PostCommunicator communicator(post, 0);
  bool returned = false;
  const RankWatch watch{.silence = std::chrono::milliseconds(50), .silent = [&](int, std::size_t) {
                          other.Send(0, 1,
                                     PacketWriter().Records({}).Integer(5).Integer(1).bytes());
                          returned = true;
                        }};
  const FakeExperiment experiment([](std::uint64_t) { Sleep(1); });
  const CellWork work{&experiment, 1};
  RunTrialsOnRanks(communicator, std::span(&work, 1), session.source(), 1, watch, {}, {});
  session.Close();
  EXPECT_TRUE(returned);
  EXPECT_FALSE(other.Poll());
  EXPECT_EQ(TrialHash(store_.Load()), PlainHash());
}

// A trial that hangs on another rank stays pending, and that alone.
TEST_F(Distributed, ATrialThatHangsElsewhereStaysPending) {
  Cluster cluster(3);
  std::vector<TrialId> told;
  cluster.watch().overdue = [&](const std::vector<TrialId>& trials) { told = trials; };
  std::atomic<std::int64_t> hangs = -1;
  const BatchResult result = cluster.Run(store_, Options(1), [&](int rank, std::uint64_t trial) {
    Sleep(1);
    std::int64_t none = -1;
    const auto id = static_cast<std::int64_t>(trial);
    if (rank != 1 || !hangs.compare_exchange_strong(none, id)) {
      while (hangs < 0) Sleep(1);  // however late that rank begins
      return;
    }
    cluster.stop(1) = true;  // as a watchdog does
    cluster.overdue(1).Tell({{0, id}});
    while (!cluster.ended()) Sleep(1);
  });
  EXPECT_EQ(result.end, BatchEnd::kStopped);
  EXPECT_THAT(told, testing::ElementsAre(TrialId{0, hangs}));
  EXPECT_THAT(cluster.given_up(), testing::ElementsAre(1));
  const std::vector<truth::Record> records = store_.Load();
  EXPECT_EQ(records.size(), static_cast<std::size_t>(kTrials - 1));
  for (const truth::Record& record : records) {
    EXPECT_NE(static_cast<std::int64_t>(record.trial), hangs);
  }
}

// Where it hangs on rank 0, everything that the others have done is stored first.
TEST_F(Distributed, ATrialThatHangsOnRankZeroEndsTheJobInOrder) {
  Cluster cluster(2);
  std::atomic<std::int64_t> hangs = -1;
  std::atomic<bool> over = false;
  std::vector<TrialId> told;
  cluster.SetGiveUp([&](const std::vector<TrialId>& trials) {
    told = trials;
    over = true;
  });
  cluster.Run(store_, Options(1), [&](int rank, std::uint64_t trial) {
    Sleep(1);
    std::int64_t none = -1;
    const auto id = static_cast<std::int64_t>(trial);
    if (rank != 0 || trial < 20 || !hangs.compare_exchange_strong(none, id)) {
      while (trial >= 20 && hangs < 0) Sleep(1);
      return;
    }
    cluster.stop(0) = true;
    cluster.overdue(0).Tell({{0, id}});
    while (!over) Sleep(1);
  });
  EXPECT_THAT(told, testing::ElementsAre(TrialId{0, hangs}));
  EXPECT_EQ(static_cast<int>(store_.Load().size()), cluster.total());
}

// A rule decides at the ends of rounds: ranks wait, and the same trials run.
TEST_F(Distributed, RoundsOfAStoppingRule) {
  BatchOptions options = Options(2);
  options.rule = StoppingRule{.half_width = 0.12, .block = 40, .confidence = 0.95};
  const BatchResult result = Cluster(3).Run(store_, options, [](int, std::uint64_t) { Sleep(1); });
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  const core::TestFolder other;
  ResultStore alone = ResultStore::Create(other.path(), FakeIdentity(), kTrials);
  const std::atomic<bool> never = false;
  RunBatch(FakeExperiment(), alone, options, never);
  EXPECT_EQ(TrialHash(store_.Load()), TrialHash(alone.Load()));
  EXPECT_LT(store_.Load().size(), static_cast<std::size_t>(kTrials)) << "the rule was met";
}

TEST_F(Distributed, TrialThatThrowsElsewhereIsAFault) {
  Cluster cluster(2);
  cluster.Run(store_, Options(1), [](int, std::uint64_t trial) {
    Sleep(1);
    if (trial % 100 == 7) throw std::runtime_error("broken");
  });
  const std::vector<truth::Record> records = store_.Load();
  ASSERT_EQ(records.size(), static_cast<std::size_t>(kTrials));
  for (const truth::Record& record : records) {
    EXPECT_EQ(truth::IsFault(record), record.trial % 100 == 7);
  }
}

// Rank 0 must end with an error, and not wait for threads that wait for trials which do not come.
TEST_F(Distributed, CutOffPacketIsAnErrorNotAHang) {
  BatchOptions options = Options(2);
  options.rule = StoppingRule{.half_width = 0.12, .block = 40, .confidence = 0.95};
  const std::atomic<bool> never = false;
  BatchSession session(store_, options, never, {});
  // Another rank has a trial of the round, so that the threads of this one wait for its end.
  ASSERT_EQ(session.source().TryTake().step, WorkPlan::Step::kTrial);
  Post post(2);
  PostCommunicator(post, 1).Send(0, 1, "cut");
  PostCommunicator communicator(post, 0);
  const FakeExperiment experiment;
  const CellWork work{&experiment, 1};
  EXPECT_THROW(RunTrialsOnRanks(communicator, std::span(&work, 1), session.source(),
                                options.threads, {}, {}, {}),
               std::runtime_error);
}

// A rank that asked and then wants to end, while all end: after its last block it reads what comes
// as something else.
TEST_F(Distributed, ARankGetsOneLastBlock) {
  const std::atomic<bool> stopped = true;
  BatchSession session(store_, Options(1), stopped, {});
  Post post(2);
  PostCommunicator other(post, 1);
  std::vector<Message> answers;
  std::thread rank([&] {
    const auto send = [&](std::int64_t wanted, std::int64_t ends) {
      other.Send(0, 1, PacketWriter().Records({}).Integer(wanted).Integer(ends).bytes());
    };
    const auto read = [&] {
      while (std::optional<Message> answer = other.Poll()) answers.push_back(*std::move(answer));
    };
    send(3, 0);
    while (answers.empty()) read();
    send(0, 1);
    other.Send(0, 2, PacketWriter().Records({}).Trials({}).Trials({}).bytes());
  });
  PostCommunicator communicator(post, 0);
  const FakeExperiment experiment;
  const CellWork work{&experiment, 1};
  RunTrialsOnRanks(communicator, std::span(&work, 1), session.source(), 1, {}, {}, {});
  rank.join();
  while (std::optional<Message> answer = other.Poll()) answers.push_back(*std::move(answer));
  EXPECT_EQ(answers.size(), 1u);
}

// The end of the campaign, sent while this rank computes, is no block of trials.
TEST_F(Distributed, RankEndsWhereRankZeroHasGivenUp) {
  Post post(2);
  PostCommunicator(post, 0).Send(1, 11, PacketWriter().Integer(5).bytes());
  PostCommunicator communicator(post, 1);
  const FakeExperiment experiment;
  const CellWork work{&experiment, 1};
  const std::atomic<bool> never = false;
  EXPECT_THROW(ServeBatch(communicator, std::span(&work, 1), 2, never, {}), std::runtime_error);
}

TEST(Packet, KeepsEveryBit) {
  const double payload = std::bit_cast<double>(std::uint64_t{0x7ff8000000000123});
  const std::vector<CellRecord> sent = {
      {3, {1ULL << 40, truth::TrialOutcome::kJammed, "a \"b\"\n\0c", {-0.0, payload, 1e-310}}},
      {0, truth::MakeFault(1, 2, "broken")}};
  const std::vector<TrialId> ids = {{0, 5}, {7, 1LL << 50}};
  const PacketWriter writer = PacketWriter().Records(sent).Trials(ids).Text("").Real(-0.0);
  PacketReader reader(writer.bytes());
  const std::vector<CellRecord> got = reader.Records();
  ASSERT_EQ(got.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(got[i].cell, sent[i].cell);
    EXPECT_EQ(got[i].record.detail, sent[i].record.detail);
    EXPECT_EQ(TrialHash(std::span(&got[i].record, 1)), TrialHash(std::span(&sent[i].record, 1)));
  }
  EXPECT_EQ(std::bit_cast<std::uint64_t>(got[0].record.values[1]),
            std::bit_cast<std::uint64_t>(payload));
  EXPECT_EQ(reader.Trials(), ids);
  EXPECT_EQ(reader.Text(), "");
  EXPECT_TRUE(std::signbit(reader.Real()));
}

TEST(Packet, CutOffIsAnError) {
  const std::string whole = PacketWriter().Trials({{1, 2}, {3, 4}}).Text("words").bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    PacketReader reader(part);
    const auto read = [&] {
      reader.Trials();
      reader.Text();
    };
    EXPECT_THROW(read(), std::runtime_error) << size;
  }
}

TEST(RemoteWork, AsksForAQuarterOfASecond) {
  const std::atomic<bool> stop = false;
  RemoteWorkSource source(2, stop);
  EXPECT_EQ(source.Wanted(), 0) << "nobody waits yet";
  std::vector<TrialId> block;
  for (int i = 0; i < 4; ++i) block.push_back({0, i});
  source.Add(block);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 4; ++i) {
    const std::optional<TrialId> id = source.Take();
    ASSERT_TRUE(id);
    Sleep(10);
    source.Finish({0, FakeRecord(1, static_cast<std::uint64_t>(id->trial))});
  }
  // 2 threads x 0.25 s / 10 ms, or less: sleeping takes longer than asked for.
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(source.Wanted(), static_cast<int>(2 * 0.25 / (took.count() / 4)));
  EXPECT_LE(source.Wanted(), 50);
  EXPECT_EQ(source.Collect().size(), 4U);
  EXPECT_TRUE(source.Collect().empty());
}

TEST(RemoteWork, ClosedHandsOutNothing) {
  const std::atomic<bool> stop = false;
  RemoteWorkSource source(1, stop);
  source.Add({{0, 1}, {0, 2}});
  source.Take();
  source.Close();
  EXPECT_FALSE(source.Take());
  EXPECT_EQ(source.Untaken(), (std::vector<TrialId>{{0, 2}}));
}

}  // namespace
}  // namespace rockyard::batch
