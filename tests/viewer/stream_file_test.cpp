// A stream of a file on the disk, whole and damaged.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <set>

#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "tests/viewer/memory_source.h"
#include "viewer/stream/city_stream.h"

namespace veduta {
namespace {

constexpr uint64_t budget = 12 * 110'000;  ///< twelve houses

class StreamFile : public testing::Test {
 protected:
  StreamFile() : street_(toy::long_street(60)) {
    street_.city.navigation = test::small_city().navigation;
    write_pvs(file_, street_.city, test::small_header(), [&](uint32_t c) {
      return BakedCell{CellStatus::baked, 1, PvsRow(street_.row(c).begin(), street_.row(c).end()), 0};
    });
  }

  test::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "street.pvs.h5";
  PvsFile street_;
};

/// Where the chunk that has this row of a dataset lies in the file, and its bytes.
std::pair<uint64_t, uint64_t> chunk_of(const std::filesystem::path& path, const char* dataset, hsize_t row) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t data = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hid_t create = H5Dget_create_plist(data);
  hsize_t chunk[2] = {1, 1};
  H5Pget_chunk(create, 2, chunk);
  const hsize_t start[2] = {row / chunk[0] * chunk[0], 0};
  unsigned mask = 0;
  haddr_t address = 0;
  hsize_t bytes = 0;
  EXPECT_GE(H5Dget_chunk_info_by_coord(data, start, &mask, &address, &bytes), 0);
  H5Pclose(create);
  H5Dclose(data);
  H5Fclose(file);
  return {address, bytes};
}

TEST_F(StreamFile, PagesAreThoseOfTheCity) {
  const PvsStream stream(file_);
  const std::vector<PageSpan> pages = make_pages(stream.index());
  ASSERT_EQ(pages.size(), 60u);
  for (uint32_t p : {0u, 17u, 59u}) {
    const Page page = read_page(stream, pages, p);
    const Page expected = make_page(toy::slice_of(street_.city, p, p + 1), p, p);
    EXPECT_EQ(page.number, p);
    EXPECT_EQ(page.triangles, 802u);
    ASSERT_EQ(page.elements.size(), expected.elements.size());
    for (size_t e = 0; e < page.elements.size(); ++e) {
      const MeshVertex &a = page.vertices[page.elements[e]], &b = expected.vertices[expected.elements[e]];
      ASSERT_EQ(a.position_m, b.position_m);
      ASSERT_EQ(a.object, p);
      ASSERT_EQ(a.material, b.material);
      ASSERT_EQ(a.tint, b.tint);
    }
  }
}

TEST_F(StreamFile, IsWalkedThrough) {
  CityStream stream(file_, budget);
  std::set<uint32_t> here;
  for (uint32_t cell = 3; cell < 57; ++cell) {
    stream.look(toy::standing_in(cell));
    stream.wait();
    const PageChanges changes = stream.changes(UINT64_MAX);
    for (uint32_t page : changes.gone) here.erase(page);
    for (const auto& page : changes.came) here.insert(page->number);
    const PvsRow* row = stream.row(cell);
    ASSERT_TRUE(row);
    EXPECT_TRUE(std::equal(row->begin(), row->end(), street_.row(cell).begin(), street_.row(cell).end()));
    for (const PvsEntry& entry : *row) EXPECT_TRUE(here.count(entry.object));
    EXPECT_LE(stream.status().bytes_here, budget);
  }
}

TEST_F(StreamFile, DamageIsMetWhereTheEyeComesToIt) {
  const auto [address, size] = chunk_of(file_, "/scene/triangles", street_.city.scene.triangles.size() - 1);
  ASSERT_GT(size, 100u);
  std::string bytes = test::read_bytes(file_);
  bytes[address + size / 2] = static_cast<char>(bytes[address + size / 2] ^ 0x10);
  test::write_bytes(file_, bytes);

  CityStream stream(file_, budget);
  stream.look(toy::standing_in(5));
  stream.wait();  // that part of the city is whole
  std::string message;
  testing::internal::CaptureStderr();
  EXPECT_EQ(test::status_of(
                [&] {
                  stream.look(toy::standing_in(55));
                  stream.wait();
                },
                &message),
            ExitStatus::bad_input);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "a library speaks for itself";
  EXPECT_NE(message.find(file_.string() + ": /scene/triangles"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_EQ(test::status_of([&] { stream.look(toy::standing_in(5)); }), ExitStatus::bad_input);
}

}  // namespace
}  // namespace veduta
