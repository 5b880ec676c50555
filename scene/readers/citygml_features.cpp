#include "scene/readers/citygml_features.h"

#include <algorithm>
#include <pugixml.hpp>

#include "scene/readers/city_types.h"
#include "scene/readers/citygml_geometry.h"

namespace veduta::citygml {
namespace {

using std::string_view;

bool is_type(string_view name) {  // properties are in lower case
  return !name.empty() && name.front() >= 'A' && name.front() <= 'Z';
}

bool is_part(string_view name) {
  return is_type(name) &&
         (name.ends_with("Part") || name.ends_with("Installation") || name.ends_with("Room") ||
          name.ends_with("Furniture") || name.ends_with("ConstructionElement") || name == "HollowSpace");
}

bool is_theme(string_view name) {
  return is_type(name) && (name.ends_with("Surface") || name == "Window" || name == "Door" ||
                           name == "TrafficArea" || name == "AuxiliaryTrafficArea");
}

bool is_geometry(string_view name) {
  const bool of_lod = name.size() > 4 && name.starts_with("lod") && name[3] >= '0' && name[3] <= '9';
  return of_lod || name == "tin";
}

std::string id_of(const pugi::xml_node& node) {
  return printable(node.attribute("id").value(), 10000);
}

std::string lod_text(int lod) {
  return lod < 0 ? "-" : std::to_string(lod);
}

class FeatureReader {
 public:
  FeatureReader(const Document& document, const std::string& file, ImportReport& report)
      : document_(document), file_(file), report_(report) {}

  std::vector<CityObject> read() {
    members(document_.root(), "");
    return std::move(objects_);
  }

 private:
  // Features two levels below: CityModel/cityObjectMember/Building.
  void members(const pugi::xml_node& collection, const std::string& fallback_name) {
    for (const pugi::xml_node member : collection.children()) {
      const string_view name = member.name();
      if (name != "cityObjectMember" && name != "featureMember" && name != "featureMembers" &&
          name != "groupMember" && name != "reliefComponent")
        continue;
      for (const pugi::xml_node feature : member.children())
        if (feature.type() == pugi::node_element) top_feature(feature, fallback_name);
    }
  }

  void top_feature(const pugi::xml_node& node, const std::string& fallback_name) {
    const string_view type = node.name();
    if (!is_known(node)) {
      drop("city object of an extension", node);
    } else if (type == "ReliefFeature" || type == "CityObjectGroup") {
      if (node.child("geometry")) drop("geometry of a group", node);
      members(node, id_of(node));
    } else if (type.ends_with("Relief") && type != "TINRelief") {
      drop("unsupported geometry " + std::string(type), node);
    } else {
      std::string name = id_of(node);
      if (name.empty()) name = printable(node.child_value("name"), 10000);
      if (name.empty() && type == "TINRelief") name = fallback_name;
      objects_.push_back({name, kind_of_type(type), place_of(node), {}});
      collect_feature(node, "");
      keep_highest_levels(objects_.back());
    }
  }

  void collect_feature(const pugi::xml_node& node, const std::string& part) {
    std::vector<Feature>& features = objects_.back().features;
    features.push_back({node.name(), part, place_of(node), {}});
    collect(node, features.size() - 1, "");
  }

  void collect(const pugi::xml_node& node, size_t feature, string_view theme) {
    for (const pugi::xml_node child : node.children()) {
      const string_view name = child.name();
      if (child.type() != pugi::node_element || name == "appearance" || name == "generalizesTo") continue;
      if (!is_known(child)) {
        if (child.find_node([](const pugi::xml_node& n) { return n.name() == string_view("Polygon"); }))
          drop("geometry of an extension", child);
      } else if (is_geometry(name)) {
        add_geometry(child, feature, theme);
      } else if (is_part(name)) {
        const std::string id = id_of(child);
        collect_feature(child, id.empty() ? std::string(name) : id);
      } else {
        collect(child, feature, is_theme(name) ? name : theme);
      }
    }
  }

  void add_geometry(const pugi::xml_node& property, size_t feature, string_view theme) {
    const Content content = content_of(document_, property);
    if (!content.surfaces) {
      drop("unsupported geometry " + content.type, property);
      return;
    }
    const int lod = property.name() == string_view("tin") ? -1 : property.name()[3] - '0';
    const bool implicit = !property.child("ImplicitGeometry").empty();
    objects_.back().features[feature].geometries.push_back(
        {property.internal_object(), lod, implicit, theme});
  }

  void keep_highest_levels(CityObject& object) {
    int best_of_parts = -1;
    for (const Feature& feature : object.features)
      if (feature.type.ends_with("Part")) best_of_parts = std::max(best_of_parts, best_lod(feature));
    for (Feature& feature : object.features) {
      const int best = best_lod(feature);
      const bool bettered = feature.part.empty() && best < 2 && best_of_parts > best;
      std::erase_if(feature.geometries, [&](const Geometry& geometry) {
        const bool below = geometry.lod < best;
        if (below)
          drop("LoD " + lod_text(geometry.lod) + " beside LoD " + lod_text(best), geometry.property());
        else if (bettered)
          drop("LoD " + lod_text(geometry.lod) + " beside LoD " + lod_text(best_of_parts) + " of the parts",
               geometry.property());
        return below || bettered;
      });
    }
  }

  static int best_lod(const Feature& feature) {
    int best = -1;
    for (const Geometry& geometry : feature.geometries) best = std::max(best, geometry.lod);
    return best;
  }

  std::string place_of(const pugi::xml_node& node) const {
    const std::string id = id_of(node);
    return file_ + ": " + node.name() + (id.empty() ? "" : " " + id);
  }

  void drop(const std::string& reason, const pugi::xml_node& node) {
    count_dropped(report_, reason, file_ + ": line " + std::to_string(document_.line(node)));
  }

  const Document& document_;
  const std::string& file_;
  ImportReport& report_;
  std::vector<CityObject> objects_;
};

}  // namespace

pugi::xml_node Geometry::property() const {
  return pugi::xml_node(node);
}

std::vector<CityObject> read_city_objects(const Document& document, const std::string& file,
                                          ImportReport& report) {
  return FeatureReader(document, file, report).read();
}

}  // namespace veduta::citygml
