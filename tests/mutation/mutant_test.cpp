// mutant_test sound|caught PLACE...: bakes the places and shoots rays into them. The same for every mutant
// and for the control, which has nothing broken. 0: as expected; 1: not; 77: no GL here.
#include <fmt/format.h>

#include <exception>
#include <string_view>

#include "gl/egl_context.h"
#include "tests/mutation/places.h"
#include "tests/worker/shoot.h"

namespace veduta::mutation {
namespace {

void tell(const std::string& name, const test::OcclusionCity& city, const VerifyReport& report) {
  if (report.passed()) {
    fmt::print("{}: sound, {} rays\n", name, report.rays);
    return;
  }
  fmt::print("{}: caught, {} objects, {} triangles false invisible, worst solid angle {:.2g}\n", name,
             report.false_invisible_objects, report.false_invisible_triangles,
             report.false_invisible_solid_angle_worst);
  const FalseInvisible& first = report.examples.front();
  fmt::print("  {} from ({:.3f}, {:.3f}, {:.3f}) at ({:.3f}, {:.3f}, {:.3f})\n",
             city.city().scene.objects[first.object].name, first.eye.x, first.eye.y, first.eye.z, first.hit.x,
             first.hit.y, first.hit.z);
}

/// \return whether rays found nothing.
bool bake_and_verify(const Place& place) {
  test::OcclusionCity city;
  city.settings.stereo.eye_margin_m = 0;  // a reserve that would hide what is wrong by less
  place.build(city);
  const auto method = make_occlusion_method(place.method, city.input());
  std::vector<CellOcclusion> answers;
  method->bake(city.all_cells(), [&](const CellOcclusion& answer) { answers.push_back(answer); });
  const VerifyReport report =
      test::shoot(city, answers, place.rays / answers.size(), city.settings.stereo.eye_margin_m);
  if (report.rays == 0) throw Error(ExitStatus::defect, place.name + ": no ray was shot");
  tell(place.name, city, report);
  return report.passed();
}

int run(std::string_view expected, const std::vector<std::string>& names) {
  bool sound = true;
  for (const std::string& name : names) sound = bake_and_verify(place(name)) && sound;
  return sound == (expected == "sound") ? 0 : 1;
}

}  // namespace
}  // namespace veduta::mutation

int main(int argc, char** argv) {
  using namespace veduta;
  if (argc < 3) {
    fmt::print(stderr, "mutant_test sound|caught PLACE...\n");
    return 2;
  }
  std::optional<EglContext> context;
  try {
    context.emplace("software");
  } catch (const Error& error) {
    fmt::print("skipped: {}\n", error.what());
    return 77;
  }
  try {
    return mutation::run(argv[1], {argv + 2, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "mutant_test: {}\n", error.what());
    return 70;
  }
}
