#include "bench/shrink_table.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double least_volume_m3 = 100;  // shares of less say nothing

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

double share_of(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

/// "2.5 m" for the half-extent (2.5325, 2.5325, 0.5325).
std::string window_name(const Json& window) {
  return fmt::format("{:.2f} m", window.at("half_extent_m").at(0).get<double>());
}

void add_methods(const Json& city, std::string& text) {
  for (const Json& window : city.at("windows")) {
    if (!window.contains("methods")) continue;
    for (const auto& [name, method] : window["methods"].items()) {
      text += fmt::format(
          "| {} | {} | {:.0f} | `{}` | {} ± {} | {:.0f} / {:.0f} | {:.4f} |\n",
          city.at("name").get<std::string>(), window_name(window), window.at("eroded_m3").get<double>(), name,
          percent(method.at("kept_share").get<double>()), percent(method.at("kept_error").get<double>()),
          method.at("triangles_median").get<double>(), method.at("triangles_mean").get<double>(),
          city.at("methods").at(name).at("seconds_a_building").get<double>());
    }
  }
}

void add_alone(const Json& city, std::string& text) {
  if (!city.contains("alone")) return;
  const Json& alone = city["alone"];
  for (size_t w = 0; w < alone.at("windows").size(); ++w) {
    const Json& window = alone["windows"][w];
    const double together = window.at("eroded_together_m3").get<double>();
    text += fmt::format("| {} | {} | {} | {:.0f} | {:.0f} ({}) |", city.at("name").get<std::string>(),
                        window_name(city.at("windows").at(w)), alone.at("buildings").get<size_t>(), together,
                        window.at("eroded_alone_m3").get<double>(),
                        percent(share_of(window["eroded_alone_m3"].get<double>(), together)));
    if (together < least_volume_m3) {
      text += " – |\n";
      continue;
    }
    for (const auto& [name, method] : window.at("methods").items()) {
      text += fmt::format(" `{}` {} / {}", name,
                          percent(share_of(method.at("kept_together_m3").get<double>(), together)),
                          percent(share_of(method.at("kept_alone_m3").get<double>(), together)));
    }
    text += " |\n";
  }
}

void add_exact(const Json& city, std::string& text) {
  if (!city.contains("alone") || !city["alone"].contains("exact")) return;
  const Json& exact = city["alone"]["exact"];
  for (size_t w = 0; w < exact.at("windows").size(); ++w) {
    const Json& window = exact["windows"][w];
    text +=
        fmt::format("| {} | {} | {} of {} | {:.1f} | {:.1f} ± {:.1f} |", city.at("name").get<std::string>(),
                    window_name(city.at("windows").at(w)), exact.at("done").get<size_t>(),
                    exact.at("tried").get<size_t>(), window.at("exact_m3").get<double>(),
                    window.at("sampled_m3").get<double>(), window.at("sampled_error_m3").get<double>());
    const bool enough = window.at("exact_m3").get<double>() >= least_volume_m3;
    for (const auto& [name, share] : window.at("kept_of_exact").items())
      text += enough ? fmt::format(" `{}` {}", name, percent(share.get<double>())) : "";
    text += enough ? " |\n" : " – |\n";
  }
}

void add_faces(const Json& city, std::string& text) {
  for (const auto& [name, method] : city.at("methods").items()) {
    if (!method.contains("faces")) continue;
    const Json& f = method["faces"];
    const double all = f.at("faces").get<double>();
    text += fmt::format("| {} | {:.0f} |", city.at("name").get<std::string>(), all);
    for (const char* what : {"spikes", "intersecting", "turned", "unsafe", "kept"})
      text += fmt::format(" {} |", percent(share_of(f.at(what).get<double>(), all)));
    text += "\n";
  }
}

}  // namespace

std::string shrink_table(const std::vector<std::filesystem::path>& files) {
  std::vector<Json> cities;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file);
    cities.push_back(Json::parse(in));
  }
  std::string text =
      "| city | window, half | S, m³ | method | of S kept | triangles a building, median / mean | s a "
      "building "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const Json& city : cities) add_methods(city, text);
  text +=
      "\nThe same buildings eroded together and one by one, as shares of S together:\n\n| city | window, "
      "half | "
      "buildings | S together, m³ | S one by one, m³ | kept together / one by one "
      "|\n|---|---|---|---|---|---|\n";
  for (const Json& city : cities) add_alone(city, text);
  text +=
      "\nSingle buildings in exact arithmetic, where that finishes:\n\n| city | window, "
      "half | "
      "buildings | S exact, m³ | S by points, m³ | kept of exact |\n|---|---|---|---|---|---|\n";
  for (const Json& city : cities) add_exact(city, text);
  text +=
      "\nWhat becomes of the faces of `vertex`, over all rings of all windows:\n\n| city | faces | spikes | "
      "intersecting | turned over | removed by the safety check | kept |\n|---|---|---|---|---|---|---|\n";
  for (const Json& city : cities) add_faces(city, text);
  return text;
}

}  // namespace veduta::bench
