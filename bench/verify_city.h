// A city of blocks to verify, made in memory.
#pragma once

#include "pvs/pvs_file.h"

namespace veduta::bench {

/// `blocks` x `blocks` houses of 12 triangles, 12 m wide and 4 to 30 m high, along streets of 8 m on plain
/// ground; at crossings all over it cells of 4 m at eye height. Rows list all but every tenth house.
PvsFile block_city(uint32_t blocks, uint32_t cells);

}  // namespace veduta::bench
