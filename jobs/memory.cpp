#include "jobs/memory.hpp"

#include <cstdlib>  // __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ridgeline::jobs {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kept = 32 << 20, largest = 32 << 20;  // bytes
  mallopt(M_TRIM_THRESHOLD, kept);
  mallopt(M_MMAP_THRESHOLD, largest);
#endif
}

}  // namespace ridgeline::jobs
