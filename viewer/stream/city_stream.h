// The city as it comes off the disk: a thread reads rows and pages ahead of the eye; a frame never waits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "pvs/pvs_stream.h"
#include "viewer/stream/page.h"

namespace veduta {

/// Where the eye is and is going, and what the next frames draw.
struct Gaze {
  glm::vec3 position_m{0};    ///< midpoint of the eyes (of the frozen pose, where there is one)
  glm::vec3 velocity_m_s{0};  ///< rows and pages ahead are fetched first
  float eyes_apart_m = 0;     ///< rows of the eyes' own cells are wanted as well
  bool everything = false;    ///< not only what the rows list: all pages are wanted, the nearest first
};

/// Pages that came and pages that have to go. What is to go is to be freed before what came is put up.
struct PageChanges {
  std::vector<std::unique_ptr<Page>> came;
  std::vector<uint32_t> gone;
};

class CityStream {
 public:
  /// Opens the file and starts to read. `memory_bytes`: of pages on the GPU and rows; at least a page is
  /// kept, however large. \throw Error as PvsStream.
  CityStream(const std::filesystem::path& file, uint64_t memory_bytes);
  ~CityStream();

  const PvsIndex& index() const;
  const std::vector<PageSpan>& pages() const;
  uint64_t memory_bytes() const;

  /// Once a frame, before row() and changes(): says what is wanted. Never waits for the disk.
  /// \throw what the reading thread met (a damaged page, a disk error).
  void look(const Gaze& gaze);

  /// The row of a cell if it is here; stays until the next look().
  const PvsRow* row(uint32_t cell) const;

  /// Of what came, about `most_bytes` (one page at least), so that putting it up does not make a hitch.
  PageChanges changes(uint64_t most_bytes);

  /// A page that came and could not be put up (fragmented buffers): it will come again when others went.
  void refuse(uint32_t page);

  /// Waits until all that the last look() wants, as far as the budget allows, is here or in changes().
  /// For pictures without a window, and tests.
  void wait();

  /// Does the file fit into the budget whole?
  bool fits() const;
  struct Status {
    uint32_t pages_here = 0, pages_wanted = 0;
    uint64_t bytes_here = 0;
  };
  Status status() const;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace veduta
