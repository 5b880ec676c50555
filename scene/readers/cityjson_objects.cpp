#include "scene/readers/cityjson_objects.h"

#include "scene/text.h"

namespace veduta::cityjson {
namespace {

using Array = simdjson::dom::array;
using std::string_view;

class ObjectReader {
 public:
  ObjectReader(const std::string& file, const std::string& line, ImportReport& report)
      : file_(file), line_(line), report_(report) {}

  std::vector<CityObject> read(const Element& document) {
    simdjson::dom::object all;
    if (document["CityObjects"].get(all) != simdjson::SUCCESS)
      throw bad_input(file_, line_ + "CityObjects", "is missing or not an object; check the export");
    std::unordered_map<string_view, size_t> number;
    for (const auto& [id, element] : all) {
      CityObject object{id, "", element, none, none};
      if (element["type"].get(object.type) != simdjson::SUCCESS)
        throw bad_input(file_, line_ + place_of(object) + "/type",
                        "is missing or not a string; check the export");
      number.try_emplace(id, objects_.size());
      objects_.push_back(object);
    }
    for (CityObject& object : objects_) find_parent(object, number);
    resolve_roots();
    return std::move(objects_);
  }

 private:
  // The first parent that is an object proper: a CityObjectGroup only collects.
  void find_parent(CityObject& object, const std::unordered_map<string_view, size_t>& number) {
    Array parents;
    if (object.element["parents"].get(parents) != simdjson::SUCCESS) return;
    for (const Element parent : parents) {
      string_view id;
      const bool named = parent.get(id) == simdjson::SUCCESS;
      const auto found = named ? number.find(id) : number.end();
      if (found == number.end()) {
        count_dropped(report_, "parent that is not in the file",
                      file_ + ": " + line_ + place_of(object) + "/parents");
      } else if (objects_[found->second].type != "CityObjectGroup") {
        object.parent = found->second;
        return;
      }
    }
  }

  // Follows parents to the top, each object once; who meets himself on the way is the top of his circle.
  void resolve_roots() {
    std::vector<size_t> path;
    std::vector<uint8_t> on_path(objects_.size(), 0);
    for (size_t start = 0; start < objects_.size(); ++start) {
      path.clear();
      size_t at = start;
      while (objects_[at].root == none && !on_path[at] && objects_[at].parent != none) {
        on_path[at] = 1;
        path.push_back(at);
        at = objects_[at].parent;
      }
      if (objects_[at].root == none) {
        if (on_path[at])
          count_dropped(report_, "parents in a circle",
                        file_ + ": " + line_ + place_of(objects_[at]) + "/parents");
        objects_[at].root = at;
      }
      for (const size_t passed : path) {
        objects_[passed].root = objects_[at].root;
        on_path[passed] = 0;
      }
    }
  }

  const std::string& file_;
  const std::string& line_;
  ImportReport& report_;
  std::vector<CityObject> objects_;
};

}  // namespace

std::vector<CityObject> read_objects(const Element& document, const std::string& file,
                                     const std::string& line, ImportReport& report) {
  return ObjectReader(file, line, report).read(document);
}

std::string place_of(const CityObject& object) {
  return "CityObjects/" + printable(object.id);
}

}  // namespace veduta::cityjson
