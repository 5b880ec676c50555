#include "scene/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "scene/error.h"

namespace veduta {
namespace {

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = ::testing::TempDir() + "atomic_file_XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    file_ = folder_ / "a.txt";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) {
    write_atomically(file_,
                     [&](const std::filesystem::path& temporary) { std::ofstream(temporary) << text; });
  }
  std::string read() const {
    std::string text;
    std::getline(std::ifstream(file_), text);
    return text;
  }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) out.push_back(entry.path());
    return out;
  }

  std::filesystem::path folder_, file_;
};

TEST_F(AtomicFile, IsThereWholeOrNotAtAll) {
  write("old");
  EXPECT_THROW(write_atomically(file_,
                                [](const std::filesystem::path& temporary) {
                                  std::ofstream(temporary) << "ha";
                                  throw Error(ExitStatus::input_output, "the disk is full");
                                }),
               Error);
  EXPECT_EQ(read(), "old");
  EXPECT_EQ(files(), std::vector{file_});
  write("new");
  EXPECT_EQ(read(), "new");
  EXPECT_EQ(files(), std::vector{file_});
}

TEST_F(AtomicFile, WhatADeadWriterLeftIsRemovedAndALivingOnesStays) {
  std::ofstream(temporary_name(file_, 1)) << "dead";
  write_atomically(file_, [&](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "alive";
    remove_dead_temporaries(file_);
    EXPECT_EQ(files(), std::vector{temporary});
  });
  EXPECT_EQ(read(), "alive");
}

/// Whoever looks for dead writers holds a file's lock for a moment, in which its writer may begin.
TEST_F(AtomicFile, WritersAreNotStoppedByThoseWhoLookForDeadOnes) {
  std::atomic<bool> writing = true;
  std::thread remover([&] {
    while (writing) remove_dead_temporaries(file_);
  });
  for (int i = 0; i < 300; ++i) EXPECT_NO_THROW(write(std::to_string(i)));
  writing = false;
  remover.join();
  EXPECT_EQ(read(), "299");
}

TEST_F(AtomicFile, AWriterOfTheSameNumberElsewhereIsWaitedForAndThenNamed) {
  const std::string name = temporary_name(file_, ::getpid());
  const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  EXPECT_THROW(write("mine"), Error);
  std::thread owner([&] {
    ::usleep(200'000);
    ::close(descriptor);
  });
  EXPECT_NO_THROW(write("mine"));
  owner.join();
  EXPECT_EQ(read(), "mine");
}

}  // namespace
}  // namespace veduta
