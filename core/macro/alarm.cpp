#include "core/macro/alarm.hpp"

namespace ridgeline::macro {

std::string_view text(AlarmNumber number) noexcept {
  switch (number) {
    case AlarmNumber::TooManyDigits: return "too many digits";
    case AlarmNumber::AddressNotFound: return "address not found";
    case AlarmNumber::NoDataAfterAddress: return "no data after address";
    case AlarmNumber::IllegalMinus: return "illegal use of minus sign";
    case AlarmNumber::IllegalPoint: return "illegal use of decimal point";
    case AlarmNumber::IllegalAddress: return "illegal address";
    case AlarmNumber::ImproperGCode: return "improper G code";
    case AlarmNumber::NoFeedrate: return "feed zero";
    case AlarmNumber::ArcRadiusDifference: return "arc radius out of tolerance";
    case AlarmNumber::ArcAxisNotInPlane: return "illegal plane axis in an arc";
    case AlarmNumber::NoArcRadius: return "no R or I, J, K for an arc";
    case AlarmNumber::IllegalOffsetNumber: return "illegal offset number";
    case AlarmNumber::NoIntersection: return "no intersection in cutter compensation";
    case AlarmNumber::ArcAtStartOrCancel: return "arc at start or cancel of cutter compensation";
    case AlarmNumber::PlaneChangedInCompensation: return "plane change in cutter compensation";
    case AlarmNumber::Interference: return "interference in cutter compensation";
    case AlarmNumber::NoSolutionAtCorner: return "chamfer or corner R does not fit";
    case AlarmNumber::NoProgramNumber: return "no program number after P";
    case AlarmNumber::TooManyLevels: return "too many levels of subprograms";
    case AlarmNumber::NumberNotFound: return "program or sequence number not found";
    case AlarmNumber::NotAtReference: return "axis not at the reference position";
    case AlarmNumber::IntegerOverflow: return "overflow of an integer";
    case AlarmNumber::FloatOverflow: return "overflow of a number";
    case AlarmNumber::ZeroDivide: return "divided by zero";
    case AlarmNumber::ImproperCommand: return "improper command";
    case AlarmNumber::ExpressionFormat: return "illegal expression format";
    case AlarmNumber::VariableNumber: return "variable number out of range";
    case AlarmNumber::WriteProtected: return "write protected variable";
    case AlarmNumber::TooManyBrackets: return "too many brackets";
    case AlarmNumber::ArgumentRange: return "argument value out of range";
    case AlarmNumber::TooManyMacroLevels: return "too many levels of macro calls";
    case AlarmNumber::EndMissing: return "DO and END do not correspond";
    case AlarmNumber::MacroFormat: return "macro statement format error";
    case AlarmNumber::LoopNumber: return "illegal loop number";
    case AlarmNumber::NcAndMacroInBlock: return "NC word and macro statement in one block";
    case AlarmNumber::GotoTarget: return "illegal sequence number of GOTO";
    case AlarmNumber::GAsArgument: return "G used as an argument";
    case AlarmNumber::PlaneMismatch: return "rotation plane and arc or compensation plane differ";
    case AlarmNumber::StepLimit: return "step limit reached";
    case AlarmNumber::TimeLimit: return "time limit reached";
    case AlarmNumber::MemoryLimit: return "memory limit reached";
  }
  return "alarm";
}

void raise(AlarmNumber number, std::string_view detail, int column) {
  std::string message(text(number));
  if (!detail.empty()) message.append(": ").append(detail);
  throw AlarmRaised(static_cast<int>(number), std::move(message), column);
}

}  // namespace ridgeline::macro
