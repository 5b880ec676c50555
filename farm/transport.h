// How ranks reach each other. Only mpi_transport.cpp knows MPI.
#pragma once

#include <memory>
#include <optional>

#include "farm/messages.h"

namespace veduta {

struct Received {
  int from = 0;
  Message message;
};

/// Sends never block and receiving polls. A rank may send to itself.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual int local_rank() const = 0;  ///< among the ranks of this host
  virtual int local_size() const = 0;
  virtual void send(int to, const Message& message) = 0;
  virtual std::optional<Received> receive() = 0;
  /// Leaves the job. Never takes longer than ten seconds: then the process ends with `status`.
  virtual void leave(int status) = 0;
};

/// The rank that mpirun or srun gave this process, from its environment; nullopt when it was started alone.
std::optional<int> launched_rank();

/// MPI when started by mpirun or srun, else one rank in this process without MPI (OpenMPI starts a daemon for
/// that).
std::unique_ptr<Transport> make_transport();

/// "Open MPI v4.1.4, ...", for `veduta doctor`.
std::string mpi_version();

}  // namespace veduta
