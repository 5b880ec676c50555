// What ranks say to each other: small control messages of fixed size. Results never travel by MPI: a large
// message from a dying rank blocks its receiver for ever (OpenMPI 4.1). One struct a verb; version and length
// are checked before the copy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "worker/protocol.h"

namespace veduta {

/// Text of bounded length; longer text is cut at the end.
template <size_t N>
struct FixedText {
  std::array<char, N> characters{};

  FixedText() = default;
  explicit FixedText(const std::string& text) { text.copy(characters.data(), N - 1); }
  std::string text() const {
    size_t size = 0;
    while (size < N && characters[size] != '\0') ++size;
    return {characters.data(), size};
  }
};

// --- coordinator to shepherd
// -----------------------------------------------------------------------------------------
struct StartMessage {  ///< begin: start the children; they say when they wait for a part of the preparation
  static constexpr uint32_t verb = 1;
  uint32_t attempt = 0;
  FixedText<64> fingerprint;
};
struct PrepareMessage {  ///< a part of the preparation for the child that waits in `slot`
  static constexpr uint32_t verb = 2;
  uint32_t slot = 0;
  uint32_t life = 0;  ///< of WaitingMessage: when that child died meanwhile, its successor does not begin
  uint32_t stage = 0, part = 0;
};
struct OpenMessage {  ///< prepared/ is there: every child opens it
  static constexpr uint32_t verb = 3;
};
struct GrantMessage {
  static constexpr uint32_t verb = 4;
  uint64_t lease = 0;
  uint32_t slot = 0, begin = 0, count = 0;
};
struct FinishMessage {  ///< stop; `drain` lets children finish the cell in hand. Answered by LeftMessage.
  static constexpr uint32_t verb = 5;
  uint32_t drain = 0;
};
struct GoodbyeMessage {  ///< everything is done: leave the MPI job together
  static constexpr uint32_t verb = 6;
};

// --- shepherd to coordinator
// -----------------------------------------------------------------------------------------
struct ReadyMessage {  ///< the shepherd has started `workers` children
  static constexpr uint32_t verb = 16;
  uint32_t workers = 0;
  FixedText<64> host;
};
struct WaitingMessage {  ///< the child can do a part of the preparation
  static constexpr uint32_t verb = 17;
  uint32_t slot = 0;
  uint32_t life = 0;  ///< how many children the slot has had
};
struct PreparedMessage {  ///< the part is done. A WaitingMessage follows
  static constexpr uint32_t verb = 18;
  uint32_t slot = 0;
  uint32_t tiles = 0, blocks = 0;                  ///< of the import
  uint64_t cells = 0, objects = 0, triangles = 0;  ///< of the finish
  uint32_t again_count = 0;                        ///< of the flood: tiles to be flooded again
  std::array<uint32_t, neighbour_limit> again{};
  double seconds = 0, peak_mb = 0;
};
struct IdleMessage {  ///< the child has opened the city and waits for a lease
  static constexpr uint32_t verb = 19;
  uint32_t slot = 0;
  FixedText<200> renderer;
};
struct CellMessage {  ///< a cell's record is in the shard
  static constexpr uint32_t verb = 20;
  uint64_t lease = 0;
  uint32_t cell = 0, bake_us = 0;
};
struct LeaseDoneMessage {
  static constexpr uint32_t verb = 21;
  uint64_t lease = 0;
  uint32_t slot = 0;
};
struct LostMessage {  ///< a child died; `lease` is 0 when it held none. `given_up`: the slot stays empty
  static constexpr uint32_t verb = 22;
  uint64_t lease = 0;
  uint32_t slot = 0, given_up = 0;
  uint32_t preparing = 0;  ///< it had begun a part of the preparation
  int32_t status = 0;      ///< an ExitStatus: what the bake ends with when that is no use any more
  FixedText<400> reason;
};
struct FailedMessage {  ///< an error that trying again does not mend: the bake stops with it
  static constexpr uint32_t verb = 23;
  int32_t status = 0;
  FixedText<1600> message;
};
struct NoteMessage {  ///< a line for the log
  static constexpr uint32_t verb = 24;
  FixedText<400> text;
};
struct LeftMessage {  ///< children gone, shards synced and closed
  static constexpr uint32_t verb = 25;
};
struct HeartbeatMessage {  ///< every second: the shepherd is there, whatever its children do
  static constexpr uint32_t verb = 26;
};

using Message =
    std::variant<StartMessage, PrepareMessage, OpenMessage, GrantMessage, FinishMessage, GoodbyeMessage,
                 ReadyMessage, WaitingMessage, PreparedMessage, IdleMessage, CellMessage, LeaseDoneMessage,
                 LostMessage, FailedMessage, NoteMessage, LeftMessage, HeartbeatMessage>;

/// Below the size that OpenMPI sends without waiting for the receiver.
inline constexpr size_t message_limit = 2048;

std::vector<std::byte> encode(const Message& message);
/// \throw Error(defect) for bytes that are not one message of this version.
Message decode_message(const std::byte* data, size_t size);

}  // namespace veduta
