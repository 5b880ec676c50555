// The files of a model: one file, a folder, or an archive.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/text.h"

namespace veduta {

/// Finds a file that a model file refers to, by its path relative to the folder of that model file ('/'
/// between folders, "." and ".." allowed inside of the model). Nothing when there is no such file.
/// \throw Error(bad_input) for a path that leads out of the model; Error as read_input does.
using FindFile = std::function<std::optional<InputFile>(const std::string& relative)>;

}  // namespace veduta
