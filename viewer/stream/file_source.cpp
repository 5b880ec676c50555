#include "viewer/stream/city_source.h"

namespace veduta {
namespace {

class FileSource : public CitySource {
 public:
  explicit FileSource(const std::filesystem::path& file) : stream_(file) { stream_.read_navigation(); }
  const PvsIndex& index() const override { return stream_.index(); }
  PvsRow read_row(uint32_t row) const override { return stream_.read_row(row); }
  City read_objects(uint32_t first, uint32_t last) const override {
    return stream_.read_objects(first, last);
  }

 private:
  PvsStream stream_;
};

}  // namespace

std::unique_ptr<const CitySource> open_source(const std::filesystem::path& file) {
  return std::make_unique<FileSource>(file);
}

}  // namespace veduta
