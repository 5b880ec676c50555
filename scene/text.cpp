#include "scene/text.h"

#include <simdjson.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace veduta {

namespace {

InputFile named(const std::filesystem::path& path) {
  InputFile file;
  file.name = printable(path.string(), 1000);
  file.stem = printable(path.stem().string());
  file.extension = extension_of(path);
  return file;
}

Error empty(const InputFile& file) {
  return bad_input(file.name, "file", "is empty (0 bytes); export the model again");
}

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

InputFile input_of(const std::filesystem::path& path, std::string_view content) {
  InputFile file = named(path);
  if (content.empty()) throw empty(file);
  file.bytes.reserve(content.size() + InputFile::padding);
  file.bytes.append(content).append(InputFile::padding, '\0');
  return file;
}

InputFile read_input(const std::filesystem::path& path) {
  InputFile file = named(path);

  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw bad_input(file.name, "file", "does not exist; check the path");
  // A pipe or a device could block or never end.
  if (!std::filesystem::is_regular_file(status))
    throw bad_input(file.name, "file", "is not a regular file; give a model file");
  const uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream)
    throw bad_input(file.name, "file",
                    std::string("cannot be opened (") + std::strerror(errno) + "); check its rights");
  if (size == 0) throw empty(file);

  file.bytes.resize(size + InputFile::padding);
  stream.read(file.bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<uintmax_t>(stream.gcount()) != size)
    throw Error(ExitStatus::input_output, file.name + ": byte " + std::to_string(stream.gcount()) +
                                              ": reading stopped; check the disk and try again");
  return file;
}

std::string printable(std::string_view text, size_t max_bytes) {
  std::string line(text);
  bool cut = false;
  if (line.size() > max_bytes) {
    size_t end = max_bytes;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0u) == 0x80u)
      --end;  // not inside a character
    line.resize(end);
    cut = true;
  }
  const bool utf8 = simdjson::validate_utf8(line.data(), line.size());
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || (byte >= 0x80 && !utf8)) c = '?';
  }
  return cut ? line + "..." : line;
}

Error bad_input(const std::string& file, const std::string& place, const std::string& what) {
  return Error(ExitStatus::bad_input, file + ": " + place + ": " + what);
}

}  // namespace veduta
