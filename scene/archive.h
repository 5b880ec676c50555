// Archives of model files: zip, tar, 7z and whatever else libarchive knows.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace veduta {

/// Whether a file that starts with `head` (300 bytes, or all of it) is an archive or compressed. `extension`
/// in lower case settles a tar of the old kind, which has no signature.
bool is_archive(std::string_view head, const std::string& extension);

struct Unpacked {
  std::map<std::string, std::string> files;  ///< by path, "/" between folders; hidden files are left out
  std::vector<std::string> not_files;        ///< links, devices, pipes
};

/// Unpacks into memory. A file that is compressed and no archive (city.gml.gz) gives one file of its stem. Of
/// two entries of one name the later one counts, as with tar.
/// \throw Error(bad_input) for an archive that is damaged, cut short or encrypted, for an entry whose path is
/// absolute or holds "..", and for more than 16 GB, or more than 16 MB and 100 times the archive's size: a
/// small file could fill the memory.
Unpacked unpack_archive(const std::filesystem::path& path);

}  // namespace veduta
