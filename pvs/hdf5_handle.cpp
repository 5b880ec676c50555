#include "pvs/hdf5_handle.h"

#include <bit>

namespace veduta::hdf5 {

// Digests are taken over values in memory and documented as over little-endian values.
static_assert(std::endian::native == std::endian::little);

namespace {

Handle text_type(size_t bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (H5Tset_size(type.get(), bytes) < 0 || H5Tset_strpad(type.get(), H5T_STR_NULLPAD) < 0 ||
      H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0)
    return {};
  return type;
}

}  // namespace

void prepare_library() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

size_t element_bytes(Element element, size_t text_bytes) {
  switch (element) {
    case Element::u8:
    case Element::i8:
      return 1;
    case Element::u16:
      return 2;
    case Element::f32:
    case Element::u32:
    case Element::i32:
      return 4;
    case Element::u64:
      return 8;
    case Element::text:
      break;
  }
  return text_bytes;
}

Handle element_type(Element element, size_t text_bytes) {
  switch (element) {
    case Element::f32:
      return {H5Tcopy(H5T_IEEE_F32LE), H5Tclose};
    case Element::u8:
      return {H5Tcopy(H5T_STD_U8LE), H5Tclose};
    case Element::i8:
      return {H5Tcopy(H5T_STD_I8LE), H5Tclose};
    case Element::u16:
      return {H5Tcopy(H5T_STD_U16LE), H5Tclose};
    case Element::u32:
      return {H5Tcopy(H5T_STD_U32LE), H5Tclose};
    case Element::i32:
      return {H5Tcopy(H5T_STD_I32LE), H5Tclose};
    case Element::u64:
      return {H5Tcopy(H5T_STD_U64LE), H5Tclose};
    case Element::text:
      break;
  }
  return text_type(text_bytes);
}

}  // namespace veduta::hdf5
