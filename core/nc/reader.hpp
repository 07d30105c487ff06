#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/nc/program.hpp"

/// Reads a program from elsewhere into the motion that it commands.
///
/// G code (FANUC, LinuxCNC and, of Siemens, what its writer prints):
///   motion      G0 G1 G2 G3 with X Y Z and I J K or R (Siemens CR=), full circles, helices;
///               G17 G18 G19, G90 G91, G90.1 G91.1, G20 G21 (G70 G71 G700 G710), F, modal words
///   frames      G54 to G59, G54.1 P, G59.1 to G59.3, G505 to G599, G500; G68.2 with G53.1 and G69,
///               CYCLE800 in mode 57, ROT and TRANS alone. After the cut rapids may go on in
///               another frame
///   length      G43 G44 G43.1 G43.4 G49 H, Siemens D
///   machine     G28 G30 G53, Siemens G74 G75 G153 SUPA: the axis is then somewhere unknown; A B C
///               in these blocks and after the cut
///   harmless    G4 (with P, X or U) G5 (FANUC, with P) G5.1 (with Q) G8 (with P) G9 G15 G40 G50
///               G50.1 G53.1 G61 G61.1 G64 (with P, Q) G67 G80 G94 G97 G98 G99, of Siemens G60 G601
///               G602 G603 G641 G642; M0 M1 M3 to M11 M13 M14 M19 M25 M26 M48 to M51 M60; S, T, N,
///               D, H, comments ( ) and ;
///   end         M2 M30 M99 M17 RET, the second %
/// Klartext: BEGIN PGM, END PGM, BLK FORM, TOOL CALL, TOOL DEF, CYCL DEF 247 and 32, L, CC, C, CR,
/// CP with IPA, PLANE VECTOR, PLANE RESET, M91, M92, M140, M128, M129, STOP and the M codes above.
///
/// X5 is 5 mm, as X5. is. Anything else is an error that names the line and the word: a control
/// would do something with it that this reader would miss.
namespace ridgeline::nc {

struct ReadOptions {
  std::optional<Dialect> dialect;        ///< absent: told from the text
  std::optional<Eigen::Vector3d> start;  ///< where the tool is before the first block, if known
};

struct Reading {
  /// Moves are Rapid or Cut. The motion starts where all three coordinates are first known: what
  /// positions the tool before that is not part of it. Moves without a way are left out.
  path::Motion motion;
  std::vector<int> lines;  ///< of each move, from 1
  Dialect dialect = Dialect::Fanuc;
  std::string work_offset;           ///< as written, "G54"; of Klartext the datum number; or empty
  std::optional<int> tool_number;    ///< T
  std::optional<int> length_offset;  ///< H
  std::optional<double> spindle_speed;  ///< [rev/min]
  std::optional<bool> spindle_clockwise;
  /// Z of the tilted plane; absent: none was set, the tool axis is the machine's.
  std::optional<Eigen::Vector3d> tool_axis;
  /// First rapid after the cut in another plane, offset, tool or tool length than the cut: the way
  /// out from there is not part of the motion, so that nobody has measured it.
  std::optional<int> unmeasured_line;
};

/// Throws Error{BadFile} for what is not understood, Error{Unsupported} for what is, but not
/// offered (cutting in two work offsets, planes or tools, cycles, radius compensation). Both with
/// `field` "line 12" and `value` the word.
Reading read(std::string_view program, const ReadOptions& options = {},
             const Progress& progress = {});

/// Klartext and Siemens by their heads, LinuxCNC by its o-words; else FANUC.
Dialect dialect_of(std::string_view program, const Progress& progress = {});

}  // namespace ridgeline::nc
