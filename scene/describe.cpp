#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/import.h"

namespace veduta {
namespace {

std::string size_text(uint64_t bytes) {
  return bytes < 1'000'000 ? fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3)
                           : fmt::format("{:.2f} MB", static_cast<double>(bytes) / 1e6);
}

std::string line(const char* label, const std::string& text) {
  return fmt::format("{:<11}{}\n", label, text);
}

std::string objects_text(const ImportReport& report, size_t total) {
  std::string text = std::to_string(total);
  const char* separator = ": ";
  for (const auto& [kind, count] : report.objects_by_kind) {
    text += fmt::format("{}{} {}", separator, count, kind);
    separator = ", ";
  }
  return text;
}

std::string extents_text(const Scene& scene, const Box& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = scene.origin[static_cast<size_t>(axis)];
    text += fmt::format("{}{} {:.3f} to {:.3f} m", axis == 0 ? "" : ", ", "xyz"[axis],
                        origin + static_cast<double>(box.lower[axis]),
                        origin + static_cast<double>(box.upper[axis]));
  }
  const glm::vec3 size = 2.0f * box.half_extent();
  return text + fmt::format(" ({:.1f} x {:.1f} x {:.1f} m)", size.x, size.y, size.z);
}

}  // namespace

std::string describe(const ImportResult& result) {
  const Scene& scene = result.scene;
  const ImportReport& report = result.report;
  std::string text =
      line("format", fmt::format("{}, {}{}", report.format,
                                 report.files > 1 ? fmt::format("{} files, ", report.files) : "",
                                 size_text(report.bytes_read)));
  text += line("CRS", scene.crs.empty() ? "not stated" : scene.crs);
  text += line("objects", objects_text(report, scene.objects.size()));
  if (report.instances > 0)
    text += line("instances", fmt::format("{} of {} meshes", report.instances, scene.meshes.size()));
  text += line("parts", std::to_string(report.parts));
  text += line("polygons", fmt::format("{}, {} with holes", report.polygons, report.polygons_with_holes));
  text += line("triangles", std::to_string(scene.triangle_count()));
  text += line("vertices", std::to_string(scene.vertices.size()));
  text += line("extents", extents_text(scene, scene.bounds()));
  text += line("origin",
               fmt::format("{:.0f}, {:.0f}, {:.0f} m", scene.origin[0], scene.origin[1], scene.origin[2]));
  if (report.skirt_triangles > 0)
    text += line("added", fmt::format("{} triangles that close the earth below open edges of the terrain",
                                      report.skirt_triangles));
  for (const std::string& added : report.added) text += line("added", added);
  if (report.dropped.empty()) text += line("dropped", "nothing");
  for (const auto& [reason, dropped] : report.dropped)
    text += line("dropped", fmt::format("{} x {}; first: {}", dropped.count, reason, dropped.first_place));
  return text;
}

std::string describe_json(const ImportResult& result) {
  const Scene& scene = result.scene;
  const ImportReport& report = result.report;
  const Box box = scene.bounds();
  nlohmann::ordered_json json = {{"format", report.format},
                                 {"files", report.files},
                                 {"bytes", report.bytes_read},
                                 {"crs", scene.crs},
                                 {"objects", report.objects_by_kind},
                                 {"instances", report.instances},
                                 {"parts", report.parts},
                                 {"polygons", report.polygons},
                                 {"triangles", scene.triangle_count()},
                                 {"vertices", scene.vertices.size()}};
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = scene.origin[static_cast<size_t>(axis)];
    json["lower"].push_back(origin + static_cast<double>(box.lower[axis]));
    json["upper"].push_back(origin + static_cast<double>(box.upper[axis]));
  }
  json["origin"] = scene.origin;
  json["added"] = report.added;
  if (report.skirt_triangles > 0)
    json["added"].push_back(fmt::format("{} triangles of earth below open edges", report.skirt_triangles));
  json["dropped"] = nlohmann::ordered_json::array();
  for (const auto& [reason, dropped] : report.dropped)
    json["dropped"].push_back(
        {{"reason", reason}, {"count", dropped.count}, {"first_place", dropped.first_place}});
  return json.dump(2);
}

}  // namespace veduta
