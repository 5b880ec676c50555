#include "scene/writers/ordered_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/concurrent_queue.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>

#include "scene/error.h"

namespace veduta::city {

OrderedOutput::OrderedOutput(const std::filesystem::path& file) : file_(file) {
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot create the file");
}

OrderedOutput::~OrderedOutput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OrderedOutput::fail(const char* what) const {
  throw Error(ExitStatus::input_output,
              fmt::format("{}: {}: {}", file_.string(), what, std::strerror(errno)));
}

void OrderedOutput::write(std::string_view text) {
  const auto begin = std::chrono::steady_clock::now();
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write; free some space or choose another place");
    bytes_ += static_cast<uint64_t>(written);
    text.remove_prefix(static_cast<size_t>(written));
  }
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void OrderedOutput::write_parts(size_t count,
                                const std::function<void(size_t part, TextBuffer& text)>& format) {
  struct Part {
    size_t number = 0;
    TextBuffer text;
  };
  // The tokens are plain pointers: a pipeline that ends by an exception forgets those that are under way.
  std::deque<Part> parts;
  tbb::concurrent_queue<Part*> idle;  // parts that were written: their buffers are large
  size_t next = 0;
  const auto start = [&](tbb::flow_control& control) -> Part* {
    if (next == count) {
      control.stop();
      return nullptr;
    }
    Part* part = nullptr;
    if (!idle.try_pop(part)) part = &parts.emplace_back();
    part->number = next++;
    return part;
  };
  const auto fill = [&](Part* part) {
    part->text.clear();
    format(part->number, part->text);
    return part;
  };
  const auto finish = [&](Part* part) {
    write(part->text.view());
    idle.push(part);
  };
  tbb::parallel_pipeline(static_cast<size_t>(3 * tbb::this_task_arena::max_concurrency()),
                         tbb::make_filter<void, Part*>(tbb::filter_mode::serial_in_order, start) &
                             tbb::make_filter<Part*, Part*>(tbb::filter_mode::parallel, fill) &
                             tbb::make_filter<Part*, void>(tbb::filter_mode::serial_in_order, finish));
}

void OrderedOutput::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail("cannot close");
}

}  // namespace veduta::city
