#pragma once

#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace ridgeline::macro {

/// Numbers of the control's program alarms (30i: PS0xxx). User alarms are 3000 + n. From 9001 on:
/// limits of this interpreter, which no control has.
enum class AlarmNumber : int {
  TooManyDigits = 3,
  AddressNotFound = 4,
  NoDataAfterAddress = 5,
  IllegalMinus = 6,
  IllegalPoint = 7,
  IllegalAddress = 9,
  ImproperGCode = 10,
  NoFeedrate = 11,
  ArcRadiusDifference = 20,
  ArcAxisNotInPlane = 21,
  NoArcRadius = 22,
  IllegalOffsetNumber = 30,
  NoIntersection = 33,
  ArcAtStartOrCancel = 34,
  PlaneChangedInCompensation = 37,
  Interference = 41,
  NoSolutionAtCorner = 55,
  NoProgramNumber = 76,
  TooManyLevels = 77,
  NumberNotFound = 78,
  NotAtReference = 92,
  IntegerOverflow = 110,
  FloatOverflow = 111,
  ZeroDivide = 112,
  ImproperCommand = 113,
  ExpressionFormat = 114,
  VariableNumber = 115,
  WriteProtected = 116,
  TooManyBrackets = 118,
  ArgumentRange = 119,
  TooManyMacroLevels = 122,
  EndMissing = 124,
  MacroFormat = 125,
  LoopNumber = 126,
  NcAndMacroInBlock = 127,
  GotoTarget = 128,
  GAsArgument = 129,
  PlaneMismatch = 144,
  StepLimit = 9001,
  TimeLimit = 9002,
  MemoryLimit = 9003,
};

/// The control's text of an alarm, e.g. "divided by zero".
std::string_view text(AlarmNumber number) noexcept;

/// Why a program stopped, and where.
struct Alarm {
  int number = 0;
  std::string message;
  int program = 0;  ///< O number; 0: the text has none
  int line = 0;     ///< of the program's text, from 1
  int column = 0;   ///< from 1; 0: the whole block
};

/// How an alarm travels inside the interpreter, from the expression that raises it to run(), which
/// returns it as a value. Place is filled in by the loop that runs the blocks.
class AlarmRaised : public Error {
public:
  AlarmRaised(int number, std::string message, int column)
      : Error(ErrorCode::Alarm, message), alarm{number, std::move(message), 0, 0, column} {}
  Alarm alarm;
};

/// Throws the alarm with the control's text and, after a colon, what is wrong here.
[[noreturn]] void raise(AlarmNumber number, std::string_view detail = {}, int column = 0);

}  // namespace ridgeline::macro
