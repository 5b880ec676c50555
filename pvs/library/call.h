// What every call of the installed library that reads does.
#pragma once

#include <functional>

namespace veduta::pvs {

/// Runs what reads a file. Our errors leave as veduta::pvs::Error. HDF5 is left as it was found: the program
/// around us may use it too, with its own printing of errors and its own filter plugins.
[[gnu::visibility("hidden")]] void call(const std::function<void()>& read);

/// The same of what is known not to call HDF5, which takes half the time for a row.
[[gnu::visibility("hidden")]] void call_without_hdf5(const std::function<void()>& read);

}  // namespace veduta::pvs
