// The readers of city.pvs.h5 over any bytes. What comes out of here other than by returning is a finding.
#include <span>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/read_every_way.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const veduta::test::MemoryFile file(std::span(data, size));
  veduta::test::read_every_way(file.path());
  return 0;
}
