#pragma once

#include <cstdint>

namespace ridgeline::soak {

/// A client that asks one request after the other until it has `count` answers or is killed. Tells
/// each on standard output: "begin N" before it, "end N CODE" after, where CODE is "ok", the
/// error's code, or "foreign" when the answer is not that of the request.
int ask(unsigned domain, std::uint64_t seed, int count, double timeout);

}  // namespace ridgeline::soak
