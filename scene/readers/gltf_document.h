// A glTF 2.0 document: JSON and buffers in memory, images left where they are.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "scene/model_files.h"
#include "scene/raw_model.h"

namespace tinygltf {
class Model;
}

namespace veduta {

/// Parses a .gltf or .glb. What tinygltf does not check before it believes it is checked here: the nesting of
/// the JSON, the version, and that every required extension is one that we know (those that only change how
/// surfaces look, KHR_mesh_quantization, EXT_mesh_gpu_instancing, ...). Optional extensions that are not read
/// are counted as dropped. Buffers are not yet checked against views and accessors (gltf_accessor.h).
/// \param content followed by InputFile::padding readable bytes
/// \param name    of the file, for messages
/// \throw Error(bad_input), "city.glb: JSON: ..."
std::shared_ptr<const tinygltf::Model> parse_gltf(std::string_view content, const std::string& name,
                                                  const FindFile& find, ImportReport& report);

/// The centre that extension CESIUM_RTC moves the document to, in the z-up space of its tile; (0, 0, 0)
/// without it. \throw Error(bad_input) when it is not 3 finite numbers
glm::dvec3 rtc_center(const tinygltf::Model& gltf, const std::string& name);

/// A URI's "%20" and the like as characters.
std::string decode_uri(std::string_view uri);

}  // namespace veduta
