// Whole files into memory, and foreign text into one printable line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/error.h"

namespace veduta {

/// A file in memory, followed by `padding` bytes that vectorised parsers may read.
struct InputFile {
  static constexpr size_t padding = 64;
  std::string name;       ///< the path as the user gave it, for messages
  std::string stem;       ///< the file name without its extension
  std::string extension;  ///< lower case, with the dot
  std::string bytes;      ///< content and padding

  std::string_view content() const { return std::string_view(bytes).substr(0, bytes.size() - padding); }
};

/// Reads a regular file.
/// \throw Error(bad_input) when it is missing, empty, or not a regular file; Error(input_output) when reading
/// fails.
InputFile read_input(const std::filesystem::path& path);

/// The same from bytes that are in memory already. \throw Error(bad_input) when there are none.
InputFile input_of(const std::filesystem::path& path, std::string_view content);

/// The extension in lower case, with the dot.
std::string extension_of(const std::filesystem::path& path);

/// `text` on one line: control characters and broken UTF-8 become '?', and more than `max_bytes` are cut with
/// "...".
std::string printable(std::string_view text, size_t max_bytes = 120);

/// "FILE: PLACE: what; what to do" with status bad_input.
Error bad_input(const std::string& file, const std::string& place, const std::string& what);

}  // namespace veduta
