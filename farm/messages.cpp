#include "farm/messages.h"

#include <cstring>
#include <type_traits>
#include <utility>

#include "scene/error.h"

namespace veduta {
namespace {

struct Header {
  uint32_t magic = 0x4d544456;  // "VDTM"
  uint32_t version = 3;
  uint32_t verb = 0;
  uint32_t size = 0;
};

template <size_t I>
bool decode_as(const Header& header, const std::byte* payload, Message& into) {
  using Type = std::variant_alternative_t<I, Message>;
  static_assert(std::is_trivially_copyable_v<Type> && sizeof(Header) + sizeof(Type) <= message_limit);
  if (header.verb != Type::verb) return false;
  if (header.size != sizeof(Type))
    throw Error(ExitStatus::defect, "a message between ranks has the wrong length");
  Type message;
  std::memcpy(&message, payload, sizeof message);
  into = message;
  return true;
}

template <size_t... I>
bool decode_any(const Header& header, const std::byte* payload, Message& into, std::index_sequence<I...>) {
  return (decode_as<I>(header, payload, into) || ...);
}

}  // namespace

std::vector<std::byte> encode(const Message& message) {
  return std::visit(
      [](const auto& each) {
        Header header;
        header.verb = each.verb, header.size = sizeof each;
        std::vector<std::byte> bytes(sizeof header + sizeof each);
        std::memcpy(bytes.data(), &header, sizeof header);
        std::memcpy(bytes.data() + sizeof header, &each, sizeof each);
        return bytes;
      },
      message);
}

Message decode_message(const std::byte* data, size_t size) {
  Header header, ours;
  if (size < sizeof header) throw Error(ExitStatus::defect, "a message between ranks is too short");
  std::memcpy(&header, data, sizeof header);
  if (header.magic != ours.magic || header.version != ours.version)
    throw Error(ExitStatus::defect,
                "a message between ranks is of another version; every host must run the same veduta");
  if (header.size != size - sizeof header)
    throw Error(ExitStatus::defect, "a message between ranks has the wrong length");
  Message message;
  if (!decode_any(header, data + sizeof header, message,
                  std::make_index_sequence<std::variant_size_v<Message>>()))
    throw Error(ExitStatus::defect, "a message between ranks has an unknown verb");
  return message;
}

}  // namespace veduta
