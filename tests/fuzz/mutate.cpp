#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "pvs/hdf5_input.h"
#include "scene/error.h"
#include "tests/fuzz/hdf5_blocks.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/pieces.h"

namespace veduta::test {

namespace {

void mutate_block(std::string& bytes, const Block& block, BytesMutator mutate) {
  auto* data = reinterpret_cast<uint8_t*>(bytes.data()) + block.at;
  mutate(data, block.length - 4, block.length - 4);
}

/// \return false: there is none.
bool mutate_metadata(std::string& bytes, std::mt19937& random, BytesMutator mutate) {
  const std::vector<Block> blocks = metadata_blocks(bytes);
  if (blocks.empty()) return false;
  const Block block = blocks[random() % blocks.size()];
  mutate_block(bytes, block, mutate);
  mend_metadata(bytes, {block});
  return true;
}

/// \throw Error for a file that our readers refuse before they ask for a chunk.
bool mutate_chunk(std::string& bytes, std::mt19937& random, BytesMutator mutate) {
  const MemoryFile file(bytes);
  const hdf5::Input input(file.path());
  std::vector<Block> chunks = stored_chunks(file.path());
  std::erase_if(chunks, [&](const Block& chunk) {
    return chunk.length <= 4 || chunk.at > bytes.size() || chunk.length > bytes.size() - chunk.at;
  });
  if (chunks.empty()) return false;
  const Block chunk = chunks[random() % chunks.size()];
  mutate_block(bytes, chunk, mutate);
  mend_chunk(bytes, chunk);
  return true;
}

/// \throw Error for a file whose digests do not hold.
void mutate_values(std::string& bytes, std::mt19937& random) {
  const MemoryFile file(bytes);
  Pieces pieces = take_apart(file.path());
  for (unsigned changes = 1 + random() % 3; changes-- > 0;) change(pieces, random);
  const MemoryFile changed{std::string()};
  put_together(changed.path(), pieces);
  std::ifstream in(changed.path(), std::ios::binary);
  bytes.assign(std::istreambuf_iterator<char>(in), {});
}

}  // namespace

size_t mutate_file(uint8_t* bytes, size_t count, size_t most, unsigned seed, BytesMutator mutate) {
  std::mt19937 random(seed);
  std::string file(reinterpret_cast<const char*>(bytes), count);
  bool done = false;
  try {
    switch (random() % 4) {
      case 0:
        break;
      case 1:
        done = mutate_metadata(file, random, mutate);
        break;
      case 2:
        done = mutate_chunk(file, random, mutate);
        break;
      default:
        mutate_values(file, random);
        done = true;
    }
  } catch (const Error&) {  // it is damaged already
    done = false;
  }
  if (!done || file.size() > most) return mutate(bytes, count, most);
  std::copy(file.begin(), file.end(), bytes);
  return file.size();
}

}  // namespace veduta::test
