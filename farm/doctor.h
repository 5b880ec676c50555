// What a host has for a bake, and whether the hosts of a job fit together.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace veduta {

struct Finding {
  std::string name, value;
  bool good = true;
};

struct HostFindings {
  std::string host;
  std::vector<Finding> findings;
};

/// Versions, cores, memory, renderers, and the file system of `directory`: its kind, room, and how fast it
/// takes what a bake writes. Nothing that is missing throws: it is a finding that is not good.
std::vector<Finding> examine_host(const std::filesystem::path& directory);

/// Lines that name versions which differ from those of the first host: such programs do not understand each
/// other, or do not give the same result. Empty when there is none. \param hosts  by rank
std::string differences(const std::map<int, HostFindings>& hosts);

/// A file that one host makes and keeps locked, for the others to look for. Removed with the object.
class DoctorMark {
 public:
  /// \throw Error(input_output) when the directory cannot be written to.
  explicit DoctorMark(const std::filesystem::path& directory);
  ~DoctorMark();
  DoctorMark(const DoctorMark&) = delete;
  DoctorMark& operator=(const DoctorMark&) = delete;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Is that host's mark seen here, and its lock felt?
Finding look_for_mark(const std::filesystem::path& file);

}  // namespace veduta
