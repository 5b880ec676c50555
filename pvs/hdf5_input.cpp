#include "pvs/hdf5_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "pvs/hdf5_structure.h"
#include "scene/error.h"

namespace veduta::hdf5 {

namespace {

/// Says what is wrong with the file before HDF5 has to, and how long it is.
uint64_t probe(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    if (errno == ENOENT || errno == ENOTDIR)
      throw Error(ExitStatus::bad_input, fmt::format("{}: no such file", file.string()));
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot open: {}", file.string(), std::strerror(errno)));
  }
  struct stat status {};
  const bool regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const auto bytes = static_cast<uint64_t>(status.st_size);
  std::optional<std::string> defect;
  if (regular) defect = find_structure_defect(descriptor, bytes);
  ::close(descriptor);
  if (!regular) throw Error(ExitStatus::bad_input, fmt::format("{}: not a regular file", file.string()));
  if (defect) throw Error(ExitStatus::bad_input, fmt::format("{}: {}", file.string(), *defect));
  return bytes;
}

}  // namespace

Input::Input(const std::filesystem::path& file) : path_(file) {
  prepare_library();
  file_bytes_ = probe(file);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Finished files do not change (they are renamed into place), and locks fail on some shared file systems.
  if (H5Pset_file_locking(access.get(), false, true) < 0) fail("/", "HDF5 refuses its settings");
  file_ = {H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  if (!file_.valid()) fail("/", "not an HDF5 file, or cut or damaged; get it again, or bake again");
}

void Input::fail(const std::string& place, const std::string& what) const {
  throw Error(ExitStatus::bad_input, fmt::format("{}: {}: {}", path_.string(), place, what));
}

void Input::refuse(const std::optional<std::string>& defect) const {
  if (!defect) return;
  const size_t colon = defect->find(": ");
  fail(defect->substr(0, colon), defect->substr(colon + 2));
}

bool Input::has(const char* path) const {
  const std::string whole = path;
  for (size_t slash = whole.find('/', 1);; slash = whole.find('/', slash + 1)) {
    const htri_t found = H5Lexists(file_.get(), whole.substr(0, slash).c_str(), H5P_DEFAULT);
    if (found < 0) fail(path, "damaged");
    if (found == 0) return false;
    if (slash == std::string::npos) return true;
  }
}

Handle Input::open(const char* path) const {
  const std::string whole = path;
  for (size_t slash = whole.find('/', 1); whole != "/"; slash = whole.find('/', slash + 1)) {
    const std::string prefix = whole.substr(0, slash);
    H5L_info_t link{};
    if (H5Lexists(file_.get(), prefix.c_str(), H5P_DEFAULT) <= 0)
      fail(prefix, "missing; the file is damaged or another's");
    if (H5Lget_info(file_.get(), prefix.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      fail(prefix, "a link that leads elsewhere; such files are not read");
    if (slash == std::string::npos) break;
  }
  Handle object(H5Oopen(file_.get(), path, H5P_DEFAULT), H5Oclose);
  if (!object.valid()) fail(path, "damaged");
  return object;
}

void Input::attribute(const char* object, const char* name, hid_t type, size_t count, void* out) const {
  const std::string place = fmt::format("{}@{}", object, name);
  const Handle opened = open(object);
  if (H5Aexists(opened.get(), name) <= 0) fail(place, "missing; the file is damaged or another's");
  const Handle attribute(H5Aopen(opened.get(), name, H5P_DEFAULT), H5Aclose);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tequal(stored.get(), type) <= 0 ||
      H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(count))
    fail(place, "of another type or extent than this program writes");
  if (H5Aread(attribute.get(), type, out) < 0) fail(place, "damaged");
}

std::string Input::text_of(hid_t object, const char* place, const char* name) const {
  const std::string where = fmt::format("{}@{}", place, name);
  if (H5Aexists(object, name) <= 0) fail(where, "missing; the file is damaged or another's");
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!stored.valid() || H5Tget_class(stored.get()) != H5T_STRING || H5Tis_variable_str(stored.get()) != 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    fail(where, "not a text of fixed length");
  const size_t bytes = H5Tget_size(stored.get());
  if (bytes == 0 || bytes > attribute_bytes_limit || bytes > file_bytes_) fail(where, "damaged");
  std::string out(bytes, '\0');
  const Handle memory = element_type(Element::text, bytes);
  if (H5Aread(attribute.get(), memory.get(), out.data()) < 0) fail(where, "damaged");
  while (!out.empty() && out.back() == '\0') out.pop_back();
  return out;
}

std::string Input::text(const char* object, const char* name) const {
  const Handle opened = open(object);
  return text_of(opened.get(), object, name);
}

uint32_t Input::number(const char* object, const char* name) const {
  uint32_t out = 0;
  attribute(object, name, H5T_STD_U32LE, 1, &out);
  return out;
}

uint64_t Input::large_number(const char* object, const char* name) const {
  uint64_t out = 0;
  attribute(object, name, H5T_STD_U64LE, 1, &out);
  return out;
}

double Input::real(const char* object, const char* name) const {
  double out = 0;
  attribute(object, name, H5T_IEEE_F64LE, 1, &out);
  return out;
}

uint8_t Input::flag(const char* object, const char* name) const {
  uint8_t out = 0;
  attribute(object, name, H5T_STD_U8LE, 1, &out);
  if (out > 1) fail(fmt::format("{}@{}", object, name), "neither 0 nor 1");
  return out;
}

std::vector<float> Input::floats(const char* object, const char* name, size_t count) const {
  std::vector<float> out(count);
  attribute(object, name, H5T_IEEE_F32LE, count, out.data());
  return out;
}

std::array<double, 3> Input::doubles(const char* object, const char* name) const {
  std::array<double, 3> out{};
  attribute(object, name, H5T_IEEE_F64LE, out.size(), out.data());
  return out;
}

}  // namespace veduta::hdf5
