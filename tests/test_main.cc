// main() of every test program: GoogleTest's, which also writes what each test took.
//
// Where ROCKYARD_TEST_TIMES names a file, each test appends a line to it: program, test, seconds of
// the clock and of processors (children that ended included), joined by tabs (scripts/test.sh
// --times).
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Processor time of this process and of its children that have ended.
double ProcessorTime_s() {
  double sum = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  }
  return sum;
}

class TimesOfTests final : public testing::EmptyTestEventListener {
 public:
  TimesOfTests(std::string program, std::string file)
      : program_(std::move(program)), file_(std::move(file)) {}

  void OnTestStart(const testing::TestInfo&) override {
    start_ = std::chrono::steady_clock::now();
    start_cpu_s_ = ProcessorTime_s();
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
    std::ostringstream line;
    line << std::fixed << std::setprecision(3) << program_ << '\t' << test.test_suite_name() << '.'
         << test.name() << '\t' << clock.count() << '\t' << ProcessorTime_s() - start_cpu_s_
         << '\n';
    // In one write, as other programs append to the same file.
    std::ofstream(file_, std::ios::app) << line.str();
  }

 private:
  std::string program_, file_;
  std::chrono::steady_clock::time_point start_;
  double start_cpu_s_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  // A shell ignores it in what it starts in the background, and so would the commands under test.
  std::signal(SIGINT, SIG_DFL);
  testing::InitGoogleMock(&argc, argv);
  if (const char* file = std::getenv("ROCKYARD_TEST_TIMES"); file != nullptr && *file != '\0') {
    const std::string program = argv[0];
    auto listener =
        std::make_unique<TimesOfTests>(program.substr(program.find_last_of('/') + 1), file);
    testing::UnitTest::GetInstance()->listeners().Append(listener.release());
  }
  return RUN_ALL_TESTS();
}
