// The city as it comes off the disk: a thread reads rows and pages ahead of the eye; a frame never waits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stream/city_source.h"
#include "viewer/stream/gaze.h"
#include "viewer/stream/page.h"

namespace veduta {

/// Pages that came and pages that have to go. What is to go is to be freed before what came is put up.
struct PageChanges {
  std::vector<std::unique_ptr<Page>> came;
  std::vector<uint32_t> gone;
};

/// All calls from one thread. They hold a lock for microseconds and never wait for the disk, but wait().
class CityStream {
 public:
  /// Opens the file and starts to read. `memory_bytes`: of pages and rows; the rows of the eyes and a page
  /// are kept, however large. From now on the reading thread is the one that uses HDF5. \throw Error as
  /// PvsStream.
  CityStream(const std::filesystem::path& file, uint64_t memory_bytes);
  /// The same of any source.
  CityStream(std::unique_ptr<const CitySource> source, uint64_t memory_bytes);
  /// Waits for what is being read at that moment.
  ~CityStream();

  const PvsIndex& index() const;
  const std::vector<PageSpan>& pages() const;
  uint64_t memory_bytes() const;

  /// Once a frame, before row() and changes(): says what is wanted.
  /// \throw what the reading thread met (a damaged page, a disk error): then nothing more is read, and every
  ///   later call throws the same.
  void look(const Gaze& gaze);

  /// The row of a cell if it is here; stays until the next look() or wait().
  const PvsRow* row(uint32_t cell) const;

  /// Of what came, about `most_bytes` of gpu_bytes() (one page at least), so that putting it up does not make
  /// a hitch; and all that has to go. Who frees what is gone before he puts up what came has at most
  /// `memory_bytes` of pages.
  PageChanges changes(uint64_t most_bytes);

  /// A page that came and could not be put up (fragmented buffers): what is wanted less goes, and it comes
  /// again; where nothing is wanted less, once others went.
  void refuse(uint32_t page);

  /// Waits until all that the last look() needs for its picture, as far as the budget allows, is here or in
  /// changes(). What is only read ahead is not waited for. For pictures without a window, and tests.
  /// \throw as look().
  void wait();

  /// Does the file fit into the budget whole? Then all of it is read in the end, and nothing goes.
  bool fits() const;
  struct Status {
    uint32_t pages_here = 0;     ///< on the GPU or in changes()
    uint32_t pages_wanted = 0;   ///< for the picture; not: to be ahead
    uint32_t pages_missing = 0;  ///< of these, not here
    uint64_t bytes_here = 0;     ///< of pages and rows
  };
  Status status() const;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace veduta
