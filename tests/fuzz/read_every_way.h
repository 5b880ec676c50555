// One file through every reader. What a hostile or damaged file may do to them is to be refused, in one line.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "pvs/pvs_file.h"

namespace veduta::test {

/// A reader broke its word: it refused in a way that is none, or two readers gave different answers.
class BrokenPromise : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the readers said: what they read, or why not.
struct Reading {
  std::optional<PvsFile> whole;     ///< by read_pvs
  std::optional<PvsFile> streamed;  ///< by PvsStream, piece by piece: no parts, vertices as they are used
  std::string whole_error, stream_error, library_error;
  bool stream_opened = false;  ///< its index was believed
};

/// Reads all of it. Where read_pvs reads a file, PvsStream and the library do and give the same; the converse
/// need not hold, since a stream compares no digests of rows and geometry. \throw BrokenPromise; what else
/// comes out (std::bad_alloc, say) no reader may throw.
Reading read_every_way(const std::filesystem::path& file);

/// What differs between two files, triangles taken corner by corner; empty: nothing. Parts of objects are
/// compared where both have them, and `bake_us`, workers and what is written of them as the rest.
std::string difference(const PvsFile& a, const PvsFile& b);

}  // namespace veduta::test
