#pragma once

#include <string>

#include "core/nc/program.hpp"

namespace ridgeline::nc {

inline constexpr double cl_arc_tolerance = 0.001;  ///< [mm]

/// APT cutter location data (ISO 4343): PARTNO, UNITS/MM, LOADTL, SPINDL, COOLNT, RAPID,
/// FEDRAT/f,MMPM, GOTO/x,y,z and FINI. Work frame, whatever the dialect; with a tool axis other
/// than +Z, MULTAX/ON and GOTO/x,y,z,i,j,k. Arcs are cut into chords, so that every post-processor
/// reads the same path: `arc_tolerance` is their chord error [mm]. The points are then rounded to
/// the program's decimals.
std::string write_cl(Program program, double arc_tolerance = cl_arc_tolerance,
                     const Progress& progress = {});

/// One line for the start and one for each move, under the heads index, kind, x, y, z (work frame,
/// mm), feed (mm/min; 0 for a rapid), and of arcs plane, sense, centre_x, centre_y, centre_z. The
/// plane is of the work frame; an arc of a tilted plane is cut into chords of 0.001 mm. Numbers
/// read back the same.
std::string write_csv(const path::Motion& motion, const Progress& progress = {});

}  // namespace ridgeline::nc
