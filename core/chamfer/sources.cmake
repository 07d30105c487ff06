set(SOURCES)
set(HEADERS job.hpp loop.hpp section.hpp)
