#include <hdf5.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/library/sliced_city.h"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 leaks when it refuses a file. Our own leaks are still found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace veduta {
namespace {

using Library = test::SlicedCity;
using test::error_of;
using test::expect_same_city;
using test::expect_same_rows;
using test::to_point;

TEST_F(Library, SaysWhatTheFileHolds) {
  const pvs::City city(path_);
  expect_same_city(city, file_);
  expect_same_rows(city, file_);
}

TEST_F(Library, FindsTheCellOfAPoint) {
  const pvs::City city(path_);
  std::mt19937 random(3);
  size_t inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    // On a lattice, so that many points lie on faces that two cells share.
    const glm::vec3 p{static_cast<float>(random() % 250) * 2.5f - 10,
                      static_cast<float>(random() % 7) * 2.5f - 12.5f,
                      static_cast<float>(random() % 5) * 0.5f + 0.5f};
    const int64_t known = file_.find_cell(p);
    const std::optional<uint32_t> cell = city.find_cell(to_point(p));
    ASSERT_EQ(cell.has_value(), known >= 0);
    ASSERT_TRUE(!cell || *cell == known) << *cell << " is not " << known;
    ++(cell ? inside : outside);
  }
  EXPECT_GT(inside, 100u);
  EXPECT_GT(outside, 100u);
  EXPECT_EQ(city.find_cell({10, -5, 1.5f}), 0u) << "a shared face belongs to the lower number";
  EXPECT_EQ(city.find_cell({NAN, 0, 0}), std::nullopt);
}

TEST_F(Library, FindsObjectsInABox) {
  const pvs::City city(path_);
  const pvs::Box box{{100, 5, -1}, {700, 20, 0}};
  std::vector<uint32_t> known;
  for (uint32_t i = 0; i < city.object_count(); ++i) {
    const Box b = file_.city.scene.bounds(i);
    if (!b.empty() && b.lower.x <= 700 && b.upper.x >= 100 && b.lower.y <= 20 && b.upper.y >= 5)
      known.push_back(i);
  }
  EXPECT_EQ(city.objects_in(box), known);
  EXPECT_GT(known.size(), 2u);
  EXPECT_LT(known.size(), 30u);
  const pvs::Box corner{{-1e6f, -1e6f, -1e6f}, city.object(known[0]).bounds.lower};
  const std::vector<uint32_t> touched = city.objects_in(corner);
  EXPECT_TRUE(std::binary_search(touched.begin(), touched.end(), known[0])) << "boxes are closed";
}

TEST_F(Library, MayBeMoved) {
  pvs::City first(path_);
  pvs::City city(std::move(first));
  first = std::move(city);
  city = pvs::City(path_);
  expect_same_city(first, file_);
  expect_same_rows(first, file_);
  pvs::Geometry geometry = city.read_geometry(0, 40);
  pvs::Geometry moved(std::move(geometry));
  geometry = std::move(moved);
  std::vector<pvs::DrawRange> ranges;
  for (uint32_t i = 0; i < 40; ++i) geometry.add_ranges({i, 0, 0, 1}, ranges);
  uint64_t drawn = 0;
  for (const pvs::DrawRange& range : ranges) drawn += range.count;
  EXPECT_EQ(drawn, 3 * file_.city.scene.triangles.size());
}

TEST_F(Library, NumbersThatAreNotThereAreErrors) {
  const pvs::City city(path_);
  pvs::Row row;
  EXPECT_EQ(error_of([&] { city.object(40); }), "no object 40: there are 40");
  EXPECT_EQ(error_of([&] { city.cell(60); }), "no cell 60: there are 60");
  EXPECT_EQ(error_of([&] { city.cell_status(60); }), "no cell 60: there are 60");
  EXPECT_EQ(error_of([&] { city.read_row(UINT32_MAX, row); }), "no cell 4294967295: there are 60");
  EXPECT_EQ(error_of([&] { city.read_geometry(3, 41); }), "no objects 3 to 41: there are 40");
  EXPECT_EQ(error_of([&] { city.read_geometry(4, 3); }), "no objects 4 to 3: there are 40");
}

TEST_F(Library, WhatIsNoFileOfOursIsAnError) {
  EXPECT_NE(error_of([&] { pvs::City(directory_ / "none.h5"); }).find("none.h5"), std::string::npos);
  test::write_bytes(directory_ / "text.h5", "a text");
  EXPECT_NE(error_of([&] { pvs::City(directory_ / "text.h5"); }).find("text.h5"), std::string::npos);
  write_city(directory_ / "city.h5", test::small_city());
  EXPECT_NE(error_of([&] { pvs::City(directory_ / "city.h5"); }).find("city.h5"), std::string::npos)
      << "a prepared city has no rows";
}

void expect_same_geometry(const pvs::Geometry& a, const pvs::Geometry& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.material, b.material);
}

/// Reads everything, which has to be as it was written. \return whether the damage was noticed.
bool noticed(const std::filesystem::path& path, const PvsFile& file, const pvs::City& undamaged) {
  const std::string error = error_of([&] {
    const pvs::City city(path);
    expect_same_city(city, file);
    expect_same_rows(city, file);
    for (uint32_t i = 0; i < city.object_count(); ++i)
      expect_same_geometry(city.read_geometry(i, i + 1), undamaged.read_geometry(i, i + 1));
  });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  EXPECT_TRUE(error.empty() || error.find(path.string() + ": /") == 0) << error;
  return !error.empty();
}

TEST_F(Library, DamageIsAnErrorOrChangesNothing) {
  const std::string bytes = test::read_bytes(path_);
  std::vector<size_t> used;
  for (size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] != 0) used.push_back(i);  // most zeros are room that HDF5 keeps for more
  std::mt19937 random(5);
  int errors = 0;
  const pvs::City undamaged(path_);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    std::string damaged = bytes;
    const size_t byte = used[random() % used.size()];
    SCOPED_TRACE("byte " + std::to_string(byte));
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << (random() % 8)));
    test::write_bytes(directory_ / "damaged.h5", damaged);
    errors += noticed(directory_ / "damaged.h5", file_, undamaged);
  }
  EXPECT_GT(errors, 50);
  for (const size_t size : {bytes.size() - 1, bytes.size() / 2, size_t{512}, size_t{0}}) {
    test::write_bytes(directory_ / "cut.h5", bytes.substr(0, size));
    EXPECT_FALSE(error_of([&] { pvs::City(directory_ / "cut.h5"); }).empty()) << size;
  }
}

/// Bytes that this process has read from files so far, or -1.
int64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  int64_t bytes = -1;
  io >> name >> bytes;
  return name == "rchar:" ? bytes : -1;
}

TEST_F(Library, KeepsAsMuchAsItMay) {
  if (bytes_read() < 0) GTEST_SKIP() << "/proc/self/io does not say what was read";
  const veduta::City written = test::sliced_city(8000, 2, 3);
  write_pvs(path_, written, test::small_header(), test::sliced_rows(written));
  const auto read_again = [&](const pvs::City& city) {
    expect_same_geometry(city.read_geometry(0, 8000), city.read_geometry(0, 8000));
    const int64_t before = bytes_read();
    city.read_geometry(0, 8000);
    return bytes_read() - before;
  };
  const auto stored = static_cast<int64_t>(std::filesystem::file_size(path_));
  EXPECT_LT(read_again(pvs::City(path_)), 5000) << "it was all there";
  EXPECT_GT(read_again(pvs::City(path_, 0)), stored / 2) << "there was no room for it";
}

herr_t host_printer(hid_t, void*) {
  return 0;
}

TEST_F(Library, LeavesHdf5AsTheProgramHasIt) {
  int data = 0;
  const unsigned plugins = H5PL_FILTER_PLUGIN;
  ASSERT_GE(H5Eset_auto2(H5E_DEFAULT, host_printer, &data), 0);
  ASSERT_GE(H5PLset_loading_state(plugins), 0);
  const auto expect_unchanged = [&] {
    H5E_auto2_t printer = nullptr;
    void* printed_to = nullptr;
    unsigned state = 0;
    ASSERT_GE(H5Eget_auto2(H5E_DEFAULT, &printer, &printed_to), 0);
    ASSERT_GE(H5PLget_loading_state(&state), 0);
    EXPECT_EQ(printer, &host_printer);
    EXPECT_EQ(printed_to, &data);
    EXPECT_EQ(state, plugins);
  };
  const pvs::City city(path_);
  expect_unchanged();
  pvs::Row row;
  city.read_row(1, row);
  expect_unchanged();
  city.read_geometry(0, 40);
  expect_unchanged();
  EXPECT_NE(error_of([&] { pvs::City(directory_ / "none.h5"); }), "");
  expect_unchanged();
}

TEST(LibraryOfRealFiles, IsWhatIsReadWhole) {
  const char* const named = std::getenv("VEDUTA_PVS_FILE");
  if (!named) GTEST_SKIP() << "VEDUTA_PVS_FILE names no baked file to compare with";
  const PvsFile file = read_pvs(named);
  const pvs::City city(named);
  expect_same_city(city, file);
  expect_same_rows(city, file);
}

}  // namespace
}  // namespace veduta
