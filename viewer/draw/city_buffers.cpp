#include "viewer/draw/city_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "scene/error.h"

namespace veduta {
namespace {

// The buffer is counted in vertices; three of them are as large as one triangle's fifteen elements.
constexpr uint64_t unit_bytes = sizeof(MeshVertex);
constexpr uint64_t elements_per_unit = unit_bytes / sizeof(uint32_t);
static_assert(unit_bytes % sizeof(uint32_t) == 0 && 3 * order_count % elements_per_unit == 0);
// Commands hold places of elements as 32 bits.
constexpr uint64_t most_units = (uint64_t{1} << 32) / elements_per_unit - 1;

const void* offset(size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

}  // namespace

CityBuffers::CityBuffers(uint64_t bytes) {
  allocate(std::clamp<uint64_t>(bytes / unit_bytes, 1, most_units));
}

void CityBuffers::allocate(uint64_t units) {
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(units * unit_bytes), nullptr, GL_STATIC_DRAW);
  if (glGetError() != GL_NO_ERROR)
    throw Error(ExitStatus::usage, fmt::format("the GPU has no room for {} MB of the city; give it a smaller "
                                               "budget, or use --gpu software",
                                               (units * unit_bytes >> 20) + 1));
  units_ = FreeList(units);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_.id());
  glVertexAttribPointer(position_m, 3, GL_FLOAT, GL_FALSE, unit_bytes,
                        offset(offsetof(MeshVertex, position_m)));
  glVertexAttribIPointer(material_tint, 2, GL_UNSIGNED_BYTE, unit_bytes,
                         offset(offsetof(MeshVertex, material)));
  glVertexAttribPointer(height_cm, 1, GL_UNSIGNED_SHORT, GL_FALSE, unit_bytes,
                        offset(offsetof(MeshVertex, height_cm)));
  glVertexAttribIPointer(object, 1, GL_UNSIGNED_INT, unit_bytes, offset(offsetof(MeshVertex, object)));
  for (GLuint location : {position_m, material_tint, height_cm, object}) glEnableVertexAttribArray(location);
  glBindVertexArray(0);
}

std::optional<PagePlace> CityBuffers::add(const Page& page) {
  remove(page.number);
  const uint64_t vertices = page.vertices.size();
  const uint64_t units = vertices + page.elements.size() / elements_per_unit;
  if (units == 0) return PagePlace{};
  if (units > units_.capacity() && first_unit_.empty() && units <= most_units) allocate(units);
  const std::optional<uint64_t> first = units_.take(units);
  if (!first) return std::nullopt;
  first_unit_.emplace(page.number, *first);

  // By way of a buffer that nobody draws from: frames that are not done yet may draw from the other, and
  // writing to it would wait for them. The copy takes its turn behind them.
  const auto vertex_bytes = static_cast<GLsizeiptr>(vertices * unit_bytes);
  const auto element_bytes = static_cast<GLsizeiptr>(page.elements.size() * sizeof(uint32_t));
  glBindBuffer(GL_COPY_READ_BUFFER, staging_.id());
  glBufferData(GL_COPY_READ_BUFFER, vertex_bytes + element_bytes, nullptr, GL_STREAM_DRAW);
  glBufferSubData(GL_COPY_READ_BUFFER, 0, vertex_bytes, page.vertices.data());
  glBufferSubData(GL_COPY_READ_BUFFER, vertex_bytes, element_bytes, page.elements.data());
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer_.id());
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0,
                      static_cast<GLintptr>(*first * unit_bytes), vertex_bytes + element_bytes);
  return PagePlace{static_cast<uint32_t>((*first + vertices) * elements_per_unit),
                   static_cast<uint32_t>(page.elements.size() / order_count), static_cast<int32_t>(*first)};
}

void CityBuffers::remove(uint32_t page) {
  const auto found = first_unit_.find(page);
  if (found == first_unit_.end()) return;
  units_.give(found->second);
  first_unit_.erase(found);
}

void CityBuffers::load(const CommandList& list, uint32_t instances) {
  loaded_ = list.commands;
  for (IndirectCommand& command : loaded_) command.instances = instances;
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  glBufferData(GL_DRAW_INDIRECT_BUFFER, static_cast<GLsizeiptr>(loaded_.size() * sizeof(IndirectCommand)),
               loaded_.data(), GL_STREAM_DRAW);
}

void CityBuffers::draw() const {
  if (loaded_.empty()) return;
  glBindVertexArray(array_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(loaded_.size()),
                              sizeof(IndirectCommand));
}

}  // namespace veduta
