#include "tests/campaign/campaign_scene.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "scene/error.h"

namespace veduta::campaign {
namespace {

constexpr const char* model_name = "scene.obj";

std::string to_obj(const CampaignScene& scene) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Thing& thing : scene.things) {
    fmt::format_to(out, "o {}\n", thing.name);
    for (const Piece& piece : thing.pieces) {
      for (const Polygon& polygon : faces(piece)) {
        for (const glm::dvec3& p : polygon)
          fmt::format_to(out, "v {} {} {}\n", scene.origin.x + p.x, scene.origin.y + p.y, p.z);
        text += "f";
        for (size_t n = polygon.size(); n > 0; --n) fmt::format_to(out, " -{}", n);
        text += "\n";
      }
    }
  }
  return text;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written");
}

}  // namespace

Settings CampaignScene::resolved(const std::filesystem::path& folder) const {
  Settings all = settings;
  all.scene.model = {(folder / model_name).string()};
  const glm::dvec2 a = origin + lower, b = origin + upper;
  all.cells.region = {{a.x, a.y}, {b.x, a.y}, {b.x, b.y}, {a.x, b.y}};
  return all;
}

void write_scene(const CampaignScene& scene, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_text(folder / model_name, to_obj(scene));
  Settings settings = scene.resolved(folder);
  settings.scene.model = {model_name};  // beside it, wherever the folder goes
  write_text(folder / "bake.toml", to_toml(settings));
}

}  // namespace veduta::campaign
