// What is on the GPU of a city: pages go up as they come off the disk, and down when they are not wanted.
#pragma once

#include <cstdint>

#include "viewer/draw/command_list.h"
#include "viewer/draw/painter.h"
#include "viewer/stream/city_stream.h"

namespace veduta {

class CityPages {
 public:
  /// On the current GL context. The stream has to outlive it.
  CityPages(CityStream& stream, int samples, bool allow_one_pass = true);

  /// Says what is wanted, and puts up of what came about `most_bytes`. Never waits for the disk.
  void look(const Gaze& gaze, uint64_t most_bytes);
  /// The same, but waits for all that a picture from there needs.
  void fetch(const Gaze& gaze);

  CityStream& stream() { return stream_; }
  Painter& painter() { return painter_; }
  const CommandLister& lister() const { return lister_; }

 private:
  /// \return was there anything?
  bool take_changes(uint64_t most_bytes);

  CityStream& stream_;
  Painter painter_;
  CommandLister lister_;
};

}  // namespace veduta
