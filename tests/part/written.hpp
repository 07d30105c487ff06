#pragma once

#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "part/step.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::part {

/// The STEP file that Open CASCADE writes of some shapes.
inline std::string step_of(const std::vector<TopoDS_Shape>& shapes, const char* unit = "MM") {
  prepare();
  Interface_Static::SetCVal("write.step.unit", unit);
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  STEPControl_Writer writer;
  writer.Transfer(shapes.size() == 1 ? shapes.front() : TopoDS_Shape(compound), STEPControl_AsIs);
  Interface_Static::SetCVal("write.step.unit", "MM");
  const TemporaryFolder folder;
  writer.Write(folder.file("part.step").c_str());
  std::ifstream in(folder / "part.step", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace ridgeline::part
