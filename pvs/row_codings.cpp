#include "pvs/row_codings.h"

namespace veduta {

namespace {

/// How long bytes are when their runs of zeros are counted. Bytes that are passed over are zeros.
class ZeroRuns {
 public:
  /// The byte at a position, after those before it.
  void put(uint64_t position, int byte) {
    if (byte == 0) return;
    bytes_ += run(position - next_) + 1;
    next_ = position + 1;
  }
  uint64_t finish(uint64_t length) const { return bytes_ + run(length - next_); }

 private:
  static uint64_t run(uint64_t zeros) { return 2 * ((zeros + 254) / 255); }

  uint64_t next_ = 0, bytes_ = 0;
};

}  // namespace

RowCodings row_codings(const PvsEntry* first, const PvsEntry* last, uint64_t objects) {
  RowCodings out{3 * objects, 0, (objects + 7) / 8, 0};
  ZeroRuns three, bits;
  for (const PvsEntry* entry = first; entry != last; ++entry) {
    const uint64_t at = 3 * uint64_t{entry->object};
    three.put(at, entry->index.x);
    three.put(at + 1, entry->index.y);
    three.put(at + 2, entry->index.z);
    if (entry == first || entry->object / 8 != (entry - 1)->object / 8) bits.put(entry->object / 8, 1);
  }
  out.three_bytes_runs = three.finish(out.three_bytes);
  out.bits_runs = bits.finish(out.bits);
  return out;
}

}  // namespace veduta
