set(SOURCES contour.cpp curve.cpp divide.cpp edit.cpp features.cpp figure.cpp names.cpp offset.cpp order.cpp overlay.cpp
    passes.cpp plan.cpp region.cpp rework.cpp skin.cpp sweep.cpp tools.cpp volumes.cpp zones.cpp)
set(HEADERS contour.hpp curve.hpp divide.hpp edit.hpp features.hpp figure.hpp names.hpp offset.hpp order.hpp overlay.hpp
    passes.hpp plan.hpp product.hpp program.hpp region.hpp rework.hpp skin.hpp tolerance.hpp tools.hpp volumes.hpp zones.hpp)
