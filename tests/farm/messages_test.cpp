#include "farm/messages.h"

#include <gtest/gtest.h>

#include "scene/error.h"

namespace veduta {
namespace {

TEST(Messages, ComeBackAsTheyWere) {
  GrantMessage grant;
  grant.lease = 7, grant.slot = 2, grant.begin = 100, grant.count = 64;
  const auto bytes = encode(Message{grant});
  const Message back = decode_message(bytes.data(), bytes.size());
  ASSERT_TRUE(std::holds_alternative<GrantMessage>(back));
  EXPECT_EQ(std::get<GrantMessage>(back).lease, 7u);
  EXPECT_EQ(std::get<GrantMessage>(back).count, 64u);
}

TEST(Messages, PartsAndTheirAnswersComeBackAsTheyWere) {
  PrepareMessage part;
  part.slot = 1, part.life = 3, part.stage = 4, part.part = 70'000;
  auto bytes = encode(Message{part});
  const auto asked = std::get<PrepareMessage>(decode_message(bytes.data(), bytes.size()));
  EXPECT_EQ(asked.life, 3u);
  EXPECT_EQ(asked.part, 70'000u);
  PreparedMessage prepared;
  prepared.again_count = 2, prepared.again[1] = 9, prepared.peak_mb = 0.5;
  bytes = encode(Message{prepared});
  const auto answer = std::get<PreparedMessage>(decode_message(bytes.data(), bytes.size()));
  EXPECT_EQ(answer.again[1], 9u);
  EXPECT_EQ(answer.peak_mb, 0.5);
}

TEST(Messages, LongTextIsCut) {
  FailedMessage failed;
  failed.message = FixedText<1600>(std::string(5000, 'x'));
  const auto bytes = encode(Message{failed});
  EXPECT_LE(bytes.size(), message_limit);
  EXPECT_EQ(std::get<FailedMessage>(decode_message(bytes.data(), bytes.size())).message.text(),
            std::string(1599, 'x'));
}

TEST(Messages, WrongLengthVersionAndVerbAreRefused) {
  const auto good = encode(Message{CellMessage{}});
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(decode_message(good.data(), size), Error) << size;
  for (const size_t offset : {0, 4, 8, 12}) {
    auto bad = good;
    bad[offset] = static_cast<std::byte>(0xee);
    EXPECT_THROW(decode_message(bad.data(), bad.size()), Error) << offset;
  }
}

}  // namespace
}  // namespace veduta
