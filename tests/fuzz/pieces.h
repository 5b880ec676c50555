// A file taken apart into raw values, to be changed and put together again with every checksum and digest as
// it should be: the way past them, to the checks of the values themselves.
#pragma once

#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "pvs/pvs_layout.h"

namespace veduta::test {

struct Piece {
  const Column* column = nullptr;
  uint64_t rows = 0, columns = 1;
  size_t element_bytes = 1;
  std::string bytes;  ///< [rows * columns * element_bytes]

  size_t row_bytes() const { return columns * element_bytes; }
};

struct Pieces {
  RootAttributes root;
  City frame;                 ///< the lattices of its navigation alone
  std::vector<Piece> pieces;  ///< every dataset but those of a verification
  std::optional<Verification> verification;
};

/// \throw Error for a file whose checksums and digests do not hold.
Pieces take_apart(const std::filesystem::path& file);

/// Writes them, right or wrong, with digests that hold.
void put_together(const std::filesystem::path& file, const Pieces& pieces);

/// Changes one thing: a value, the length of a dataset, an attribute, a number of the verification.
/// \return what, for messages.
std::string change(Pieces& pieces, std::mt19937& random);

}  // namespace veduta::test
