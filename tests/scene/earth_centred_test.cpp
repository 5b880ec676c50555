#include "scene/readers/earth_centred.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

TEST(EarthCentred, KnownPlaces) {
  const glm::dvec3 greenwich = geographic({6378137 + 10, 0, 0});
  EXPECT_NEAR(greenwich.x, 0, 1e-13);
  EXPECT_NEAR(greenwich.y, 0, 1e-13);
  EXPECT_NEAR(greenwich.z, 10, 1e-8);
  const glm::dvec3 pole = geographic({0, 0, -6356752.314245 - 5});
  EXPECT_NEAR(pole.y, -90, 1e-13);
  EXPECT_NEAR(pole.z, 5, 1e-6);
  // EPSG guidance note 7-2, section on geographic/geocentric conversions
  const glm::dvec3 north_sea = geographic({3771793.968, 140253.342, 5124304.349});
  EXPECT_NEAR(north_sea.x, 2 + 7 / 60. + 46.380 / 3600, 2e-8);
  EXPECT_NEAR(north_sea.y, 53 + 48 / 60. + 33.820 / 3600, 2e-8);
  EXPECT_NEAR(north_sea.z, 73.0, 1e-3);
}

TEST(EarthCentred, ThereAndBack) {
  for (double latitude = -89; latitude < 90; latitude += 7.3)
    for (double longitude = -179; longitude < 180; longitude += 31)
      for (const double height : {-400.0, 0.0, 8848.0}) {
        const glm::dvec3 found = geographic(earth_centred_of(longitude, latitude, height));
        EXPECT_NEAR(found.x, longitude, 1e-13 * 180);
        EXPECT_NEAR(found.y, latitude, 1e-13 * 180);
        EXPECT_NEAR(found.z, height, 1e-8);
      }
}

TEST(EarthCentred, ProjectedPlacesAreNot) {
  EXPECT_TRUE(earth_centred(earth_centred_of(4.8, 45.7, 200)));
  EXPECT_TRUE(earth_centred(earth_centred_of(103.8, 1.3, 20)));
  EXPECT_FALSE(earth_centred({0, 0, 0}));
  EXPECT_FALSE(earth_centred({1842000, 5174000, 200}));  // Lyon, EPSG:3946
  EXPECT_FALSE(
      earth_centred({500000, 6360000, 60}));  // UTM at 57 degrees north: as far as the earth is thick
  EXPECT_FALSE(earth_centred({3500000, 5332000, 200}));  // Gauss-Krueger
}

}  // namespace
}  // namespace veduta
