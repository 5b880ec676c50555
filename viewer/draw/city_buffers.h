// The pages of a city in one buffer of the GPU, and drawing lists of commands from it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "gl/handle.h"
#include "viewer/draw/command_list.h"
#include "viewer/draw/free_list.h"
#include "viewer/stream/page.h"

namespace veduta {

/// A page is one run of the buffer: its vertices, then its elements. So one budget holds both, whatever their
/// ratio is, and pages that go leave one hole each.
class CityBuffers {
 public:
  /// Attributes of the vertices, by the locations of the shaders.
  enum Location : GLuint { position_m = 0, material_tint = 1, height_cm = 2, object = 3 };

  /// \throw Error(usage) when the driver has no room for so much.
  explicit CityBuffers(uint64_t bytes);

  /// Puts a page up, in place of what it had here. A page larger than all of the buffer makes it grow, if
  /// nothing else is in it. \return where; nothing when there is no hole that it fits in.
  std::optional<PagePlace> add(const Page& page);
  /// No matter whether it is here.
  void remove(uint32_t page);

  /// Takes over a list, each command for this many instances. What was loaded before may still be drawn from.
  void load(const CommandList& list, uint32_t instances);
  /// Draws what was loaded with the program in use.
  void draw() const;

 private:
  void allocate(uint64_t units);

  FreeList units_{0};
  std::map<uint32_t, uint64_t> first_unit_;  ///< of the pages that are here
  GlBuffer buffer_, staging_, commands_;
  GlVertexArray array_;
  std::vector<IndirectCommand> loaded_;
};

}  // namespace veduta
