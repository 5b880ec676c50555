#include "worker/protocol.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <thread>

#include "scene/error.h"

namespace veduta {
namespace {

TEST(Protocol, FramesPassThroughAPipe) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  // Larger than a pipe holds: writer and reader must both take several calls.
  const std::string large(300000, 'x');
  std::thread writer([&] {
    write_frame(ends[1], encode_frame(Verb::hello, "{}"));
    write_frame(ends[1], encode_frame(Verb::failed, large));
    close(ends[1]);
  });
  const auto first = read_frame(ends[0]);
  const auto second = read_frame(ends[0]);
  const auto end = read_frame(ends[0]);
  writer.join();
  close(ends[0]);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->verb, Verb::hello);
  EXPECT_EQ(first->text(), "{}");
  EXPECT_EQ(second->text(), large);
  EXPECT_FALSE(end);
}

TEST(Protocol, BufferGivesWholeFramesWhateverThePieces) {
  auto bytes = encode_frame(Verb::opened, "{\"cells\": 3}");
  const auto more = encode_frame(Verb::lease_done, "");
  bytes.insert(bytes.end(), more.begin(), more.end());
  FrameBuffer buffer;
  std::vector<Frame> frames;
  for (const std::byte each : bytes) {
    buffer.append(&each, 1);
    while (auto frame = buffer.next()) frames.push_back(*frame);
  }
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].text(), "{\"cells\": 3}");
  EXPECT_EQ(frames[1].verb, Verb::lease_done);
  EXPECT_TRUE(frames[1].payload.empty());
}

TEST(Protocol, DamageIsADefectNotAnAllocation) {
  const auto good = encode_frame(Verb::hello, "{}");
  for (const auto& [offset, value] :
       std::vector<std::pair<size_t, uint64_t>>{{0, 0}, {4, 99}, {8, uint64_t{1} << 60}}) {
    auto bad = good;
    std::memcpy(bad.data() + offset, &value, offset == 8 ? 8 : 4);
    FrameBuffer buffer;
    buffer.append(bad.data(), bad.size());
    EXPECT_THROW(buffer.next(), Error) << offset;
  }
}

TEST(Protocol, StreamThatEndsInAFrameIsADefect) {
  const auto good = encode_frame(Verb::hello, "{}");
  for (size_t size = 1; size < good.size(); ++size) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    ASSERT_EQ(write(ends[1], good.data(), size), static_cast<ssize_t>(size));
    close(ends[1]);
    EXPECT_THROW(read_frame(ends[0]), Error) << size;
    close(ends[0]);
  }
}

}  // namespace
}  // namespace veduta
