#include "worker/occlusion_method.h"

#include "scene/error.h"
#include "worker/panorama_method.h"
#include "worker/zoom_method.h"

namespace veduta {

std::unique_ptr<OcclusionMethod> make_occlusion_method(const std::string& name, const OcclusionInput& input) {
  if (name == "panorama") return std::make_unique<PanoramaMethod>(input);
  if (name == "zoom") return std::make_unique<ZoomMethod>(input);
  throw Error(ExitStatus::defect, "occlusion.method: there is no method '" + name + "'");
}

}  // namespace veduta
