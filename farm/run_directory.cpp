#include "farm/run_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "pvs/pvs_file.h"
#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/sync_path.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string worker_name(uint32_t attempt, int rank, uint32_t slot) {
  return fmt::format("{:04}-{:04}-{:02}", attempt, rank, slot);
}

fs::path worker_logs(const RunPaths& run) {
  return run.directory / "workers";
}
fs::path counts_file(const RunPaths& run) {
  return run.prepared() / "counts.json";
}

[[noreturn]] void cannot_write(const fs::path& file, int code) {
  throw Error(ExitStatus::input_output,
              fmt::format("{}: cannot be written: {}; {}", file.string(), std::strerror(code),
                          code == ENOSPC ? "make room and start again" : "choose another --out"));
}

void make_directory(const fs::path& directory) {
  std::error_code code;
  fs::create_directories(directory, code);
  if (code) cannot_write(directory, code.value());
}

/// 0 or errno.
int write_and_sync(const fs::path& file, const std::string& content) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int failure = 0;
  for (size_t done = 0; failure == 0 && done < content.size();) {
    const ssize_t wrote = write(descriptor, content.data() + done, content.size() - done);
    if (wrote >= 0)
      done += static_cast<size_t>(wrote);
    else if (errno != EINTR)
      failure = errno;
  }
  if (failure == 0 && fsync(descriptor) != 0) failure = errno;
  if (close(descriptor) != 0 && failure == 0) failure = errno;
  return failure;
}

}  // namespace

fs::path shard_file(const RunPaths& run, uint32_t attempt, int rank, uint32_t slot) {
  return run.shards() / (worker_name(attempt, rank, slot) + ".shard");
}

fs::path all_visible_shard_file(const RunPaths& run, uint32_t attempt) {
  return run.shards() / fmt::format("{:04}-all-visible.shard", attempt);
}

fs::path worker_log(const RunPaths& run, uint32_t attempt, int rank, uint32_t slot) {
  return worker_logs(run) / (worker_name(attempt, rank, slot) + ".log");
}

fs::path unfinished_preparation(const RunPaths& run) {
  return run.directory / "prepared.tmp";
}

void remove_unfinished_preparation(const RunPaths& run) {
  std::error_code ignored;
  fs::remove_all(unfinished_preparation(run), ignored);
}

uint32_t next_attempt(const RunPaths& run) {
  uint32_t highest = 0;
  for (const fs::path& directory : {run.shards(), worker_logs(run)}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(directory, ignored))
      highest = std::max(highest,
                         static_cast<uint32_t>(std::strtoul(entry.path().filename().c_str(), nullptr, 10)));
  }
  return highest + 1;
}

void make_run_directory(const RunPaths& run) {
  for (const fs::path& directory : {run.directory, run.shards(), worker_logs(run)}) make_directory(directory);
}

void require_shared_run(const RunPaths& run, const std::string& fingerprint) {
  // A network file system may show what another host has just made a moment later.
  std::optional<std::string> seen;
  for (int tries = 0; tries < 20; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(std::chrono::milliseconds(250));
    seen = read_text_file(run.fingerprint());
    if (seen && seen->substr(0, seen->find('\n')) == fingerprint) return;
  }
  throw Error(ExitStatus::input_output,
              fmt::format("{}: {}; --out must lie on a file system that every host sees at the same path",
                          fs::absolute(run.directory).string(),
                          seen ? "holds another job than it does on the host of rank 0"
                               : "the run directory of rank 0 is not here"));
}

bool is_run_directory(const RunPaths& run) {
  std::error_code ignored;
  return fs::exists(run.lock(), ignored);
}

void remove_unfinished_files(const RunPaths& run) {
  for (const fs::path& file : {run.result(), run.settings(), run.fingerprint(), run.report()})
    remove_dead_temporaries(file);
}

void remove_run(const RunPaths& run) {
  for (const fs::path& each : {run.shards(), run.prepared(), unfinished_preparation(run), worker_logs(run),
                               run.settings(), run.fingerprint(), run.log(), run.report(), run.result()}) {
    std::error_code code;
    fs::remove_all(each, code);
    if (code) cannot_write(each, code.value());
  }
}

void write_file_atomically(const fs::path& file, const std::string& content) {
  const fs::path temporary = file.string() + fmt::format(".tmp.{}", getpid());
  if (const int failure = write_and_sync(temporary, content); failure != 0) {
    unlink(temporary.c_str());
    cannot_write(file, failure);
  }
  if (rename(temporary.c_str(), file.c_str()) != 0) {
    const int failure = errno;
    unlink(temporary.c_str());
    cannot_write(file, failure);
  }
  sync_path(file.has_parent_path() ? file.parent_path() : ".");
}

std::optional<std::string> read_text_file(const fs::path& file) {
  std::error_code code;
  if (!fs::exists(file, code) && !code) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  std::string text;
  char block[1 << 16];
  while (in.read(block, sizeof block) || in.gcount() > 0)
    text.append(block, static_cast<size_t>(in.gcount()));
  if (!in.eof()) throw Error(ExitStatus::input_output, file.string() + ": cannot be read");
  return text;
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const auto size = static_cast<std::streamoff>(in.tellg());
  in.seekg(std::max<std::streamoff>(0, size - 4096));
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last.substr(0, 300);
}

std::optional<CityCounts> read_city_counts(const RunPaths& run) {
  std::error_code code;
  if (!fs::exists(run.city(), code)) return std::nullopt;
  const json counts = json::parse(read_text_file(counts_file(run)).value_or(""), nullptr, false);
  if (counts.is_object() && counts.contains("cells") && counts["cells"].is_number_unsigned())
    return CityCounts{counts["cells"].get<uint64_t>(), counts.value("objects", uint64_t{0}),
                      counts.value("triangles", uint64_t{0})};
  const City city = read_city(run.city());
  return CityCounts{city.cells.size(), city.scene.objects.size(), city.scene.triangles.size()};
}

void write_city_counts(const RunPaths& run, const CityCounts& counts) {
  write_file_atomically(
      counts_file(run),
      json{{"cells", counts.cells}, {"objects", counts.objects}, {"triangles", counts.triangles}}.dump() +
          "\n");
}

}  // namespace veduta
