// From a file of a model to what its reader finds.
#pragma once

#include <optional>
#include <string>

#include "scene/model_files.h"
#include "scene/raw_model.h"
#include "scene/readers/obj_origin.h"

namespace veduta {

struct ReadModel {
  RawModel model;
  std::optional<ObjOrigin> origin;  ///< the model is local to a place on earth (obj_origin.h)
};

/// Reads one file of a model with the reader for its content or extension. Nothing for an index of models,
/// and for JSON in a folder that is of none of our formats.
/// \param name of files.names()
/// \throw Error(bad_input) as import_scene does; also when no reader knows the file
std::optional<ReadModel> read_model(const ModelFiles& files, const std::string& name,
                                    const ImportOptions& options, ImportReport& report);

}  // namespace veduta
