// One CityJSON document: a whole file, or a line of a CityJSONSeq.
#pragma once

#include "scene/readers/cityjson_geometry.h"

namespace veduta::cityjson {

/// The polygons of a template in the model, there once for all objects that are instances of it.
struct TemplateInModel {
  bool read = false;
  uint64_t polygon_begin = 0, polygon_end = 0;
};

/// What the features of a CityJSONSeq share with its first line. `templates` point into that line's document.
struct Header {
  std::string version;  ///< "1.0", "1.1", "2.0"
  std::string crs;      ///< "EPSG:7415"
  glm::dvec3 scale{1}, translate{0};
  std::vector<Element> templates;
  std::vector<glm::dvec3> template_vertices;
  std::vector<TemplateInModel> in_model;          ///< one for each template
  std::optional<uint64_t> first_template_vertex;  ///< in the model, once they are there
};

/// \throw Error(bad_input) when the document is not a CityJSON object of a version that is read
Header read_header(const Element& document, const std::string& file);

/// `count` finite numbers, and nothing else. \throw Error(bad_input) naming file and place
void read_numbers(const Element& element, size_t count, double* numbers, const std::string& file,
                  const std::string& place);

/// [N][3] numbers. \throw Error(bad_input) naming file, place and the first item that is something else
std::vector<glm::dvec3> read_points(const simdjson::dom::array& array, const std::string& file,
                                    const std::string& place);

/// Appends the document's vertices and city objects to the model. An object that is one template, placed, and
/// nothing else becomes an instance; the template's polygons are appended when they are first asked for.
/// \param line "" or "line 12: ", put before each place
void read_document(const Element& document, Header& header, const std::string& line, RawModel& model,
                   ImportReport& report);

}  // namespace veduta::cityjson
