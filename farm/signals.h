// Being asked to stop: SIGTERM, SIGINT and SIGUSR1 (DESIGN §8).
#pragma once

#include <string>

namespace veduta {

/// Catches them: the first asks to stop soon. A second Ctrl-C ends this process at once with
/// ExitStatus::stopped_early, wherever it is; its children go with it, and what is in the shards counts.
/// \param last_words  a line for standard error then; empty: none
void install_stop_signals(const std::string& last_words);

/// Was any of them received?
bool stop_requested();

}  // namespace veduta
