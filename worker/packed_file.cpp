#include "worker/packed_file.h"

#include <tbb/parallel_for.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>

#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {
namespace {

constexpr uint64_t magic = 0x3130'4b43'5054'4456;  // "VDTPCK01"
constexpr uint64_t best_packing = 1100;            // zlib packs a thousand to one, no more

/// The number of words, then zlib's stream of them. Level 1: neighbouring columns are alike, more effort
/// gains little.
std::vector<char> packed(const std::vector<uint64_t>& words) {
  const uLong raw = words.size() * sizeof(uint64_t);
  uLongf size = compressBound(raw);
  std::vector<char> bytes(sizeof(uint64_t) + size);
  const uint64_t count = words.size();
  std::copy_n(reinterpret_cast<const char*>(&count), sizeof(count), bytes.data());
  if (compress2(reinterpret_cast<Bytef*>(bytes.data() + sizeof(count)), &size,
                reinterpret_cast<const Bytef*>(words.data()), raw, 1) != Z_OK)
    throw Error(ExitStatus::defect, "preparation: zlib cannot pack a part of a file");
  bytes.resize(sizeof(count) + size);
  return bytes;
}

}  // namespace

void replace_unsynced(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path temporary = temporary_name(file, ::getpid());
  std::error_code error;
  try {
    write(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
  std::filesystem::rename(temporary, file, error);
  if (error) throw Error(ExitStatus::input_output, file.string() + ": " + error.message());
}

void write_packed(const std::filesystem::path& file, size_t parts, const PartWords& words_of) {
  std::vector<std::vector<char>> bytes(parts);
  tbb::parallel_for(size_t{0}, parts, [&](size_t p) { bytes[p] = packed(words_of(p)); });
  std::vector<uint64_t> header{magic, parts};
  uint64_t at = (header.size() + parts + 1) * sizeof(uint64_t);
  for (const auto& part : bytes) header.push_back(at), at += part.size();
  header.push_back(at);
  replace_unsynced(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(header.data()),
              static_cast<std::streamsize>(header.size() * sizeof(uint64_t)));
    for (const auto& part : bytes) out.write(part.data(), static_cast<std::streamsize>(part.size()));
    out.close();
    if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
  });
}

PackedFile::PackedFile(const std::filesystem::path& file, size_t parts)
    : file_(file), in_(file, std::ios::binary), begin_(parts + 1) {
  uint64_t start[2] = {0, 0};
  in_.read(reinterpret_cast<char*>(start), sizeof(start));
  if (!in_ || start[0] != magic || start[1] != parts) damaged();
  in_.read(reinterpret_cast<char*>(begin_.data()),
           static_cast<std::streamsize>(begin_.size() * sizeof(uint64_t)));
  const std::streamoff first = in_.tellg();
  in_.seekg(0, std::ios::end);
  if (!in_ || !std::is_sorted(begin_.begin(), begin_.end()) ||
      begin_.front() != static_cast<uint64_t>(first) || begin_.back() != static_cast<uint64_t>(in_.tellg()))
    damaged();
}

std::vector<uint64_t> PackedFile::read(size_t part) {
  std::vector<char> bytes(begin_[part + 1] - begin_[part]);
  in_.seekg(static_cast<std::streamoff>(begin_[part]));
  in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  uint64_t count = 0;
  if (!in_ || bytes.size() < sizeof(count)) damaged();
  std::copy_n(bytes.data(), sizeof(count), reinterpret_cast<char*>(&count));
  if (count / best_packing * sizeof(uint64_t) > bytes.size()) damaged();
  std::vector<uint64_t> words(count);
  uLongf size = count * sizeof(uint64_t);
  if (uncompress(reinterpret_cast<Bytef*>(words.data()), &size,
                 reinterpret_cast<const Bytef*>(bytes.data() + sizeof(count)),
                 bytes.size() - sizeof(count)) != Z_OK ||
      size != count * sizeof(uint64_t))
    damaged();
  return words;
}

void PackedFile::damaged() const {
  throw Error(ExitStatus::bad_input,
              file_.string() + ": missing or damaged; remove the folder it is in and bake again");
}

}  // namespace veduta
