// The worker's side of the protocol.
#pragma once

#include <string>

namespace veduta {

/// Answers frames from `input` on `output` until `quit` or the end of the stream.
/// An Error is answered with `failed`.
/// \return the exit status of the process.
int run_worker(int input, int output, const std::string& gpu);

}  // namespace veduta
