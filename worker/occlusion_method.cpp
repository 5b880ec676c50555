#include "worker/occlusion_method.h"

#include "scene/error.h"
#include "worker/panorama_method.h"
#include "worker/zoom_method.h"

namespace veduta {

std::vector<Box> object_boxes(const OcclusionInput& input) {
  std::vector<Box> boxes;
  for (size_t o = 0; o < input.city.scene.objects.size(); ++o) boxes.push_back(input.city.scene.bounds(o));
  return boxes;
}

std::unique_ptr<OcclusionMethod> make_occlusion_method(const std::string& name, const OcclusionInput& input) {
  if (name == "panorama") return std::make_unique<PanoramaMethod>(input);
  if (name == "zoom") return std::make_unique<ZoomMethod>(input);
  throw Error(ExitStatus::defect, "occlusion.method: there is no method '" + name + "'");
}

}  // namespace veduta
