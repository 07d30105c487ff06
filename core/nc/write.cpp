#include <cmath>

#include "core/nc/text.hpp"
#include "core/nc/writers.hpp"

namespace ridgeline::nc {

std::vector<std::string> head_comments(const Program& program) {
  std::vector<std::string> comments = program.comments;
  if (program.tool_axis.z() < 1 - 1e-15) {
    std::string axis = "tool axis";
    for (const double x : program.tool_axis) {
      axis += ' ' + decimal(std::llround(x * 1e6), 6, NumberStyle::Plain);
    }
    comments.push_back(axis);
    if (is_tilted(program) && program.tilted == TiltedOutput::WorkFrame) {
      comments.emplace_back("coordinates of the work frame:");
      comments.emplace_back("set the rotary axes to the tool axis before this program");
    }
  }
  return comment_lines(comments, program.dialect);
}

std::string write(const Program& program, const Progress& progress) {
  const Plan steps = plan(program, progress.part(0, 0.5));
  const Progress rest = progress.part(0.5, 1);
  return program.dialect == Dialect::Heidenhain ? write_klartext(program, steps, rest)
                                                : write_g_code(program, steps, rest);
}

path::Motion rounded(const Program& program, const Progress& progress) {
  const Plan steps = plan(program, progress.part(0, 0.7));
  const Progress rest = progress.part(0.7, 1);
  const auto in_work = [&](const Grid& at, int decimals) {
    const auto scale = static_cast<double>(power_of_ten(decimals));
    const Eigen::Vector3d point(static_cast<double>(at[0]) / scale,
                                static_cast<double>(at[1]) / scale,
                                static_cast<double>(at[2]) / scale);
    return Eigen::Vector3d(steps.axes * point);
  };
  path::Motion motion{in_work(steps.start, program.decimals), {}};
  motion.moves.reserve(steps.steps.size());
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    rest.step(i, steps.steps.size(), "rounding");
    const Step& step = steps.steps[i];
    path::Move move{step.kind, steps.axes * step.end, static_cast<double>(step.feed) / 1000 / 60,
                    std::nullopt};
    if (step.arc) {
      move.arc = path::Arc{in_work(step.arc->centre, centre_decimals(program)), step.arc->plane,
                           step.arc->sense, steps.axes};
    }
    motion.moves.push_back(move);
  }
  return motion;
}

}  // namespace ridgeline::nc
