// Files that an earlier program left: what is still read, and what is said of the rest.
#include <gtest/gtest.h>

#include "pvs/pvs_stream.h"
#include "tests/pvs/chunk_index.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::small_city;
using test::small_header;
using test::small_row;

std::filesystem::path old_file(const std::string& name) {
  return std::filesystem::path(VEDUTA_TEST_DATA) / "version3" / name;
}

TEST(OldVersions, APreparedCityOfVersion3IsRead) {
  const City city = read_city(old_file("city.h5"));
  EXPECT_EQ(city.scene.vertices, small_city().scene.vertices);
  EXPECT_EQ(city.scene.triangles, small_city().scene.triangles);
  EXPECT_EQ(city.scene.objects[2].name, small_city().scene.objects[2].name);
  EXPECT_EQ(city.cells, small_city().cells);
  EXPECT_EQ(city.navigation.free, small_city().navigation.free);
}

/// Its chunk indices, which have no checksum, are not taken along.
TEST(OldVersions, ARunOfVersion3IsMergedToAFileLikeAnyOther) {
  test::TemporaryDirectory directory;
  const CityOutline outline = read_city_outline(old_file("city.h5"));
  const std::string digest =
      write_pvs(directory / "a.h5", old_file("city.h5"), outline, small_header(), small_row);
  EXPECT_EQ(digest, write_pvs(directory / "b.h5", small_city(), small_header(), small_row));
  EXPECT_EQ(read_pvs(directory / "a.h5").city.scene.vertices, small_city().scene.vertices);
  const std::string from_old = test::read_bytes(directory / "a.h5"),
                    fresh = test::read_bytes(directory / "b.h5");
  EXPECT_EQ(test::chunk_indices(from_old).size(), test::chunk_indices(fresh).size());
  EXPECT_EQ(from_old.find("TREE"), std::string::npos);
  EXPECT_NE(test::read_bytes(old_file("city.h5")).find("TREE"), std::string::npos) << "an index of before";
}

TEST(OldVersions, AResultOfVersion3SaysWhatToDo) {
  for (const std::function<void()>& open :
       {std::function<void()>([] { read_pvs(old_file("city.pvs.h5")); }),
        std::function<void()>([] { PvsStream(old_file("city.pvs.h5")); })}) {
    std::string message;
    EXPECT_EQ(test::status_of(open, &message), ExitStatus::bad_input);
    EXPECT_NE(message.find("version 3, this program reads 4; merge its run directory again, or bake again"),
              std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace veduta
