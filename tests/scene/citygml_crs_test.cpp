#include "scene/readers/citygml_crs.h"

#include <gtest/gtest.h>

namespace veduta::citygml {
namespace {

std::string crs_of(const std::string& name) {
  const std::optional<SrsName> srs = read_srs_name(name);
  return !srs ? "none" : srs->crs + (srs->authority_order ? ", authority's order" : "");
}

TEST(SrsName, IsReadInAllItsForms) {
  const std::pair<const char*, const char*> table[] = {
      {"EPSG:25833", "EPSG:25833"},
      {"epsg:25833", "EPSG:25833"},
      {"urn:ogc:def:crs:EPSG::28992", "EPSG:28992, authority's order"},
      {"urn:ogc:def:crs:EPSG:6.12:3068", "EPSG:3068, authority's order"},
      {"urn:x-ogc:def:crs:EPSG::4326", "EPSG:4326, authority's order"},
      {"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", "EPSG:25832, authority's order"},
      {"urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783", "EPSG:3068, authority's order"},
      {"http://www.opengis.net/def/crs/EPSG/0/7415", "EPSG:7415, authority's order"},
      {"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/25832&2=http://"
       "www.opengis.net/def/crs/EPSG/0/7837",
       "EPSG:25832, authority's order"},
      {"http://www.opengis.net/gml/srs/epsg.xml#4326", "EPSG:4326"},
      {"urn:ogc:def:crs:OGC:1.3:CRS84", "OGC:CRS84"},
      {"urn:adv:crs:DE_DHDN_3GK3*DE_DHHN92_NH", "EPSG:31467"},
      {"urn:adv:crs:DE_DHDN_3GK3_HE120", "EPSG:31467"},
      {"urn:adv:crs:ETRS89_UTM33*DE_DHHN2016_NH", "EPSG:25833"},
      {"urn:adv:crs:ETRS89_Lat-Lon", "EPSG:4258, authority's order"},
      {"urn:adv:crs:DE_DHDN_3GK33", "none"},
      {"urn:adv:crs:ETRS89_UTM32x", "none"},
      {"EPSG:999999", "none"},
      {"EPSG:5783", "none"},  // heights alone
      {"EPSG", "none"},
      {"EPSG:", "none"},
      {"EPSG:12345678901234567890", "none"},
      {"local", "none"},
      {"", "none"},
      {"/etc/passwd", "none"},
  };
  for (const auto& [name, expected] : table) EXPECT_EQ(crs_of(name), expected) << name;
}

bool turned(const std::string& name, double first, double second) {
  return northing_first(*read_srs_name(name), {first, second, 0});
}

TEST(NorthingFirst, FollowsTheAuthorityWhereTheNamePromisesIt) {
  EXPECT_TRUE(turned("urn:ogc:def:crs:EPSG::4326", 45.76, 4.84));
  EXPECT_FALSE(turned("EPSG:4326", 4.84, 45.76));
  EXPECT_TRUE(turned("http://www.opengis.net/def/crs/EPSG/0/6697", 35.68, 139.76));
  EXPECT_FALSE(turned("urn:ogc:def:crs:OGC:1.3:CRS84", 4.84, 45.76));
  EXPECT_TRUE(turned("urn:ogc:def:crs:EPSG::31467", 5805000, 3550000));
  EXPECT_FALSE(turned("urn:ogc:def:crs:EPSG::25833", 392000, 5819000));
  EXPECT_FALSE(turned("urn:ogc:def:crs:EPSG::28992", 79000, 457000));
}

TEST(NorthingFirst, BelievesTheCoordinatesWhereOnlyOneOrderIsPossible) {
  EXPECT_FALSE(turned("urn:ogc:def:crs:EPSG::31467", 3550000, 5805000));
  EXPECT_TRUE(turned("EPSG:31467", 5805000, 3550000));
  EXPECT_FALSE(turned("urn:ogc:def:crs:EPSG::4326", 139.76, 35.68));  // no latitude
  EXPECT_TRUE(turned("EPSG:6697", 35.68, 139.76));
  EXPECT_FALSE(turned("urn:ogc:def:crs:EPSG::6697", 139.76, 35.68));
}

}  // namespace
}  // namespace veduta::citygml
