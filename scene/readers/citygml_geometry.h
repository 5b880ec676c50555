// The polygons of GML geometries.
#pragma once

#include <string>
#include <unordered_set>

#include "scene/raw_model.h"
#include "scene/readers/city_types.h"
#include "scene/readers/citygml_document.h"

namespace veduta::citygml {

/// Whether a geometry property (lod2Solid, tin, ...) leads to surfaces, and if not, what it holds
/// ("MultiCurve"; "nothing").
struct Content {
  bool surfaces = false;
  std::string type;
};
Content content_of(const Document& document, const pugi::xml_node& property);

/// Finite numbers, separated by white space or commas. \throw Error(bad_input) naming the node's line
std::vector<double> numbers_of(const pugi::xml_node& node, const Document& document, const std::string& file);

/// Appends polygons to a model.
class Surfaces {
 public:
  Surfaces(const Document& document, RawModel& model, ImportReport& report)
      : document_(document), model_(model), report_(report) {}

  /// From here on, polygons that were added are added again where they are met again.
  void begin_object() { visited_.clear(); }
  /// All polygons below a property or geometry and where its references lead: Polygon, Surface,
  /// PolyhedralSurface, TriangulatedSurface and Tin, and what collects and orients them. What this object
  /// already has (a Solid refers to the surfaces that bound it) is passed over. Polygons of an opening,
  /// curves and points are counted as dropped. \throw Error(bad_input) for coordinates that are no numbers or
  /// too few
  void add(const pugi::xml_node& geometry, const SurfaceTheme& theme);

 private:
  struct Step;
  void visit(const Step& step, std::vector<Step>& stack);
  void follow(const Step& step, std::vector<Step>& stack);
  void polygon(const pugi::xml_node& polygon, bool flipped);
  void points_tin(const pugi::xml_node& tin);
  bool ring(const pugi::xml_node& boundary, bool flipped);
  bool append_corners(const pugi::xml_node& coordinates);
  uint32_t vertex(const glm::dvec3& p, const pugi::xml_node& node);
  void drop(const std::string& reason, const pugi::xml_node& node);

  const Document& document_;
  RawModel& model_;
  ImportReport& report_;
  SurfaceTheme theme_;
  std::unordered_set<const void*> visited_;  // elements with an id: the others are reached in one way only
  uint64_t steps_ = 0;
  std::vector<glm::dvec3> corners_;  // of the ring being read
};

}  // namespace veduta::citygml
