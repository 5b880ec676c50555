// The parts of a document that its objects share: version, CRS, transform, templates, vertices.
#include <cmath>

#include "scene/readers/cityjson_document.h"
#include "scene/text.h"

namespace veduta::cityjson {
namespace {

using Array = simdjson::dom::array;
using std::string_view;

// "https://www.opengis.net/def/crs/EPSG/0/7415" and "urn:ogc:def:crs:EPSG::7415" become "EPSG:7415".
std::string short_crs(string_view text) {
  const size_t authority = text.find("EPSG");
  const size_t last = text.find_last_of("/:");
  if (authority == string_view::npos || last == string_view::npos || last < authority) return printable(text);
  const string_view code = text.substr(last + 1);
  if (code.empty() || code.find_first_not_of("0123456789") != string_view::npos) return printable(text);
  return "EPSG:" + printable(code);
}

std::string read_version(const Element& document, const std::string& file) {
  string_view type, version;
  if (document["type"].get(type) != simdjson::SUCCESS)
    throw bad_input(file, "type", "is missing; this is JSON, but not CityJSON");
  if (type == "CityJSONFeature")
    throw bad_input(file, "type",
                    "is CityJSONFeature before any CityJSON object; put the line with the transform first");
  if (type != "CityJSON") throw bad_input(file, "type", "is '" + printable(type, 40) + "', not CityJSON");
  if (document["version"].get(version) != simdjson::SUCCESS)
    throw bad_input(file, "version", "is missing or not a string");
  for (const char* known : {"1.0", "1.1", "2.0"})
    if (version == known || version.starts_with(std::string(known) + ".")) return known;
  throw bad_input(file, "version",
                  "CityJSON " + printable(version, 20) +
                      " is not read, but 1.0, 1.1 and 2.0 are; use 'cjio FILE upgrade'");
}

}  // namespace

void read_numbers(const Element& element, size_t count, double* numbers, const std::string& file,
                  const std::string& place) {
  Array array;
  size_t found = 0;
  if (element.get(array) == simdjson::SUCCESS) {
    for (const Element item : array) {
      double number = 0;
      if (item.get(number) != simdjson::SUCCESS || !std::isfinite(number)) break;
      if (found < count) numbers[found] = number;
      ++found;
    }
    if (found == count && array.size() == count) return;
  }
  throw bad_input(file, place, "is not an array of " + std::to_string(count) + " numbers; check the export");
}

std::vector<glm::dvec3> read_points(const Array& array, const std::string& file, const std::string& place) {
  std::vector<glm::dvec3> points;
  points.reserve(array.size());
  for (const Element item : array) {
    Array triple;
    glm::dvec3 p(0);
    size_t axis = 0;
    bool good = item.get(triple) == simdjson::SUCCESS;
    if (good)
      for (const Element number : triple)
        good = axis < 3 && number.get(p[static_cast<int>(axis++)]) == simdjson::SUCCESS && good;
    if (!good || axis != 3)
      throw bad_input(file, place + "/" + std::to_string(points.size()),
                      "is not an array of 3 numbers; check the export");
    points.push_back(p);
  }
  return points;
}

Header read_header(const Element& document, const std::string& file) {
  Header header;
  header.version = read_version(document, file);
  if (string_view crs; document["metadata"]["referenceSystem"].get(crs) == simdjson::SUCCESS)
    header.crs = short_crs(crs);
  if (Element transform; document["transform"].get(transform) == simdjson::SUCCESS) {
    Element scale, translate;
    if (transform["scale"].get(scale) != simdjson::SUCCESS ||
        transform["translate"].get(translate) != simdjson::SUCCESS)
      throw bad_input(file, "transform", "needs scale and translate");
    read_numbers(scale, 3, &header.scale.x, file, "transform/scale");
    read_numbers(translate, 3, &header.translate.x, file, "transform/translate");
  }
  if (Element templates; document["geometry-templates"].get(templates) == simdjson::SUCCESS) {
    for (const Element shape : array_at(templates, "templates", file, "geometry-templates"))
      header.templates.push_back(shape);
    header.template_vertices =
        read_points(array_at(templates, "vertices-templates", file, "geometry-templates"), file,
                    "geometry-templates/vertices-templates");
    header.in_model.resize(header.templates.size());
  }
  return header;
}

}  // namespace veduta::cityjson
