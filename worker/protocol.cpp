#include "worker/protocol.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/error.h"

namespace veduta {
namespace {

// The wire is little-endian; so is every machine that Debian 12 runs EGL on, hence plain copies.
struct WireHeader {
  uint32_t magic = 0;
  uint32_t verb = 0;
  uint64_t size = 0;
};
static_assert(sizeof(WireHeader) == 16);

bool known(uint32_t verb) {
  return (verb >= static_cast<uint32_t>(Verb::prepare) && verb <= static_cast<uint32_t>(Verb::quit)) ||
         (verb >= static_cast<uint32_t>(Verb::hello) && verb <= static_cast<uint32_t>(Verb::failed));
}

WireHeader checked_header(const std::byte* data) {
  WireHeader header;
  std::memcpy(&header, data, sizeof header);
  if (header.magic != frame_magic)
    throw Error(ExitStatus::defect,
                "worker stream: no frame where one should begin; something else wrote to standard output");
  if (!known(header.verb))
    throw Error(ExitStatus::defect, "worker stream: unknown verb " + std::to_string(header.verb) +
                                        "; veduta and veduta-worker must be of the same version");
  if (header.size > frame_payload_limit)
    throw Error(ExitStatus::defect,
                "worker stream: a frame of " + std::to_string(header.size) + " bytes is damaged");
  return header;
}

/// Reads until `size` bytes are there or the stream ends; says how many came.
size_t read_fully(int descriptor, std::byte* into, size_t size) {
  size_t got = 0;
  while (got < size) {
    const ssize_t n = ::read(descriptor, into + got, size - got);
    if (n == 0) break;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error(ExitStatus::input_output,
                  std::string("worker stream: cannot read: ") + std::strerror(errno));
    got += static_cast<size_t>(n);
  }
  return got;
}

}  // namespace

std::vector<std::byte> encode_frame(Verb verb, const std::byte* payload, size_t size) {
  if (size > frame_payload_limit)
    throw Error(ExitStatus::defect,
                "worker stream: a frame of " + std::to_string(size) + " bytes is too large to send");
  const WireHeader header{frame_magic, static_cast<uint32_t>(verb), size};
  std::vector<std::byte> bytes(sizeof header + size);
  std::memcpy(bytes.data(), &header, sizeof header);
  if (size > 0) std::memcpy(bytes.data() + sizeof header, payload, size);
  return bytes;
}

std::vector<std::byte> encode_frame(Verb verb, const std::string& json) {
  return encode_frame(verb, reinterpret_cast<const std::byte*>(json.data()), json.size());
}

std::optional<Frame> read_frame(int descriptor) {
  std::byte raw[sizeof(WireHeader)];
  const size_t got = read_fully(descriptor, raw, sizeof raw);
  if (got == 0) return std::nullopt;
  if (got < sizeof raw) throw Error(ExitStatus::defect, "worker stream: it ends in the middle of a frame");
  const WireHeader header = checked_header(raw);
  Frame frame{static_cast<Verb>(header.verb), std::vector<std::byte>(header.size)};
  if (read_fully(descriptor, frame.payload.data(), frame.payload.size()) < frame.payload.size())
    throw Error(ExitStatus::defect, "worker stream: it ends in the middle of a frame");
  return frame;
}

void write_frame(int descriptor, const std::vector<std::byte>& encoded) {
  size_t done = 0;
  while (done < encoded.size()) {
    const ssize_t n = ::write(descriptor, encoded.data() + done, encoded.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error(ExitStatus::input_output,
                  std::string("worker stream: cannot write: ") + std::strerror(errno));
    done += static_cast<size_t>(n);
  }
}

std::optional<Frame> FrameBuffer::next() {
  const size_t there = bytes_.size() - begin_;
  if (there < sizeof(WireHeader)) return std::nullopt;
  const WireHeader header = checked_header(bytes_.data() + begin_);
  if (there - sizeof(WireHeader) < header.size) return std::nullopt;
  const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(begin_ + sizeof(WireHeader));
  Frame frame{static_cast<Verb>(header.verb), {first, first + static_cast<std::ptrdiff_t>(header.size)}};
  begin_ += sizeof(WireHeader) + header.size;
  // Dropping what was read only now and then keeps the cost of a frame proportional to its own size.
  if (begin_ == bytes_.size() || begin_ > (1u << 20)) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  return frame;
}

}  // namespace veduta
