#include "core/macro/hole_edge.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "core/macro/interpreter.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector3d;

nlohmann::json oracle() {
  std::ifstream file(std::string(RIDGELINE_TESTS) + "/oracle/cycles/31_hole_edge_inner.json");
  return nlohmann::json::parse(file);
}

double number(const nlohmann::json& value) {
  return std::stod(value.get<std::string>());
}

HoleEdge oracle_edge() {
  const nlohmann::json params = oracle().at("params");
  HoleEdge edge;
  edge.R1 = number(params.at("R1"));
  edge.R2 = number(params.at("R2"));
  edge.f = number(params.at("f"));
  edge.width = number(params.at("width"));
  edge.ball_radius = number(params.at("ball_radius"));
  edge.points = params.at("N").get<int>();
  return edge;
}

TEST(HoleEdge, CentresOfOracle31) {
  int checked = 0;
  const nlohmann::json points = oracle().at("points");
  for (const nlohmann::json& point : points) {
    const double phi = number(point.at("phi_deg"));
    SCOPED_TRACE(phi);
    const Vector3d C = hole_edge_centre(oracle_edge(), phi);
    for (std::size_t i = 0; i < 3; ++i, ++checked) {
      EXPECT_NEAR(C[static_cast<int>(i)], number(point.at("centre").at(i)), 1e-9);
    }
  }
  EXPECT_EQ(checked, 75);
}

/// The cutting points of a run of the program, as ball centres in the work frame.
std::vector<Vector3d> centres_of(const HoleEdge& edge, const HoleEdgeProgram& options) {
  std::string text = hole_edge_program(edge, options);
  Options run_options;
  run_options.set[13000 + edge.offset_number] = edge.ball_radius - 0.25;
  run_options.set[12000 + edge.offset_number] = 0.25;  // geometry and wear together
  std::string main = text;
  if (options.kind == HoleEdgeProgram::Kind::Macro) {
    const std::size_t call = text.find("(CALL: ");
    main = "O1\nG90 G17\n" + text.substr(call + 7, text.find(')', call) - call - 7) + "\nM30\n";
    run_options.library = [&](int) { return std::optional(text); };
  }
  const Result result = run(main, run_options);
  EXPECT_FALSE(result.alarm) << result.alarm->number << " " << result.alarm->message << " line "
                             << result.alarm->line << "\n"
                             << text;
  std::vector<Vector3d> centres;
  for (const Move& move : result.motion) {
    if (move.kind == MoveKind::Line && move.feed == edge.feed) {
      centres.push_back(move.to + Vector3d(0, 0, edge.ball_radius));
    }
  }
  return centres;
}

// The macro iterates to 1e-5 mm, which leaves far less than the increment of 0.001 mm that every
// coordinate is rounded to: half of it in each axis.
constexpr double stated_tolerance = 0.0005 * 1.7320508 + 1e-6;

TEST(HoleEdge, ProgramsRunToTheCentresOfTheSectionMethod) {
  int checked = 0;
  for (const bool is_outer : {false, true}) {
    for (const bool is_exit : {false, true}) {
      for (const double f : {0.0, 3.0, -5.0}) {
        HoleEdge edge = oracle_edge();
        edge.f = f;
        edge.is_outer = is_outer;
        edge.is_exit = is_exit;
        edge.position = {12, -7, 3};
        edge.rotation = 35;
        edge.start_angle = 20;
        edge.is_clockwise = f > 0;
        for (const auto kind : {HoleEdgeProgram::Kind::Macro, HoleEdgeProgram::Kind::Main}) {
          HoleEdgeProgram options;
          options.kind = kind;
          const std::vector<Vector3d> centres = centres_of(edge, options);
          ASSERT_EQ(centres.size(), static_cast<std::size_t>(edge.points) + 1);
          for (int i = 0; i <= edge.points; ++i, ++checked) {
            const double way = 360.0 * i / edge.points;
            const Vector3d C =
                hole_edge_centre(edge, edge.start_angle + (edge.is_clockwise ? -way : way));
            const double c = std::cos(edge.rotation * M_PI / 180);
            const double s = std::sin(edge.rotation * M_PI / 180);
            const Vector3d placed =
                edge.position + Vector3d(C.x() * c - C.y() * s, C.x() * s + C.y() * c, C.z());
            EXPECT_NEAR((centres[static_cast<std::size_t>(i)] - placed).norm(), 0, stated_tolerance)
                << i;
          }
        }
      }
    }
  }
  EXPECT_EQ(checked, 24 * 25);
}

TEST(HoleEdge, AConstantSectionAngleIsKept) {
  HoleEdge edge = oracle_edge();
  edge.section_angle = 45;
  const std::vector<Vector3d> centres = centres_of(edge, {});
  for (int i = 0; i < edge.points; ++i) {
    EXPECT_NEAR((centres[static_cast<std::size_t>(i)] - hole_edge_centre(edge, 15.0 * i)).norm(), 0,
                stated_tolerance);
  }
}

// The ends of the chamfer lie on their surfaces, W apart: residuals of the defining equations, for
// random edges.
TEST(HoleEdge, BallTouchesBothSurfacesAtTheWidth) {
  unsigned state = 1;
  const auto random = [&state](double low, double high) {
    state = state * 1664525U + 1013904223U;
    return low + (high - low) * (state >> 8) / 16777216.0;
  };
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    HoleEdge edge;
    edge.R1 = random(10, 40);
    edge.R2 = edge.R1 * random(0.1, 0.7);
    edge.f = (edge.R1 - edge.R2) * random(-0.8, 0.8);
    edge.ball_radius = edge.R2 * random(0.3, 0.9);
    edge.width = edge.ball_radius * random(0.02, 0.2);
    edge.is_outer = i % 2 == 0;
    SCOPED_TRACE(i);
    const double phi = random(0, 360);
    Vector3d C;
    try {
      C = hole_edge_centre(edge, phi);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::WidthTooLarge);
      continue;
    }
    // Points of VP on both surfaces at distance D of the centre: found by marching along the two
    // section curves from the ridge point.
    const double p = phi * M_PI / 180, c = std::cos(p), s = std::sin(p);
    const Vector3d e1(c, s, 0);
    const double A = edge.R2 * c + edge.f, Zp = std::sqrt(edge.R1 * edge.R1 - A * A);
    const Vector3d P(edge.R2 * c, edge.R2 * s, Zp);
    const double den = std::sqrt(edge.R1 * edge.R1 - A * A * c * c);
    const Vector3d e2(A * s * s / den, -A * s * c / den, Zp / den);
    const auto on_wall = [&](double t) {  // S of the wall's section at height t
      double S = 0;
      for (int k = 0; k < 60; ++k) {
        const Vector3d q = P + S * e1 + t * e2;
        S -= std::hypot(q.x(), q.y()) - edge.R2;
      }
      return Vector3d(P + S * e1 + t * e2);
    };
    const auto on_body = [&](double S) {
      double t = 0;
      for (int k = 0; k < 200; ++k) {
        const Vector3d q = P + S * e1 + t * e2;
        t -= (std::hypot(q.x() + edge.f, q.z()) - edge.R1) * 0.9;
      }
      return Vector3d(P + S * e1 + t * e2);
    };
    const double sign = edge.is_outer ? -1 : 1;
    const auto solve = [&](const auto& point, double high) {
      double low = 0;
      for (int k = 0; k < 100; ++k) {
        const double middle = (low + high) / 2;
        ((point(middle) - C).norm() < edge.ball_radius ? low : high) = middle;
      }
      return Vector3d(point(low));
    };
    const Vector3d G2 = solve([&](double x) { return on_wall(sign * x); }, 3 * edge.width);
    const Vector3d G1 = solve(on_body, 3 * edge.width);
    EXPECT_NEAR((G1 - G2).norm(), edge.width, 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 250);
}

TEST(HoleEdge, PointsKeepTheToleranceAndAreNotWasted) {
  for (const double tolerance : {0.02, 0.005, 0.001}) {
    HoleEdge edge = oracle_edge();
    edge.points = hole_edge_points(edge, tolerance);
    double most = 0;
    for (int i = 0; i < edge.points; ++i) {
      const double step = 360.0 / edge.points;
      const Vector3d a = hole_edge_centre(edge, i * step);
      const Vector3d b = hole_edge_centre(edge, (i + 1) * step);
      const Vector3d d = (b - a).normalized();
      for (double part = 0.1; part < 1; part += 0.1) {
        const Vector3d p = hole_edge_centre(edge, (i + part) * step) - a;
        most = std::max(most, (p - p.dot(d) * d).norm());
      }
    }
    EXPECT_LE(most, tolerance);
    EXPECT_GE(most, 0.9 * tolerance);
  }
}

TEST(HoleEdge, ProgramAlarmsOutOfRange) {
  const std::string text = hole_edge_program(oracle_edge());
  const auto alarm = [&](const std::string& arguments, double radius) {
    Options options;
    options.set[13001] = radius;
    options.library = [&](int) { return std::optional(text); };
    const Result result = run("G65 P9100 " + arguments + "\nM30\n", options);
    return result.alarm ? result.alarm->number : 0;
  };
  const std::string good = "A20. B8. C3. W0.5 D1. H8. F300. V30. ";
  EXPECT_EQ(alarm(good, 2), 0);
  EXPECT_EQ(alarm(good + "C13.", 2), 3010);
  EXPECT_EQ(alarm(good, 0), 3011);
  EXPECT_EQ(alarm(good + "W5.", 2), 3012);
  EXPECT_EQ(alarm(good, 9), 3013);
  EXPECT_EQ(alarm(good + "H2.", 2), 3014);
  EXPECT_EQ(alarm("A20. B8. C3. W0.5 D1. H8. V30. ", 2), 3015);
}

TEST(HoleEdge, RefusesWhatCannotBe) {
  const auto field = [](const HoleEdge& edge) {
    try {
      hole_edge_program(edge);
    } catch (const Error& error) {
      return error.details().field;
    }
    return std::string("no error");
  };
  HoleEdge edge = oracle_edge();
  edge.f = 12;
  EXPECT_EQ(field(edge), "R2");
  edge = oracle_edge();
  edge.width = 4;
  EXPECT_EQ(field(edge), "width");
  edge = oracle_edge();
  edge.ball_radius = 8;
  EXPECT_EQ(field(edge), "ball_radius");
}

}  // namespace
}  // namespace ridgeline::macro
