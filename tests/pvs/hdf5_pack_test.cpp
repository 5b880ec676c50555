// What we pack is what HDF5 would have packed, to the byte.
#include "pvs/hdf5_pack.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <random>

#include "tests/pvs/small_city.h"

namespace veduta::hdf5 {
namespace {

/// The bytes that HDF5 stores for one chunk of texts of `element_bytes`.
std::vector<std::byte> packed_by_library(const std::filesystem::path& name, std::vector<std::byte> chunk,
                                         size_t element_bytes, int level) {
  const hid_t file = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Tcopy(H5T_C_S1), create = H5Pcreate(H5P_DATASET_CREATE);
  H5Tset_size(type, element_bytes);
  const hsize_t extent = chunk.size() / element_bytes, start = 0;
  H5Pset_chunk(create, 1, &extent);
  H5Pset_shuffle(create);
  H5Pset_deflate(create, static_cast<unsigned>(level));
  H5Pset_fletcher32(create);
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t set = H5Dcreate2(file, "a", type, space, H5P_DEFAULT, create, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, chunk.data()), 0);
  H5Fflush(file, H5F_SCOPE_LOCAL);
  hsize_t bytes = 0;
  EXPECT_GE(H5Dget_chunk_storage_size(set, &start, &bytes), 0);
  std::vector<std::byte> packed(bytes);
  uint32_t skipped = 1;
  EXPECT_GE(H5Dread_chunk(set, H5P_DEFAULT, &start, &skipped, packed.data()), 0);
  EXPECT_EQ(skipped, 0u);
  H5Dclose(set), H5Sclose(space), H5Tclose(type), H5Pclose(create), H5Fclose(file);
  return packed;
}

TEST(Hdf5Pack, GivesTheBytesOfTheLibrary) {
  test::TemporaryDirectory directory;
  std::mt19937 random(1);
  for (const size_t element_bytes : {1u, 2u, 3u, 4u, 8u, 24u})
    for (const size_t count : {1u, 5u, 361u, 9001u})
      for (const unsigned values : {1u, 3u, 256u}) {  // all zero, few values, noise
        std::vector<std::byte> chunk(element_bytes * count);
        for (std::byte& byte : chunk) byte = static_cast<std::byte>(random() % values);
        for (const int level : {4, 9})
          ASSERT_EQ(pack_chunk(chunk, element_bytes, {level, false}),
                    packed_by_library(directory / "a.h5", chunk, element_bytes, level))
              << element_bytes << " x " << count << ", " << values << " values, level " << level;
      }
}

TEST(Hdf5Pack, UnpacksWhatItPacked) {
  std::mt19937 random(3);
  for (const size_t element : {1, 2, 4, 8, 40}) {
    std::vector<std::byte> chunk(element * 777);
    for (std::byte& b : chunk) b = static_cast<std::byte>(random() % 7);
    for (const Deflate deflate : {Deflate{4, false}, {9, false}, {9, true}}) {
      std::vector<std::byte> back(chunk.size());
      EXPECT_TRUE(unpack_chunk(pack_chunk(chunk, element, deflate), element, back));
      EXPECT_EQ(back, chunk) << element;
    }
  }
}

TEST(Hdf5Pack, RefusesWhatIsDamagedOrOfAnotherSize) {
  std::vector<std::byte> chunk(4000, std::byte{5}), back(chunk.size());
  chunk[77] = std::byte{9};
  const std::vector<std::byte> packed = pack_chunk(chunk, 4, {});
  for (size_t i = 0; i < packed.size(); ++i) {
    std::vector<std::byte> bad = packed;
    bad[i] ^= std::byte{0x10};
    EXPECT_FALSE(unpack_chunk(bad, 4, back)) << i;
  }
  std::vector<std::byte> shorter(chunk.size() - 4), longer(chunk.size() + 4);
  EXPECT_FALSE(unpack_chunk(packed, 4, shorter)) << "a chunk of another dataset";
  EXPECT_FALSE(unpack_chunk(packed, 4, longer));
  EXPECT_FALSE(unpack_chunk({}, 4, back));
  EXPECT_FALSE(unpack_chunk(std::vector<std::byte>(4), 4, back));
}

}  // namespace
}  // namespace veduta::hdf5
