// Files that are whole HDF5 and yet not what this program writes.
#include "pvs/hdf5_input.h"

#include <gtest/gtest.h>

#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::status_of;
using test::TemporaryDirectory;

/// Opens a whole file and spoils it with HDF5's own means.
std::string message_after(const std::function<void(hid_t)>& spoil) {
  TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  const hid_t file = H5Fopen((directory / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  EXPECT_GE(file, 0);
  spoil(file);
  EXPECT_GE(H5Fclose(file), 0);
  std::string message;
  EXPECT_EQ(status_of([&] { read_pvs(directory / "a.h5"); }, &message), ExitStatus::bad_input) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

TEST(Hdf5Input, NamesTheVersion) {
  const std::string message = message_after([](hid_t file) {
    const hid_t attribute = H5Aopen(file, "version", H5P_DEFAULT);
    const uint32_t version = 1;
    H5Awrite(attribute, H5T_NATIVE_UINT32, &version);
    H5Aclose(attribute);
  });
  EXPECT_NE(message.find("version 1"), std::string::npos) << message;
}

TEST(Hdf5Input, NamesWhatIsMissingOrElsewhere) {
  EXPECT_NE(message_after([](hid_t file) {
              H5Ldelete(file, "/cells/row", H5P_DEFAULT);
            }).find("/cells/row: missing"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t file) {
              H5Ldelete(file, "/navigation", H5P_DEFAULT);
            }).find("/navigation: missing"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t file) {
              H5Ldelete(file, "/pvs/begin", H5P_DEFAULT);
              H5Lcreate_external("/etc/passwd", "/begin", file, "/pvs/begin", H5P_DEFAULT, H5P_DEFAULT);
            }).find("/pvs/begin: a link"),
            std::string::npos);
  EXPECT_NE(message_after([](hid_t file) {
              H5Ldelete(file, "/pvs/form", H5P_DEFAULT);
              H5Lcreate_soft("/pvs/object_step", file, "/pvs/form", H5P_DEFAULT, H5P_DEFAULT);
            }).find("/pvs/form: a link"),
            std::string::npos);
}

TEST(Hdf5Input, NamesWhatChanged) {
  const std::string value = message_after([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/cells/row", H5P_DEFAULT);
    const uint32_t rows[7] = {0, 1, 2, 0, 1, 2, 1};
    H5Dwrite(dataset, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows);
    H5Dclose(dataset);
  });
  EXPECT_NE(value.find("/cells/row: damaged: its digest"), std::string::npos) << value;
  const std::string extent = message_after([](hid_t file) {
    const hid_t dataset = H5Dopen2(file, "/pvs/object_step", H5P_DEFAULT);
    const hsize_t rows = hsize_t{1} << 40;
    H5Dset_extent(dataset, &rows);
    H5Dclose(dataset);
  });
  EXPECT_NE(extent.find("/pvs/object_step: damaged: claims"), std::string::npos) << extent;
}

}  // namespace
}  // namespace veduta
