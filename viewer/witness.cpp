#include "viewer/witness.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "gl/egl_context.h"
#include "scene/text.h"
#include "viewer/city_pages.h"
#include "viewer/draw/composer.h"
#include "viewer/draw/offscreen.h"

namespace veduta {
namespace {

using nlohmann::json;

constexpr float narrowest_deg = 2, widest_deg = 55;
constexpr float around = 4;  // times the triangle

size_t number_of(const std::string& text) {
  size_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size())
    throw Error(ExitStatus::usage,
                fmt::format("--witness: \"{}\" is not the number of an example, from 0 on", printable(text)));
  return number;
}

glm::vec3 point(const json& values) {
  if (!values.is_array() || values.size() != 3) throw std::invalid_argument("not x, y, z");
  return {values[0].get<float>(), values[1].get<float>(), values[2].get<float>()};
}

/// Of what describe_json of verify/ writes.
Witness witness_of(const json& example) {
  Witness w;
  w.cell = example.at("cell").get<uint32_t>(), w.object = example.at("object").get<uint32_t>();
  w.triangle = example.at("triangle").get<uint64_t>();
  w.eye = point(example.at("eye_m")), w.direction = point(example.at("direction"));
  w.hit = point(example.at("hit_m"));
  w.direction = glm::normalize(w.direction);
  w.gap_m = example.value("gap_m", 0.0f), w.gap_from_eye_m = example.value("gap_from_eye_m", 0.0f);
  return w;
}

std::vector<Witness> read_report(const PvsIndex& index, const std::string& name) {
  const InputFile input = read_input(name);
  Verification found;
  try {
    const json report = json::parse(input.content());
    if (report.at("content_digest").get<std::string>() != index.content_digest)
      throw bad_input(name, "content_digest", "is about another bake; verify this one");
    for (const char* list : {"examples", "narrow_gap_examples"})
      for (const json& example : report.at(list)) found.witnesses.push_back(witness_of(example));
  } catch (const json::exception& error) {
    throw bad_input(name, "file", "is no report of veduta verify --json: " + printable(error.what()));
  } catch (const std::invalid_argument& error) {
    throw bad_input(name, "file", std::string("is no report of veduta verify --json: ") + error.what());
  }
  if (const auto defect = find_defect(found, index.cells.size(), index.objects))
    throw bad_input(name, "examples", *defect);
  return found.witnesses;
}

}  // namespace

Witness find_witness(const PvsIndex& index, const std::string& name, const std::string& which) {
  const size_t colon = which.rfind(':');
  const bool from_report = colon != std::string::npos;
  const size_t number = number_of(from_report ? which.substr(colon + 1) : which);
  if (!from_report && !index.verification)
    throw Error(ExitStatus::usage,
                fmt::format("{}: holds no verification; run veduta verify --store on it", name));
  const std::vector<Witness> all =
      from_report ? read_report(index, which.substr(0, colon)) : index.verification->witnesses;
  if (number >= all.size())
    throw Error(ExitStatus::usage,
                all.empty()
                    ? fmt::format("--witness {}: the verification found nothing to look at", which)
                    : fmt::format("--witness {}: there are {} examples, from 0 on", which, all.size()));
  return all[number];
}

Pose pose_of(const Witness& witness) {
  const glm::vec3& d = witness.direction;
  return {witness.eye, glm::degrees(std::atan2(d.y, d.x)),
          glm::degrees(std::asin(std::clamp(d.z, -1.0f, 1.0f)))};
}

float fov_of(const Witness& witness, const CitySource& source) {
  const City city = source.read_objects(witness.object, witness.object + 1);
  const uint64_t triangle = witness.triangle - source.index().objects[witness.object].triangle_begin;
  float widest = 0;  // of the triangle, around the ray, radians
  for (int k = 0; k < 3; ++k) {
    const glm::vec3 to = city.scene.vertices[city.scene.triangles[triangle][k]] - witness.eye;
    const float across = glm::length(glm::cross(witness.direction, to));
    widest = std::max(widest, std::atan2(across, glm::dot(witness.direction, to)));
  }
  return std::clamp(around * glm::degrees(widest), narrowest_deg, widest_deg);
}

WitnessPicture draw_witness(std::unique_ptr<const CitySource> source, const Witness& witness,
                            const HeadlessOptions& options, uint64_t memory_bytes) {
  const EglContext context(options.gpu);
  // The row of its own cell: the eye may lie on a face that two cells share.
  VisibleObjects row, everything;
  row.cell = witness.cell;
  row.entries = source->read_row(source->index().cell_row[witness.cell]);
  everything.everything = true;

  CityStream stream(std::move(source), memory_bytes);
  CityPages city(stream, options.frame.samples);
  city.fetch({witness.eye, {}, {}, true});
  Optics optics = options.begin.optics;
  optics.aspect = static_cast<float>(options.picture.x) / static_cast<float>(options.picture.y);
  const EyeView view = eye_view(pose_of(witness), optics, Eye::middle);
  const Offscreen target(options.picture);
  const auto draw = [&](bool missing) {
    city.painter().begin({&view, 1}, options.picture.x, options.picture.y);
    const CommandList list = city.lister().list(row, {}), all = city.lister().list(everything, {});
    city.painter().draw_city({&list, 1});
    if (missing) city.painter().draw_missing({&all, 1});
    city.painter().draw_sky();
    Composer().compose(StereoMode::mono, false, city.painter().end(),
                       {target.framebuffer(), target.size(), {0, 0}});
    return read_picture(target.framebuffer(), target.size());
  };
  const Image drawn = draw(false), with_missing = draw(true);
  return {beside(drawn, with_missing), pixels_that_differ(drawn, with_missing)};
}

}  // namespace veduta
