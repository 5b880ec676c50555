// The files of a model: one file with its siblings, a folder, or an archive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/text.h"

namespace veduta {

/// Finds a file that a model file refers to, by its path relative to the folder of that model file ('/'
/// between folders, "." and ".." allowed inside of the model). Nothing when there is no such file.
/// \throw Error(bad_input) for a path that leads out of the model; Error as read_input does.
using FindFile = std::function<std::optional<InputFile>(const std::string& relative)>;

/// What a user names as a model: a file, a folder, or an archive (zip, tar, 7z; also a single file compressed
/// by gzip, bzip2, xz or zstd). Reading is safe from several threads at a time.
class ModelFiles {
 public:
  enum class Form { file, folder, archive };

  /// Lists a folder, and unpacks an archive into memory (scene/archive.h). Hidden files are passed over; a
  /// folder that symbolic links lead to twice is listed once.
  /// \throw Error(bad_input) when there is no such file, when it is neither a regular file nor a folder, when
  /// a folder cannot be listed, and as unpack_archive() does
  explicit ModelFiles(const std::filesystem::path& model);

  Form form() const { return form_; }

  /// The files by their paths inside of the model ('/' between folders), sorted by bytes. Of a Form::file the
  /// one name, although find_from() also finds its siblings.
  const std::vector<std::string>& names() const { return names_; }

  /// What the folder or archive holds besides files: pipes, broken links, links in archives.
  const std::vector<std::string>& not_files() const { return not_files_; }

  /// `name` as messages show it: below the path that the user gave.
  std::string shown(const std::string& name) const;

  /// \param name one of names() \throw Error as read_input does
  InputFile read(const std::string& name) const;

  /// The first bytes of a file, as many as there are up to `count`; none when it cannot be read.
  std::string head(const std::string& name, size_t count) const;

  /// What `name` refers to. The function lives as long as this.
  FindFile find_from(const std::string& name) const;

  /// The name that `relative` has when `name` refers to it; nothing when it leads out of the model.
  static std::optional<std::string> resolve(const std::string& name, const std::string& relative);

 private:
  void list_folder(const std::filesystem::path& folder, const std::string& prefix,
                   std::set<std::pair<uint64_t, uint64_t>>& seen);

  Form form_ = Form::file;
  std::filesystem::path given_;  // as the user wrote it
  std::filesystem::path root_;   // the names are below it; not used by archives
  std::vector<std::string> names_, not_files_;
  std::map<std::string, std::string> unpacked_;
};

/// Every file on disk whose content a model depends on, sorted: of a folder all (but hidden ones); of a file
/// itself and what it refers to (tileset.json: everything beneath its folder, .gltf: its buffers, .shp: files
/// of the same stem). First the name that is hashed with the content, then the path.
/// \throw Error(bad_input) when the model is missing or cannot be read
std::vector<std::pair<std::string, std::filesystem::path>> files_of(const std::filesystem::path& model);

}  // namespace veduta
