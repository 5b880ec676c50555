// Scenes that are too large to keep.
#pragma once

#include <filesystem>
#include <string>

namespace veduta::hard {

/// Writes the scene of that name as OBJ. \throw std::runtime_error for a name that it does not know.
void write_generated_scene(const std::string& name, const std::filesystem::path& obj);

}  // namespace veduta::hard
