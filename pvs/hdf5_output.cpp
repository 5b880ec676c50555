#include "pvs/hdf5_output.h"

#include <fmt/format.h>
#include <sys/statvfs.h>

#include "scene/error.h"

namespace veduta::hdf5 {

namespace {

// What HDF5 itself may still have to write at any time: superblock, headers, chunk indices, one chunk.
constexpr uint64_t metadata_reserve_bytes = 4u << 20;

uint64_t free_bytes(const std::filesystem::path& file) {
  const auto parent = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  struct statvfs status {};
  if (::statvfs(parent.c_str(), &status) != 0) return UINT64_MAX;  // not known: writing will tell
  return uint64_t{status.f_bavail} * status.f_frsize;
}

}  // namespace

void copy_output(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing, error);
  if (error)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot be written: {}; is the disk full?", to.string(), error.message()));
}

Output::Output(const std::filesystem::path& file, Start start) : path_(file) {
  prepare_library();
  require_space(0);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Handle create(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  // Version 1.10 (2016) brought checksums of the indices of chunks; those of other metadata are older. No
  // lock: the name is ours alone, and locks fail on some shared file systems. The root's attributes stay in
  // its header, where the simplest readers find them.
  if (H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110) < 0 ||
      H5Pset_file_locking(access.get(), false, true) < 0 || H5Pset_obj_track_times(create.get(), false) < 0 ||
      H5Pset_attr_phase_change(create.get(), 64, 32) < 0)
    fail("/", "HDF5 refuses its settings");
  if (start == Start::anew)
    file_ = {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, create.get(), access.get()), H5Fclose};
  else
    file_ = {H5Fopen(file.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose};
  if (!file_.valid()) fail("/", "cannot open the file for writing; is the directory there and writable?");
}

void Output::fail(const char* place, const char* what) const {
  const uint64_t left = free_bytes(path_);
  throw Error(ExitStatus::input_output,
              fmt::format("{}: {}: {}{}", path_.string(), place, what,
                          left < 2 * metadata_reserve_bytes
                              ? fmt::format("; the disk is full ({} KiB free): free some space and run again",
                                            left / 1024)
                              : ""));
}

void Output::require_space(uint64_t bytes) const {
  const uint64_t left = free_bytes(path_);
  if (left >= bytes + metadata_reserve_bytes) return;
  throw Error(ExitStatus::input_output,
              fmt::format("{}: the disk is full: {} KiB free, {} KiB needed; free some space and run again",
                          path_.string(), left / 1024, (bytes + metadata_reserve_bytes) / 1024));
}

void Output::group(const char* path) {
  Handle create(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  if (H5Pset_obj_track_times(create.get(), false) < 0 || H5Pset_attr_phase_change(create.get(), 64, 32) < 0)
    fail(path, "HDF5 refuses its settings");
  Handle made(H5Gcreate2(file_.get(), path, H5P_DEFAULT, create.get(), H5P_DEFAULT), H5Gclose);
  if (!made.valid() || !made.close()) fail(path, "cannot write the group");
}

void Output::raw_attribute(hid_t object, const char* place, const char* name, hid_t type, const void* data,
                           size_t count) {
  const hsize_t extent = count;
  Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), H5Sclose);
  Handle attribute(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.get(), type, data) < 0 || !attribute.close())
    fail(place, fmt::format("cannot write the attribute {}", name).c_str());
}

void Output::text_attribute(hid_t object, const char* place, const char* name, const std::string& text) {
  std::string padded = text;
  if (padded.empty()) padded.push_back('\0');  // HDF5 has no text of length 0
  raw_attribute(object, place, name, element_type(Element::text, padded.size()).get(), padded.data(), 1);
}

void Output::attribute(const char* object, const char* name, const std::string& text) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  text_attribute(opened.get(), object, name, text);
}

void Output::attribute(const char* object, const char* name, uint32_t value) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_STD_U32LE, &value, 1);
}

void Output::attribute(const char* object, const char* name, uint8_t value) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_STD_U8LE, &value, 1);
}

void Output::attribute(const char* object, const char* name, uint64_t value) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_STD_U64LE, &value, 1);
}

void Output::attribute(const char* object, const char* name, double value) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_IEEE_F64LE, &value, 1);
}

void Output::attribute(const char* object, const char* name, const std::vector<float>& values) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_IEEE_F32LE, values.data(), values.size());
}

void Output::attribute(const char* object, const char* name, const std::array<double, 3>& values) {
  Handle opened(H5Oopen(file_.get(), object, H5P_DEFAULT), H5Oclose);
  raw_attribute(opened.get(), object, name, H5T_IEEE_F64LE, values.data(), values.size());
}

void Output::remove(const char* path) {
  if (H5Ldelete(file_.get(), path, H5P_DEFAULT) < 0) fail(path, "cannot be removed");
}

void Output::close() {
  if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail("/", "cannot write");
  if (!file_.close()) fail("/", "cannot close the file");
}

}  // namespace veduta::hdf5
