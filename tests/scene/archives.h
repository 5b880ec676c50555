// Archives that a test writes.
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace veduta {

struct ArchiveEntry {
  std::string path, content;
  std::string link = "";  ///< what it is a symbolic link to
};

/// Writes a tar, tar.gz, tar.xz, zip or 7z, as the name says.
inline void write_archive(const std::filesystem::path& path, const std::vector<ArchiveEntry>& entries,
                          const std::string& passphrase = "") {
  archive* const out = archive_write_new();
  ASSERT_EQ(archive_write_set_format_filter_by_ext(out, path.c_str()), ARCHIVE_OK)
      << archive_error_string(out);
  if (!passphrase.empty()) {
    ASSERT_EQ(archive_write_set_options(out, "zip:encryption=traditional"), ARCHIVE_OK);
    ASSERT_EQ(archive_write_set_passphrase(out, passphrase.c_str()), ARCHIVE_OK);
  }
  ASSERT_EQ(archive_write_open_filename(out, path.c_str()), ARCHIVE_OK) << archive_error_string(out);
  for (const ArchiveEntry& each : entries) {
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, each.path.c_str());
    archive_entry_set_filetype(entry, each.link.empty() ? AE_IFREG : AE_IFLNK);
    if (!each.link.empty()) archive_entry_set_symlink(entry, each.link.c_str());
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, static_cast<int64_t>(each.content.size()));
    ASSERT_EQ(archive_write_header(out, entry), ARCHIVE_OK) << archive_error_string(out);
    ASSERT_EQ(archive_write_data(out, each.content.data(), each.content.size()),
              static_cast<la_ssize_t>(each.content.size()));
    archive_entry_free(entry);
  }
  ASSERT_EQ(archive_write_close(out), ARCHIVE_OK);
  archive_write_free(out);
}

}  // namespace veduta
