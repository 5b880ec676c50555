#include "scene/model_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "scene/archive.h"
#include "scene/model_references.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;

constexpr size_t signature_bytes = 300;

std::string file_head(const fs::path& path, size_t count) {
  std::string head(count, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(count));
  head.resize(static_cast<size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return head;
}

}  // namespace

ModelFiles::ModelFiles(const fs::path& model) : given_(model), root_(model) {
  std::error_code error;
  if (fs::is_directory(model, error)) {
    form_ = Form::folder;
    std::set<std::pair<uint64_t, uint64_t>> seen;
    list_folder(model, "", seen);
    std::sort(names_.begin(), names_.end());
    std::sort(not_files_.begin(), not_files_.end());
    return;
  }
  const std::string extension = extension_of(model);
  if (fs::is_regular_file(model, error) && is_archive(file_head(model, signature_bytes), extension)) {
    form_ = Form::archive;
    Unpacked unpacked = unpack_archive(model);
    unpacked_ = std::move(unpacked.files);
    not_files_ = std::move(unpacked.not_files);
    for (const auto& [name, bytes] : unpacked_) names_.push_back(name);
    return;
  }
  root_ = model.parent_path();
  names_ = {model.filename().string()};
}

void ModelFiles::list_folder(const fs::path& folder, const std::string& prefix,
                             std::set<std::pair<uint64_t, uint64_t>>& seen) {
  struct stat status {};
  // A link to a folder above would never end.
  if (stat(folder.c_str(), &status) == 0 && !seen.emplace(status.st_dev, status.st_ino).second) return;
  std::error_code error;
  std::vector<fs::directory_entry> entries;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    entries.push_back(*entry);
  if (error)
    throw bad_input(printable(folder.string(), 1000), "folder",
                    "cannot be listed (" + error.message() + "); check its rights");
  std::sort(entries.begin(), entries.end());  // which of two links to a folder comes first
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code broken;
    if (entry.is_directory(broken))
      list_folder(entry.path(), prefix + name + "/", seen);
    else if (entry.is_regular_file(broken))
      names_.push_back(prefix + name);
    else
      not_files_.push_back(prefix + name);
  }
}

std::string ModelFiles::shown(const std::string& name) const {
  return printable(form_ == Form::file ? given_.string() : (given_ / name).string(), 1000);
}

InputFile ModelFiles::read(const std::string& name) const {
  if (form_ != Form::archive)
    return read_input(form_ == Form::file && name == names_[0] ? given_ : root_ / name);
  const auto found = unpacked_.find(name);
  if (found == unpacked_.end()) throw bad_input(shown(name), "file", "is not in the archive");
  return input_of(given_ / name, found->second);
}

std::string ModelFiles::head(const std::string& name, size_t count) const {
  if (form_ != Form::archive) return file_head(root_ / name, count);
  const auto found = unpacked_.find(name);
  return found == unpacked_.end() ? "" : found->second.substr(0, count);
}

FindFile ModelFiles::find_from(const std::string& name) const {
  return [this, name](const std::string& relative) -> std::optional<InputFile> {
    const std::optional<std::string> target = resolve(name, relative);
    if (!target)
      throw bad_input(shown(name), "reference",
                      "'" + printable(relative) + "' leads out of the model; put the file beside it");
    if (form_ == Form::archive) {
      if (unpacked_.count(*target) == 0) return std::nullopt;
    } else {
      std::error_code error;
      if (!fs::exists(root_ / *target, error)) return std::nullopt;
    }
    return read(*target);
  };
}

std::optional<std::string> ModelFiles::resolve(const std::string& name, const std::string& relative) {
  const fs::path path(relative);
  if (relative.empty() || path.is_absolute() || relative.find('\0') != std::string::npos) return std::nullopt;
  const fs::path target = (fs::path(name).parent_path() / path).lexically_normal();
  if (target.empty() || *target.begin() == "..") return std::nullopt;
  return target.generic_string();
}

std::vector<std::pair<std::string, fs::path>> files_of(const fs::path& model) {
  std::error_code error;
  const bool folder = fs::is_directory(model, error);
  if (!folder && !fs::is_regular_file(model, error))
    throw bad_input(
        printable(model.string(), 1000), "file",
        "is neither a file nor a folder that can be opened; check scene.model in the configuration");
  std::vector<std::pair<std::string, fs::path>> files;
  const bool whole_folder = !folder && model.filename() == "tileset.json";
  if (folder || whole_folder) {
    const fs::path root = folder ? model : fs::absolute(model).parent_path();
    const ModelFiles listed(root);
    for (const std::string& name : listed.names()) files.emplace_back(name, root / name);
    return files;
  }
  files.emplace_back("", model);
  for (const std::string& name : siblings_of(model)) files.emplace_back(name, model.parent_path() / name);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace veduta
