// Every rank sends messages to every other one before it receives any, as ranks do whose reports
// and blocks cross.
//
// mpi_child BYTES MESSAGES
// Exit code 0: all arrived whole and in order; 1: not so; ended by SIGALRM: nobody received.
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "batch/communicator.h"

namespace {

using rockyard::batch::Communicator;
using rockyard::batch::Message;

constexpr unsigned kMax_s = 600;  // a hang must end the test, not wait for ever

std::string Text(int from, int number, std::size_t size) {
  std::string text(size, static_cast<char>('a' + from));
  text.replace(0, 1, 1, static_cast<char>(number));
  return text;
}

bool Exchange(Communicator& communicator, std::size_t size, int messages) {
  const int ranks = communicator.size();
  for (int number = 0; number < messages; ++number) {
    for (int rank = 0; rank < ranks; ++rank) {
      if (rank == communicator.rank()) continue;
      communicator.Send(rank, 1 + number, Text(communicator.rank(), number, size));
    }
  }
  std::vector<int> received(static_cast<std::size_t>(ranks), 0);
  for (int left = messages * (ranks - 1); left > 0;) {
    const std::optional<Message> message = communicator.Poll();
    if (!message) continue;
    const int number = received[static_cast<std::size_t>(message->rank)]++;
    if (message->tag != 1 + number) return false;
    if (message->bytes != Text(message->rank, number, size)) return false;
    --left;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  alarm(kMax_s);
  const auto communicator = rockyard::batch::StartMpi();
  const auto size = static_cast<std::size_t>(std::atol(argv[1]));
  return Exchange(*communicator, size, std::atoi(argv[2])) ? 0 : 1;
}
