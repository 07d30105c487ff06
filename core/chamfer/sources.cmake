set(SOURCES)
set(HEADERS job.hpp section.hpp)
