#include "farm/grants.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace veduta {
namespace {

using nlohmann::json;

constexpr size_t block_bytes = 1 << 16;
constexpr size_t line_limit = 4096;            // lines of ours that matter here are shorter
constexpr uint64_t read_limit = 256ull << 20;  // two million grants: more is not worth the wait

/// Hands out the lines of a file, the last one first.
class LinesBackwards {
 public:
  explicit LinesBackwards(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat known {};
    if (descriptor_ >= 0 && fstat(descriptor_, &known) == 0 && S_ISREG(known.st_mode)) {
      position_ = static_cast<uint64_t>(known.st_size);
      end_ = position_ > read_limit ? position_ - read_limit : 0;
    }
  }
  ~LinesBackwards() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  LinesBackwards(const LinesBackwards&) = delete;
  LinesBackwards& operator=(const LinesBackwards&) = delete;

  std::optional<std::string> next() {
    for (;;) {
      const size_t mark = text_.rfind('\n');
      if (mark == std::string::npos && position_ > end_) {
        if (!read_block()) return std::nullopt;
        continue;
      }
      if (mark == std::string::npos && text_.empty()) return std::nullopt;
      const size_t begin = mark == std::string::npos ? 0 : mark + 1;
      const bool whole = !too_long_ && text_.size() - begin <= line_limit;
      std::string line = whole ? text_.substr(begin) : std::string();
      text_.resize(mark == std::string::npos ? 0 : mark);
      too_long_ = false;
      if (!line.empty()) return line;
    }
  }

 private:
  /// Puts the block before `text_` in front of it. A line that is too long is not kept.
  bool read_block() {
    const auto size = static_cast<size_t>(std::min<uint64_t>(block_bytes, position_ - end_));
    std::string block(size, '\0');
    if (pread(descriptor_, block.data(), size, static_cast<off_t>(position_ - size)) !=
        static_cast<ssize_t>(size))
      return false;
    position_ -= size;
    if (text_.size() > line_limit) too_long_ = true, text_.clear();
    text_.insert(0, block);
    return true;
  }

  int descriptor_ = -1;
  uint64_t position_ = 0, end_ = 0;  ///< read down to here; not read beyond here
  std::string text_;                 ///< read and not handed out yet
  bool too_long_ = false;            ///< the last line of `text_` goes on with something that was dropped
};

std::optional<uint32_t> number(const json& line, const char* member) {
  const auto found = line.find(member);
  if (found == line.end() || !found->is_number_unsigned() || found->get<uint64_t>() > UINT32_MAX)
    return std::nullopt;
  return found->get<uint32_t>();
}

bool is_event(const json& line, const char* event) {
  const auto found = line.find("event");
  return found != line.end() && found->is_string() && found->get_ref<const std::string&>() == event;
}

}  // namespace

std::vector<bool> cells_in_hands(const std::filesystem::path& log, uint32_t cell_count) {
  std::vector<bool> held;
  std::set<std::pair<uint32_t, uint32_t>> seen;  // a worker's earlier leases were done before its last one
  LinesBackwards lines(log);
  while (const auto text = lines.next()) {
    // Most lines are others'; to look for the word is quicker than to parse them.
    if (text->find("\"lease\"") == std::string::npos && text->find("\"started\"") == std::string::npos)
      continue;
    const json line = json::parse(*text, nullptr, false);
    if (!line.is_object()) continue;
    if (is_event(line, "started")) break;
    if (!is_event(line, "lease")) continue;
    const auto rank = number(line, "rank"), slot = number(line, "slot"), begin = number(line, "begin"),
               count = number(line, "count");
    if (!rank || !slot || !begin || !count || !seen.emplace(*rank, *slot).second) continue;
    held.resize(cell_count);
    const uint64_t end = std::min<uint64_t>(cell_count, uint64_t{*begin} + *count);
    for (uint64_t cell = *begin; cell < end; ++cell) held[cell] = true;
  }
  return held;
}

std::optional<BakeBegin> last_bake_begin(const std::filesystem::path& log) {
  LinesBackwards lines(log);
  while (const auto text = lines.next()) {
    if (text->find("\"journal\"") == std::string::npos) continue;
    const json line = json::parse(*text, nullptr, false);
    if (!line.is_object()) continue;
    const auto t = line.find("t");
    const auto done = number(line, "done");
    if (is_event(line, "journal") && t != line.end() && t->is_number() && done)
      return BakeBegin{t->get<double>(), *done};
  }
  return std::nullopt;
}

}  // namespace veduta
