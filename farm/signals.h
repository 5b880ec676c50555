// Asking a running bake to stop: SIGTERM, SIGINT and SIGUSR1 (Slurm, mpirun and people send them, some of
// them twice).
#pragma once

namespace veduta {

void install_stop_signals();
/// Some stop signal came.
bool stop_requested();
/// A person pressed Ctrl-C again.
bool stop_at_once_requested();

}  // namespace veduta
