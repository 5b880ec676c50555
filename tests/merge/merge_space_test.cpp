// Disks that are small for real (R7): file systems in memory, in a namespace of their own, so that nobody
// else sees them and they are gone with the process. Skipped where no namespace may be made.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>

#include "tests/merge/run_directory.h"

namespace veduta {
namespace {

using test::job;
using test::read_bytes;
using test::RunDirectory;
using test::small_city;
using test::status_of;

void write_text(const char* file, const std::string& text) {
  std::ofstream(file) << text;
}

bool mount_small(const std::filesystem::path& where, const char* options) {
  const std::string user = std::to_string(::getuid()), group = std::to_string(::getgid());
  if (::unshare(CLONE_NEWNS) != 0) {
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    write_text("/proc/self/setgroups", "deny");
    write_text("/proc/self/uid_map", "0 " + user + " 1");
    write_text("/proc/self/gid_map", "0 " + group + " 1");
  }
  return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("none", where.c_str(), "tmpfs", 0, options) == 0;
}

constexpr int no_mount = 200;

/// Runs `work` in a child that has a file system of its own at `where`. \return what it returned.
template <typename Work>
int on_small_disk(const std::filesystem::path& where, const char* options, const Work& work) {
  std::filesystem::create_directories(where);
  const pid_t child = ::fork();
  if (child == 0) {
    if (!mount_small(where, options)) ::_exit(no_mount);
    const int result = work();
    ::_exit(testing::Test::HasFailure() ? 201 : result);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  return WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
}

#define SKIP_WITHOUT_MOUNT(result) \
  if ((result) == no_mount) GTEST_SKIP() << "no file system may be mounted here, also not in a namespace"

std::vector<std::string> names_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename());
  return names;
}

/// About 1,500 objects that nothing can pack well: half a bit each for which they are, and one for how.
CellRecord noisy_record(uint32_t cell) {
  std::minstd_rand random(cell + 1);
  CellRecord r{cell, CellStatus::baked, 1, {}};
  for (uint32_t i = 0; i < 3000; ++i)
    if (const uint32_t bits = random() >> 9; bits & 1)
      r.row.push_back({i, {0, 0, static_cast<int8_t>(1 + (bits >> 1) % 2)}});
  return r;
}

TEST(MergeSpace, JournalOnADiskOf2MbKeepsEveryRecordThatItTook) {
  test::TemporaryDirectory directory;
  const int result = on_small_disk(directory / "disk", "size=2m", [&] {
    const auto file = directory / "disk/a";
    uint32_t taken = 0;
    ShardWriter writer(file, job, "llvmpipe");
    std::string message;
    const ExitStatus full = status_of(
        [&] {
          for (; taken < 100000; ++taken) writer.append(noisy_record(taken));
        },
        &message);
    EXPECT_EQ(full, ExitStatus::input_output);
    EXPECT_NE(message.find("No space left on device; free some space"), std::string::npos) << message;
    EXPECT_GT(taken, 50u);
    uint32_t next = 0;
    const ShardScan scan = scan_shard(file, job, [&](CellRecord&& r, uint64_t) {
      EXPECT_TRUE(r.same_answer(noisy_record(next)));
      ++next;
    });
    EXPECT_EQ(next, taken);
    EXPECT_EQ(scan.torn_bytes, 0u);
    // Without room not even a new shard can be begun: also that is said.
    EXPECT_EQ(status_of([&] {
                ShardWriter other(directory / "disk/b", job, "llvmpipe");
                for (uint32_t c = 0; c < 1000; ++c) other.append(noisy_record(c));
              }),
              ExitStatus::input_output);
    return 0;
  });
  SKIP_WITHOUT_MOUNT(result);
  EXPECT_EQ(result, 0);
}

TEST(MergeSpace, MergeOnADiskOf8MbKeepsTheOldFileAndWorksWithRoomAgain) {
  constexpr uint32_t cells = 4000;
  RunDirectory run(small_city(3000, cells));
  {
    ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
    for (uint32_t c = 0; c < cells; ++c) writer.append(noisy_record(c));
  }
  const auto disk = run.directory / "disk", file = disk / "city.pvs.h5";
  const int result = on_small_disk(disk, "size=8m", [&] {
    test::write_bytes(file, "the old file");
    test::write_bytes(disk / "others", std::string(3u << 20, 'x'));
    std::string message;
    EXPECT_EQ(status_of([&] { merge_run(run.paths, file, false); }, &message), ExitStatus::input_output);
    EXPECT_NE(message.find("full"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(read_bytes(file) == "the old file");
    EXPECT_EQ(names_in(disk).size(), 2u);
    return 0;
  });
  SKIP_WITHOUT_MOUNT(result);
  EXPECT_EQ(result, 0);
  const int with_room = on_small_disk(disk, "size=64m", [&] {
    EXPECT_EQ(merge_run(run.paths, file, false).baked, cells);
    EXPECT_EQ(read_pvs(file).row(7).size(), noisy_record(7).row.size());
    return 0;
  });
  EXPECT_EQ(with_room, 0);
}

/// Somebody else fills the disk behind the merger's back, so that asking for room beforehand does not help.
TEST(MergeSpace, DiskThatFillsUpMeanwhile) {
  constexpr uint32_t cells = 4000;
  RunDirectory run(small_city(3000, cells));
  {
    ShardWriter writer(run.paths.shards() / "a", job, "llvmpipe");
    for (uint32_t c = 0; c < cells; ++c) writer.append(noisy_record(c));
  }
  const auto disk = run.directory / "disk", file = disk / "city.pvs.h5";
  const int result = on_small_disk(disk, "size=24m", [&] {
    test::write_bytes(file, "the old file");
    for (int i = 0; i < 6; ++i) {
      const pid_t other = ::fork();
      if (other == 0) {
        ::usleep(static_cast<useconds_t>(5000 * i * i));
        const int hog = ::open((disk / "hog").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const std::string block(4096, 'x');
        for (;;)
          if (::write(hog, block.data(), block.size()) < 0) ::usleep(200);
      }
      std::string message;
      const ExitStatus status = status_of([&] { merge_run(run.paths, file, false); }, &message);
      ::kill(other, SIGKILL);
      ::waitpid(other, nullptr, 0);
      std::filesystem::remove(disk / "hog");
      EXPECT_EQ(status, ExitStatus::input_output) << i;
      EXPECT_TRUE(read_bytes(file) == "the old file") << i;
      EXPECT_EQ(names_in(disk).size(), 1u) << i;
    }
    return 0;
  });
  SKIP_WITHOUT_MOUNT(result);
  EXPECT_EQ(result, 0);
}

TEST(MergeSpace, ReadOnlyPlaceIsSaid) {
  RunDirectory run;
  run.whole();
  const auto disk = run.directory / "disk";
  const int result = on_small_disk(disk, "size=8m", [&] {
    test::write_bytes(disk / "a.h5", "the old file");
    if (::mount("none", disk.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) != 0) return no_mount;
    std::string message;
    EXPECT_EQ(status_of([&] { merge_run(run.paths, disk / "a.h5", false); }, &message),
              ExitStatus::input_output);
    EXPECT_NE(message.find("Read-only file system"), std::string::npos) << message;
    EXPECT_EQ(status_of([&] { ShardWriter(disk / "s", job, ""); }, &message), ExitStatus::input_output);
    EXPECT_NE(message.find("Read-only file system"), std::string::npos) << message;
    EXPECT_TRUE(read_bytes(disk / "a.h5") == "the old file");
    return 0;
  });
  SKIP_WITHOUT_MOUNT(result);
  EXPECT_EQ(result, 0);
}

}  // namespace
}  // namespace veduta
