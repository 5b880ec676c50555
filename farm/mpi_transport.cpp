#include <mpi.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <list>
#include <thread>

#include "farm/transport.h"

namespace veduta {
namespace {

constexpr int tag = 1;

/// One rank: what it sends comes back to itself.
class LocalTransport final : public Transport {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int local_rank() const override { return 0; }
  int local_size() const override { return 1; }
  void send(int, const Message& message) override { queue_.push_back(message); }
  std::optional<Received> receive() override {
    if (queue_.empty()) return std::nullopt;
    Received received{0, queue_.front()};
    queue_.pop_front();
    return received;
  }
  void leave(int) override {}

 private:
  std::deque<Message> queue_;
};

class MpiTransport final : public Transport {
 public:
  MpiTransport() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &host);
    MPI_Comm_rank(host, &local_rank_);
    MPI_Comm_size(host, &local_size_);
    MPI_Comm_free(&host);
    for (Incoming& in : incoming_) post(in);
  }
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int local_rank() const override { return local_rank_; }
  int local_size() const override { return local_size_; }

  void send(int to, const Message& message) override {
    if (to == rank_) {
      own_.push_back(message);
      return;
    }
    // A stopped receiver must not stop the sender: the bytes are kept until MPI has taken them.
    outgoing_.push_back({encode(message), MPI_REQUEST_NULL});
    Outgoing& out = outgoing_.back();
    MPI_Isend(out.bytes.data(), static_cast<int>(out.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
              &out.request);
    if (sent(out)) outgoing_.pop_back();  // nearly always
  }

  std::optional<Received> receive() override {
    if (!own_.empty()) {
      Received received{rank_, own_.front()};
      own_.pop_front();
      return received;
    }
    // Messages match the receives in the order in which these were posted.
    Incoming& in = incoming_[next_];
    int there = 0, size = 0;
    MPI_Status status;
    MPI_Test(&in.request, &there, &status);
    if (!there) {
      outgoing_.remove_if(sent);
      return std::nullopt;
    }
    MPI_Get_count(&status, MPI_BYTE, &size);
    const Received received{status.MPI_SOURCE, decode_message(in.bytes.data(), static_cast<size_t>(size))};
    post(in);
    next_ = (next_ + 1) % incoming_.size();
    return received;
  }

  void leave(int status) override {
    // MPI_Finalize waits for every rank, and for ever when one is stopped, or when a job scheduler has ended
    // the launcher's daemons. Everything is in the journal by now, and a pre-empted job has few seconds.
    std::thread([status] {
      std::this_thread::sleep_for(std::chrono::seconds(3));
      _exit(status);
    }).detach();
    while (!outgoing_.empty()) {
      outgoing_.remove_if(sent);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (Incoming& in : incoming_) {
      MPI_Cancel(&in.request);
      MPI_Wait(&in.request, MPI_STATUS_IGNORE);
    }
    MPI_Finalize();
  }

 private:
  struct Outgoing {
    std::vector<std::byte> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  static bool sent(Outgoing& out) {
    int done = 0;
    MPI_Test(&out.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  }
  /// Posted before anything comes: what is there is taken without asking the network again, and nothing
  /// blocks in a receive whose sender has died.
  struct Incoming {
    std::array<std::byte, message_limit> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  static void post(Incoming& in) {
    MPI_Irecv(in.bytes.data(), static_cast<int>(in.bytes.size()), MPI_BYTE, MPI_ANY_SOURCE, tag,
              MPI_COMM_WORLD, &in.request);
  }
  int rank_ = 0, size_ = 1, local_rank_ = 0, local_size_ = 1;
  std::deque<Message> own_;
  std::list<Outgoing> outgoing_;
  std::vector<Incoming> incoming_ = std::vector<Incoming>(256);
  size_t next_ = 0;  ///< of incoming_: posted first
};

}  // namespace

std::optional<int> launched_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return std::nullopt;
}

std::unique_ptr<Transport> make_transport() {
  if (launched_rank()) return std::make_unique<MpiTransport>();
  return std::make_unique<LocalTransport>();
}

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int size = 0;
  MPI_Get_library_version(text, &size);
  const std::string version(text, static_cast<size_t>(size));
  return version.substr(0, version.find_first_of(",\n"));
}

}  // namespace veduta
