// Built by clang alone: libFuzzer's side.
#include "tests/fuzz/mutate.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return veduta::test::mutate_file(data, size, max_size, seed, LLVMFuzzerMutate);
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
/// HDF5 1.10 leaks when it refuses a file.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif
#endif
