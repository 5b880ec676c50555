#include <fmt/format.h>

#include <glm/vec3.hpp>

#include "pvs/library/call.h"
#include "pvs/library/open_city.h"
#include "pvs/unite_rows.h"

namespace veduta::pvs {
namespace {

Point point(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

Box box(const veduta::Box& b) {
  return {point(b.lower), point(b.upper)};
}

bool touch(const Box& a, const Box& b) {
  for (size_t i = 0; i < 3; ++i)
    if (!(a.lower[i] <= b.upper[i] && b.lower[i] <= a.upper[i])) return false;
  return true;
}

// The numbers of ours and of the header are those of the file.
static_assert(static_cast<int>(Kind::building) == static_cast<int>(veduta::Kind::building) &&
              static_cast<int>(Kind::other) == static_cast<int>(veduta::Kind::other));
static_assert(static_cast<int>(CellStatus::all_visible) == static_cast<int>(veduta::CellStatus::all_visible));

Object object_of(const PvsIndex& index, size_t number) {
  const veduta::Object& object = index.objects[number];
  const SliceCounts& slices = index.slices[number];
  return {object.name,
          static_cast<Kind>(object.kind),
          box(index.bounds[number]),
          object.triangle_end - object.triangle_begin,
          {slices.x, slices.y, slices.z}};
}

void copy_row(const PvsRow& row, Row& out) {
  out.resize(row.size());
  for (size_t i = 0; i < row.size(); ++i)
    out[i] = {row[i].object, row[i].index.x, row[i].index.y, row[i].index.z};
}

PvsRow from_row(const Row& row) {
  PvsRow out;
  out.reserve(row.size());
  for (const Entry& entry : row) out.push_back({entry.object, {entry.x, entry.y, entry.z}});
  return out;
}

void check_number(uint64_t number, uint64_t count, const char* what) {
  if (number >= count) throw Error(fmt::format("no {} {}: there are {}", what, number, count));
}

}  // namespace

City::Open::Open(const std::filesystem::path& file, uint64_t memory_bytes) : stream(file, memory_bytes) {
  const PvsIndex& index = stream.index();
  objects.reserve(index.objects.size());
  for (size_t i = 0; i < index.objects.size(); ++i) objects.push_back(object_of(index, i));
}

City::City(const std::filesystem::path& file, uint64_t memory_bytes) {
  call([&] { open_ = std::make_unique<Open>(file, memory_bytes); });
}
City::~City() = default;
City::City(City&&) noexcept = default;
City& City::operator=(City&&) noexcept = default;

const std::string& City::crs() const {
  return open_->stream.index().crs;
}

const std::array<double, 3>& City::origin() const {
  return open_->stream.index().origin;
}

const std::string& City::content_digest() const {
  return open_->stream.index().content_digest;
}

bool City::conservative() const {
  return open_->stream.index().header.conservative;
}

uint32_t City::object_count() const {
  return static_cast<uint32_t>(open_->objects.size());
}

const Object& City::object(uint32_t number) const {
  check_number(number, open_->objects.size(), "object");
  return open_->objects[number];
}

std::vector<uint32_t> City::objects_in(const Box& box) const {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < open_->objects.size(); ++i)
    if (open_->objects[i].triangles > 0 && touch(open_->objects[i].bounds, box)) found.push_back(i);
  return found;
}

uint32_t City::cell_count() const {
  return static_cast<uint32_t>(open_->stream.index().cells.size());
}

Box City::cell(uint32_t number) const {
  check_number(number, cell_count(), "cell");
  return box(open_->stream.index().cells[number]);
}

CellStatus City::cell_status(uint32_t number) const {
  check_number(number, cell_count(), "cell");
  return static_cast<CellStatus>(open_->stream.index().cell_status[number]);
}

std::optional<uint32_t> City::find_cell(const Point& point) const {
  const int64_t cell = open_->stream.index().find_cell({point[0], point[1], point[2]});
  if (cell < 0) return std::nullopt;
  return static_cast<uint32_t>(cell);
}

void City::read_row(uint32_t cell, Row& out) const {
  check_number(cell, cell_count(), "cell");
  const uint32_t row = open_->stream.index().cell_row[cell];
  const auto read = [&] { open_->stream.read_row(row, open_->row); };
  if (open_->stream.keeps_row(row))
    call_without_hdf5(read);
  else
    call(read);
  copy_row(open_->row, out);
}

void unite(const Row& left, const Row& right, Row& out) {
  PvsRow united;
  unite_rows(from_row(left), from_row(right), united);
  copy_row(united, out);
}

}  // namespace veduta::pvs
