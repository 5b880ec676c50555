#include <fmt/format.h>

#include <fstream>

#include "bench/occlusion_report.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Three digits that say something; "–" for what is not there.
std::string number(const Json& value) {
  if (!value.is_number()) return "–";
  const double x = value.get<double>();
  return x >= 100 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

std::string millions(const Json& value) {
  return value.is_number() ? fmt::format("{:.3g}", value.get<double>() / 1e6) : "–";
}

std::string spread(const Json& value) {
  if (!value.is_object()) return "–";
  return fmt::format("{} / {} / {}", number(value.at("median")), number(value.at("mean")),
                     number(value.at("p95")));
}

std::string name_of(const Json& answer) {
  return fmt::format("{} | {}", answer.at("name").get<std::string>(),
                     answer.at("city").at("buildings").get<uint64_t>());
}

void add_costs(const Json& answer, std::string& text) {
  for (const Json& method : answer.at("methods")) {
    const Json& over = method.at("overestimate");
    text += fmt::format(
        "| {} | `{}` | {} | {} | {} | {} | {} | {} | {} |\n", name_of(answer),
        method.at("method").get<std::string>(), method.at("cells").get<size_t>(),
        spread(method.at("ms_a_cell")), number(method.at("together_ms_a_cell")),
        number(method.at("work_a_cell").at("parts")), spread(method.at("ms_a_part")),
        number(method.at("row_objects").at("mean")),
        over.is_object()
            ? fmt::format("{} / {}; {:.0f} % within {}", number(over.at("median")), number(over.at("worst")),
                          100 * over.at("within_share").get<double>(), number(over.at("asked")))
            : "–");
  }
}

void add_ratios(const Json& answer, std::string& text) {
  if (!answer.contains("vs")) return;
  const Json& vs = answer["vs"];
  text += fmt::format(
      "| {} | `{}` over `{}` | {} | {} | {} | {} |\n", name_of(answer), vs.at("method").get<std::string>(),
      answer.at("methods").at(0).at("method").get<std::string>(), vs.at("cells").get<size_t>(),
      number(vs.at("ms_a_part")), number(vs.at("ms_a_cell")), number(vs.at("row_objects")));
}

void add_stages(const Json& answer, std::string& text) {
  for (const Json& method : answer.at("methods")) {
    text += fmt::format("| {} | `{}` |", name_of(answer), method.at("method").get<std::string>());
    for (const auto& [stage, ms] : method.at("stages_ms_a_cell").items())
      text += fmt::format(" {} |", number(ms));
    text += fmt::format(" {} |", number(method.at("staged_ms_a_cell")));
    for (const auto& [what, count] : method.at("work_a_cell").items())
      if (what != "parts") text += fmt::format(" {} |", number(count));
    text += "\n";
  }
}

void add_limits(const Json& answer, std::string& text) {
  if (!answer.contains("limits")) return;
  const Json& l = answer["limits"];
  text += fmt::format("| {} | {} | {} / {} | {} / {} | {} | {} | {} | {} |\n", name_of(answer),
                      answer.at("renderer").get<std::string>(), millions(l.at("triangles_per_s")),
                      millions(l.at("streamed_triangles_per_s")), millions(l.at("pixels_per_s")),
                      millions(l.at("rejected_pixels_per_s")), millions(l.at("box_tests_per_s")),
                      millions(l.at("queries_per_s")), millions(l.at("rays_per_s")),
                      number(l.at("read_back_ms")));
}

void add_shares(const Json& answer, std::string& text) {
  for (const Json& method : answer.at("methods")) {
    if (!method.contains("against_limits")) continue;
    for (const auto& [stage, against] : method["against_limits"].items())
      text += fmt::format("| {} | `{}` | {} | {} | {} | {:.0f} % |\n", name_of(answer),
                          method.at("method").get<std::string>(), stage, number(against.at("ms_a_cell")),
                          number(against.at("limit_ms_a_cell")), 100 * against.at("share").get<double>());
  }
}

}  // namespace

std::string occlusion_table(const std::vector<std::filesystem::path>& files) {
  std::vector<Json> answers;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file);
    answers.push_back(Json::parse(in));
  }
  std::string text;
  const auto add = [&](const std::string& head, void (*rows)(const Json&, std::string&)) {
    std::string body;
    for (const Json& answer : answers) rows(answer, body);
    if (!body.empty()) text += (text.empty() ? "" : "\n") + head + body;
  };
  add("| city | buildings | method | cells | ms a cell, median / mean / p95 | all together | parts a cell | "
      "ms a part, "
      "median / mean / p95 | row, objects | certified, median / worst "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n",
      add_costs);
  add("| city | buildings | methods | cells | ms a part | ms a cell | row, objects "
      "|\n|---|---|---|---|---|---|---|\n",
      add_ratios);
  add("Stages one after the other, ms a cell, and what there is to do in a cell:\n\n"
      "| city | buildings | method | occluders | boxes | slices | read-back | rays | host | rows | all | "
      "triangles | "
      "pixels | boxes | queries | rays | read-backs |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      add_stages);
  add("What the renderer reaches in bare loops, in millions a second:\n\n"
      "| city | buildings | renderer | triangles, resident / sent | pixels, written / refused | box tests | "
      "queries | "
      "rays | a read-back, ms |\n|---|---|---|---|---|---|---|---|---|\n",
      add_limits);
  add("Against those limits:\n\n"
      "| city | buildings | method | stage | ms a cell | at the limit | of the limit "
      "|\n|---|---|---|---|---|---|---|\n",
      add_shares);
  return text;
}

}  // namespace veduta::bench
