#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::macro {

/// Which registers an offset number has (design section 2.2).
enum class OffsetMemory {
  A,  ///< one value
  B,  ///< geometry and wear, H and D share
  C   ///< geometry and wear of H and of D
};

/// Codes that call a program, as parameters of the control set them: code to O number.
struct CodeCalls {
  std::map<int, int> g_macros;        ///< 6050..6059: O9010.., 6038, 6041; G codes in tenths
  std::map<int, int> g_modal_macros;  ///< the same with a minus: as G66
  std::map<int, int> m_macros;        ///< 6080..6089: O9020.., 6047
  std::map<int, int> m_subprograms;   ///< 6071..6079: O9001.., 6044
  bool t_subprogram = false;          ///< 6001#5 TCS: T calls O9000 with #149

  bool is_empty() const {
    return g_macros.empty() && g_modal_macros.empty() && m_macros.empty() &&
           m_subprograms.empty() && !t_subprogram;
  }
};

/// What differs between controls, and what a control's parameters choose. mm, mm/min.
struct Profile {
  std::string name = "30i";
  bool calculator_point = false;  ///< 3401#0 DPI: X10 is 10 mm instead of 10 increments
  bool half_turn_angles = false;  ///< 6004#0 NAT: ATAN -180..180 and ASIN -90..90
  int literal_digits = 12;        ///< digits of a number literal without leading zeros
  int mantissa_bits = 0;          ///< of every computed value; 0: IEEE double
  int subprogram_levels = 10;     ///< M98 nesting
  int macro_levels = 5;           ///< G65/G66 nesting
  int brackets = 5;               ///< nesting of [ ] in an expression
  bool condition_logic = true;    ///< 6006#0 MLG: [c1]AND[c2] in conditions
  bool power_functions = true;    ///< POW and ADP exist
  OffsetMemory offset_memory = OffsetMemory::C;
  int last_low_common = 199;       ///< commons #100 up to here
  int last_high_common = 999;      ///< commons #500 up to here
  double increment = 0.001;        ///< least input increment [mm], [deg] of rotary axes
  double inch_increment = 0.0001;  ///< the same in G20 [inch]
  double arc_tolerance = 0.03;     ///< 3410: start and end radius of an arc may differ [mm]
  bool interference_check = true;  ///< alarm 041 when a compensated block runs backwards
  int blind_blocks = 2;            ///< blocks without plane motion that blind the compensation
  double rapid = 20000;            ///< rapid traverse, for #3001 only [mm/min]
  std::array<Eigen::Vector3d, 4> references = {
      Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
      Eigen::Vector3d::Zero()};  ///< G28, G30 P2..P4 [mm, machine]
  /// Parameters that a caller gives, by number; those of axes hold a value for each.
  std::map<int, std::vector<double>> parameters;
  CodeCalls calls;
};

/// "16i", "18i", "0i" or "30i" (also "31i", "32i"); nullopt for another name.
std::optional<Profile> profile(std::string_view name);

}  // namespace ridgeline::macro
