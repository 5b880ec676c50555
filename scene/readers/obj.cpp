#include "scene/readers/obj.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <unordered_map>

#include "scene/names.h"

namespace veduta {
namespace {

using std::string_view;

constexpr auto ignored =
    std::to_array<string_view>({"vn", "vt", "vp", "s", "mg", "mtllib", "maplib", "usemap", "bevel",
                                "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech"});
constexpr auto not_surfaces =
    std::to_array<string_view>({"l", "p", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm",
                                "trim", "hole", "scrv", "sp", "end", "con", "call", "csh"});

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

string_view trim(string_view text) {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

string_view next_word(string_view& rest) {
  rest = trim(rest);
  const size_t end = static_cast<size_t>(std::find_if(rest.begin(), rest.end(), blank) - rest.begin());
  const string_view word = rest.substr(0, end);
  rest.remove_prefix(end);
  return word;
}

// Faces between two changes of object or group.
struct Run {
  uint32_t object = 0;  // 0: before the first `o`
  uint32_t group = 0;   // 0: before the first `g`
  uint64_t polygon_begin = 0;
  uint64_t polygon_end = 0;
};

class ObjReader {
 public:
  ObjReader(const InputFile& file, ImportReport& report) : file_(file), report_(report) {
    model_.file = file.name;
    model_.format = "OBJ";
  }

  RawModel read() {
    string_view rest = file_.content();
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    std::string joined;
    for (uint64_t number = 1; !rest.empty(); ++number) {
      line_ = number;
      string_view text = take_line(rest);
      if (continues(text)) {
        joined.clear();
        while (continues(text)) {
          joined.append(text.substr(0, text.size() - 1)).push_back(' ');
          text = take_line(rest);
          ++number;
        }
        text = string_view(joined.append(text));
      }
      statement(text);
    }
    make_objects();
    return std::move(model_);
  }

 private:
  // A comment may end in a backslash without going on (a Windows path).
  static bool continues(string_view line) { return line.ends_with('\\') && !line.starts_with('#'); }

  static string_view take_line(string_view& rest) {
    const size_t end = rest.find('\n');
    const string_view line = rest.substr(0, end);
    rest.remove_prefix(end == string_view::npos ? rest.size() : end + 1);
    return trim(line);
  }

  Error error(const std::string& what) const {
    return bad_input(file_.name, "line " + std::to_string(line_), what);
  }

  void statement(string_view rest) {
    if (rest.empty() || rest.front() == '#') return;
    const string_view word = next_word(rest);
    const string_view data = rest.substr(0, rest.find('#'));  // but names may hold a '#'
    if (word == "v") {
      vertex(data);
    } else if (word == "f" || word == "fo") {
      face(data);
    } else if (word == "o") {
      object_names_.push_back(printable(trim(rest), 10000));
      group_material_ = Material::unknown;
      start_run(static_cast<uint32_t>(object_names_.size()), 0);
    } else if (word == "g") {
      const std::string name = trim(rest).empty() ? "default" : printable(trim(rest), 10000);
      const auto [known, added] =
          group_number_.try_emplace(name, static_cast<uint32_t>(group_names_.size() + 1));
      if (added) group_names_.push_back(name);
      group_material_ = material_of_name(name);
      start_run(runs_.back().object, known->second);
    } else if (word == "usemtl") {
      used_material_ = material_of_name(trim(rest));
    } else if (std::find(not_surfaces.begin(), not_surfaces.end(), word) != not_surfaces.end()) {
      count_dropped(report_, "OBJ statement '" + std::string(word) + "'",
                    file_.name + ": line " + std::to_string(line_));
    } else if (std::find(ignored.begin(), ignored.end(), word) == ignored.end()) {
      throw error("unknown statement '" + printable(word, 40) + "'; is this a Wavefront OBJ file?");
    }
  }

  void vertex(string_view rest) {
    glm::dvec3 p(0);
    for (int axis = 0; axis < 3; ++axis) {
      const string_view word = next_word(rest);
      if (word.empty()) throw error("a vertex of " + std::to_string(axis) + " numbers; it needs 3");
      p[axis] = number(word);
      if (!std::isfinite(p[axis]))
        throw error("coordinate '" + printable(word, 40) + "' is not a finite number; repair the vertex");
    }
    if (model_.vertices.size() >= std::numeric_limits<uint32_t>::max())
      throw error("more than 4 billion vertices; cut the model into tiles");
    model_.vertices.push_back(p);
  }

  double number(string_view word) const {
    const string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (status == std::errc::invalid_argument || end != digits.data() + digits.size())
      throw error("'" + printable(word, 40) + "' is not a number");
    // from_chars does not say whether a number is too large or too small for a double; strtod does.
    return status == std::errc() ? value : std::strtod(std::string(digits).c_str(), nullptr);
  }

  void face(string_view rest) {
    uint64_t corners = 0;
    for (string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners)
      model_.ring_vertex.push_back(corner(word));
    if (corners == 0) throw error("a face without vertices");
    model_.ring_end.push_back(model_.ring_vertex.size());
    const auto line = static_cast<uint32_t>(std::min<uint64_t>(line_, std::numeric_limits<uint32_t>::max()));
    const bool used = used_material_ != Material::unknown;
    model_.polygons.push_back({model_.ring_end.size(), line, used ? used_material_ : group_material_});
    runs_.back().polygon_end = model_.polygons.size();
  }

  // "12", "12/3", "12//5", "12/3/5", "-1/-1": only the vertex counts.
  uint32_t corner(string_view word) const {
    const string_view digits = word.substr(0, word.find('/'));
    int64_t index = 0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (digits.empty() || status != std::errc() || end != digits.data() + digits.size())
      throw error("'" + printable(word, 40) + "' is not a vertex index");
    const auto count = static_cast<int64_t>(model_.vertices.size());
    const int64_t found = index < 0 ? count + index : index - 1;
    if (found < 0 || found >= count)
      throw error("vertex " + std::to_string(index) + " of the face is not among the " +
                  std::to_string(count) + " vertices before it; check the export");
    return static_cast<uint32_t>(found);
  }

  void start_run(uint32_t object, uint32_t group) {
    runs_.push_back({object, group, model_.polygons.size(), model_.polygons.size()});
  }

  // Objects in the order of their names; in each, its groups in the order in which they first appear.
  void make_objects() {
    const bool groups_are_objects = object_names_.empty();
    const size_t count = 1 + (groups_are_objects ? group_names_.size() : object_names_.size());
    model_.objects.resize(count);
    for (size_t i = 0; i < count; ++i) {
      RawObject& object = model_.objects[i];
      object.name = i == 0 ? file_.stem : (groups_are_objects ? group_names_[i - 1] : object_names_[i - 1]);
      object.kind = kind_of_name(object.name);
      object.place = file_.name + ": " + (groups_are_objects ? "g " : "o ") + printable(object.name);
    }
    if (!groups_are_objects)  // parts are runs of triangles: bring each group's faces together
      std::stable_sort(runs_.begin(), runs_.end(),
                       [](const Run& a, const Run& b) { return a.group < b.group; });
    for (const Run& run : runs_) {
      if (run.polygon_begin == run.polygon_end) continue;
      RawObject& object = model_.objects[groups_are_objects ? run.group : run.object];
      const bool part = !groups_are_objects && run.group != 0;
      object.patches.push_back(
          {part ? group_names_[run.group - 1] : "", file_.name, run.polygon_begin, run.polygon_end});
    }
    model_.has_objects = !object_names_.empty() || !group_names_.empty();
    if (model_.objects.front().patches.empty()) model_.objects.erase(model_.objects.begin());
  }

  const InputFile& file_;
  ImportReport& report_;
  RawModel model_;
  uint64_t line_ = 0;
  Material used_material_ = Material::unknown, group_material_ = Material::unknown;  ///< what names say
  std::vector<std::string> object_names_, group_names_;
  std::unordered_map<std::string, uint32_t> group_number_;
  std::vector<Run> runs_{Run{}};
};

}  // namespace

RawModel read_obj(const InputFile& file, ImportReport& report) {
  return ObjReader(file, report).read();
}

}  // namespace veduta
