// A text file written from parts that are formatted in parallel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "scene/writers/text_buffer.h"

namespace veduta::city {

class OrderedOutput {
 public:
  /// Opens an existing or new file, and empties it. \throw Error(input_output), as every other function does
  explicit OrderedOutput(const std::filesystem::path& file);
  ~OrderedOutput();
  OrderedOutput(const OrderedOutput&) = delete;
  OrderedOutput& operator=(const OrderedOutput&) = delete;

  void write(std::string_view text);

  /// format(0), ..., format(count - 1), each into a buffer of its own; written in this order. The bytes do
  /// not depend on the number of threads, and at most three buffers a thread are in memory.
  void write_parts(size_t count, const std::function<void(size_t part, TextBuffer& text)>& format);

  /// Once, last: an error that the system kept to itself until now comes out here.
  void close();

  uint64_t bytes() const { return bytes_; }
  double seconds_in_system() const { return seconds_; }  ///< of write(2): what the disk costs

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  uint64_t bytes_ = 0;
  double seconds_ = 0;
};

}  // namespace veduta::city
