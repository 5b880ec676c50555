// Which files the files of a model refer to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace veduta {

/// The paths that a glTF or 3D Tiles document refers to (the values of "uri" and "url", percent-decoded, data
/// URIs left out), in the document's order. None for what is no JSON.
std::vector<std::string> references_of_json(std::string_view json);

/// The files beside a model file on disk that belong to it, by their paths from its folder: what a .gltf
/// refers to, and of a .shp the files of its stem. Only those that exist.
std::vector<std::string> siblings_of(const std::filesystem::path& model);

}  // namespace veduta
