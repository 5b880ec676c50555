#include "bench/bare_messages.h"

#include <mpi.h>
#include <sched.h>

#include <array>
#include <chrono>

#include "bench/processor_time.h"

namespace veduta::bench {
namespace {

constexpr int bare_tag = 2;  // transport.h has 1
using Bytes = std::array<char, 24>;

void answer(uint64_t requests) {
  Bytes bytes{};
  for (uint64_t answered = 0; answered < requests;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, bare_tag, MPI_COMM_WORLD, &there, &status);
    if (!there) {
      sched_yield();
      continue;
    }
    MPI_Recv(bytes.data(), bytes.size(), MPI_CHAR, status.MPI_SOURCE, bare_tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    MPI_Send(bytes.data(), bytes.size(), MPI_CHAR, status.MPI_SOURCE, bare_tag, MPI_COMM_WORLD);
    ++answered;
  }
}

void ask(uint64_t requests, uint64_t window) {
  Bytes bytes{};
  const auto send = [&] { MPI_Send(bytes.data(), bytes.size(), MPI_CHAR, 0, bare_tag, MPI_COMM_WORLD); };
  uint64_t asked = 0, answered = 0;
  while (asked < requests && asked < window) send(), ++asked;
  while (answered < requests) {
    int there = 0;
    MPI_Iprobe(0, bare_tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    if (!there) {
      sched_yield();
      continue;
    }
    MPI_Recv(bytes.data(), bytes.size(), MPI_CHAR, 0, bare_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    ++answered;
    if (asked < requests) send(), ++asked;
  }
}

}  // namespace

BareMessages exchange_bare_messages(uint64_t tasks, uint32_t window) {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const uint64_t each = tasks / static_cast<uint64_t>(size - 1);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto began = std::chrono::steady_clock::now();
  const double processor_began_s = processor_s();
  BareMessages result;
  result.tasks = each * static_cast<uint64_t>(size - 1);
  if (rank == 0)
    answer(result.tasks);
  else
    ask(each, window);
  result.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  result.processor_s = processor_s() - processor_began_s;
  return result;
}

}  // namespace veduta::bench
