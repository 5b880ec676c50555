// The command line of veduta-view.
#pragma once

namespace veduta {

/// \return an ExitStatus as a number. Never throws; errors are one line on standard error.
int view_main(int argc, const char* const* argv);

}  // namespace veduta
