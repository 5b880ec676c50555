#include "scene/readers/gltf.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include "scene/readers/earth_centred.h"
#include "scene/readers/gltf_document.h"
#include "scene/readers/gltf_objects.h"

namespace veduta {

RawModel read_gltf(const InputFile& file, const FindFile& find, ImportReport& report) {
  RawModel model;
  model.file = file.name;
  model.format = "glTF 2.0";
  model.up = UpAxis::y;
  const auto gltf = parse_gltf(file.content(), file.name, find, report);
  GltfPlacing placing;
  const glm::dvec3 center = rtc_center(*gltf, file.name);
  const bool on_earth = earth_centred(center);
  if (center != glm::dvec3(0)) {
    model.up = UpAxis::z;
    placing.model_from_gltf = glm::translate(glm::dmat4(1), center) * z_up_from_y_up();
    placing.instances = !on_earth;
  }
  add_gltf(*gltf, file.content().size(), file.name, placing, model, report);
  if (on_earth) to_geographic(model);
  if (model.objects.size() == 1 && model.objects.front().name.starts_with("node_")) {
    model.has_objects = false;
    model.objects.front().name = file.stem;
  }
  return model;
}

}  // namespace veduta
