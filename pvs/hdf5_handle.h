// HDF5 identifiers that close themselves, and the state of the library that every use of it here relies on.
#pragma once

#include <hdf5.h>

#include <utility>

namespace veduta::hdf5 {

/// Owns one HDF5 identifier. Negative: none.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  ~Handle() { close(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, -1);
      close_ = other.close_;
    }
    return *this;
  }

  bool valid() const { return id_ >= 0; }
  hid_t get() const { return id_; }
  /// Closing is when HDF5 writes: it can fail, and a writer has to look. True when there was nothing to
  /// close.
  bool close() {
    const hid_t id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Silences HDF5's own error printing (our errors are one line) and switches filter plugins off: a file must
/// not be able to name code that we then load. To be called before anything else; cheap when repeated.
void prepare_library();

/// What a stored number is. Little-endian, in the file and (asserted) in memory.
enum class Element { f32, u8, i8, u16, u32, i32, u64, text };

/// Bytes of one element; text_bytes for text.
size_t element_bytes(Element element, size_t text_bytes);
/// Its HDF5 type: numbers little-endian, text of fixed length, padded with NUL, UTF-8.
Handle element_type(Element element, size_t text_bytes);

}  // namespace veduta::hdf5
