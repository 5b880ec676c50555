#include "scene/archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <array>
#include <memory>

#include "scene/text.h"

namespace veduta {
namespace {

using std::string_view_literals::operator""sv;

constexpr uint64_t most_bytes = 16'000'000'000;
constexpr uint64_t always_allowed_bytes = 16'000'000;
constexpr uint64_t largest_ratio = 100;      // text packs to a tenth; what packs better is no model
constexpr uint64_t bytes_of_an_entry = 512;  // a million empty entries are not free either
constexpr size_t block_bytes = 1 << 20;
constexpr size_t longest_path = 4096;  // as on disk

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

class Unpacker {
 public:
  explicit Unpacker(const std::filesystem::path& path)
      : path_(path), name_(printable(path.string(), 1000)), in_(archive_read_new(), archive_read_free) {
    std::error_code ignored;
    const uint64_t size = std::filesystem::file_size(path, ignored);
    limit_ = std::min(most_bytes, always_allowed_bytes + largest_ratio * std::min(size, most_bytes));
    archive_read_support_filter_all(in_.get());
    archive_read_support_format_all(in_.get());
    archive_read_support_format_raw(in_.get());
  }

  Unpacked unpack() {
    if (archive_read_open_filename(in_.get(), path_.c_str(), block_bytes) < ARCHIVE_WARN)
      throw damaged("start");
    archive_entry* entry = nullptr;
    std::string last = "start";
    for (int status = next(entry); status != ARCHIVE_EOF; status = next(entry)) {
      // Raw bytes that no filter has unpacked are a signature and nothing behind it.
      const bool unpacked = archive_format(in_.get()) != ARCHIVE_FORMAT_RAW ||
                            archive_filter_code(in_.get(), 0) != ARCHIVE_FILTER_NONE;
      if (status < ARCHIVE_WARN || !unpacked) throw damaged(last);
      last = take(entry);
    }
    return std::move(result_);
  }

 private:
  int next(archive_entry*& entry) { return archive_read_next_header(in_.get(), &entry); }

  Error damaged(const std::string& place) const {
    const char* const reason = archive_error_string(in_.get());
    return bad_input(
        name_, place,
        fmt::format("the archive cannot be unpacked ({}); it is damaged or cut short, fetch it again",
                    printable(reason == nullptr ? "no reason given" : reason)));
  }

  // The entry's name for messages.
  std::string take(archive_entry* entry) {
    const std::string path = path_of(entry);
    const std::string shown = path.empty() ? "entry without a name" : printable(path, 1000);
    count(bytes_of_an_entry, shown);
    if (archive_entry_is_encrypted(entry))
      throw bad_input(name_, shown, "is encrypted; unpack the archive and give the folder");
    if (path.size() > longest_path)
      throw bad_input(name_, shown,
                      fmt::format("its path is longer than {} bytes; pack the archive again", longest_path));
    const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
    if (path.empty() || normal.is_absolute() || *normal.begin() == "..")
      throw bad_input(name_, shown,
                      "leads out of the archive; pack it again with paths inside of one folder");
    if (archive_entry_filetype(entry) == AE_IFDIR || hidden(normal)) return shown;
    const bool link = archive_entry_hardlink(entry) != nullptr || archive_entry_filetype(entry) != AE_IFREG;
    if (link)
      result_.not_files.push_back(normal.generic_string());
    else
      result_.files.insert_or_assign(normal.generic_string(), content(entry, shown));
    return shown;
  }

  std::string path_of(archive_entry* entry) const {
    // The raw format is of a file that is compressed, and knows no name.
    if (archive_format(in_.get()) == ARCHIVE_FORMAT_RAW) return path_.stem().string();
    // What the current locale cannot show has a name in UTF-8 only.
    const char* const utf8 = archive_entry_pathname_utf8(entry);
    const char* const path = utf8 != nullptr ? utf8 : archive_entry_pathname(entry);
    return path == nullptr ? "" : path;
  }

  static bool hidden(const std::filesystem::path& path) {
    for (const auto& component : path)
      if (component.native().starts_with('.') && component != ".") return true;
    return path.begin() != path.end() && *path.begin() == "__MACOSX";
  }

  // The size that a header states may be a lie: only what was unpacked is believed.
  std::string content(archive_entry* entry, const std::string& shown) {
    std::string bytes;
    if (archive_entry_size_is_set(entry))
      bytes.reserve(
          std::min(static_cast<size_t>(std::max<int64_t>(archive_entry_size(entry), 0)), block_bytes));
    for (;;) {
      const void* block = nullptr;
      size_t size = 0;
      int64_t offset = 0;
      const int status = archive_read_data_block(in_.get(), &block, &size, &offset);
      if (status == ARCHIVE_EOF) break;
      if (status < ARCHIVE_WARN) throw damaged(shown);
      const auto begin = static_cast<uint64_t>(std::max<int64_t>(offset, 0));
      if (begin < bytes.size()) throw damaged(shown);
      count(begin - bytes.size() + size, shown);  // sparse files have gaps
      bytes.resize(begin, '\0');
      bytes.append(static_cast<const char*>(block), size);
    }
    return bytes;
  }

  void count(uint64_t bytes, const std::string& shown) {
    total_ += bytes;
    if (bytes > limit_ || total_ > limit_)
      throw bad_input(
          name_, shown,
          fmt::format("the archive unpacks to more than {:.0f} MB, which is not believed; unpack it "
                      "and give the folder",
                      static_cast<double>(limit_) / 1e6));
  }

  const std::filesystem::path path_;
  const std::string name_;
  Archive in_;
  uint64_t limit_ = 0, total_ = 0;
  Unpacked result_;
};

}  // namespace

bool is_archive(std::string_view head, const std::string& extension) {
  constexpr auto signatures = std::to_array<std::string_view>({"PK\x03\x04"sv, "PK\x05\x06"sv, "\x1f\x8b"sv,
                                                               "\xfd"
                                                               "7zXZ\0"sv,
                                                               "BZh"sv, "\x28\xb5\x2f\xfd"sv,
                                                               "7z\xbc\xaf\x27\x1c"sv, "Rar!\x1a\x07"sv});
  for (const std::string_view signature : signatures)
    if (head.starts_with(signature)) return true;
  return extension == ".tar" || (head.size() >= 262 && head.substr(257, 5) == "ustar");
}

Unpacked unpack_archive(const std::filesystem::path& path) {
  return Unpacker(path).unpack();
}

}  // namespace veduta
