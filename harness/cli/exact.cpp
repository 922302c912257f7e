// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "cases/support/case.hpp"
#include "harness/cli/case_parameters.hpp"
#include "harness/cli/commands.hpp"
#include "harness/codes/read_snapshot.hpp"
#include "harness/study/parameter_complaint.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

struct ExactCommand {
  std::string case_id;
  std::vector<std::string> parameters;
  double time = 0.0;
  std::string points, file;
};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double read_coordinate(std::string_view text) {
  double value = 0.0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UserError("exact", "--points", "'" + std::string(text) + "'", "numbers X1,X2,... or X:Y:Z,...");
  }
  return value;
}

/// The places of particles in a file.
template <int Dim>
std::vector<Vector<Dim>> points_in(std::string const& file) {
  Snapshot const snapshot = read_snapshot({file}, {});
  std::vector<Vector<Dim>> points(snapshot.size());
  for (int k = 0; k < Dim; ++k) {
    auto const column = snapshot.columns.find(position_columns[static_cast<std::size_t>(k)]);
    if (column == snapshot.columns.end())
      throw UserError(file, position_columns[static_cast<std::size_t>(k)], "nothing", fmt::format("points in {} dimensions", Dim));
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i][k] = column->second[i];
      if (!std::isfinite(points[i][k]))
        throw UserError(file, column->first, fmt::format("{} of point {}", points[i][k], i), "a number");
    }
  }
  return points;
}

template <int Dim>
std::vector<Vector<Dim>> read_points(ExactCommand const& command) {
  if (!command.file.empty()) return points_in<Dim>(command.file);
  std::string const& text = command.points;
  std::vector<Vector<Dim>> points;
  for (std::size_t start = 0; start <= text.size();) {
    std::size_t const end = std::min(text.find(',', start), text.size());
    std::string_view const point = std::string_view(text).substr(start, end - start);
    std::vector<double> coordinates;
    for (std::size_t from = 0; from <= point.size();) {
      std::size_t const to = std::min(point.find(':', from), point.size());
      coordinates.push_back(read_coordinate(point.substr(from, to - from)));
      from = to + 1;
    }
    if (coordinates.size() != Dim) {
      throw UserError("exact", "--points", "'" + std::string(point) + "'",
                      fmt::format("{} coordinates per point, with colons between them", Dim));
    }
    points.push_back(Eigen::Map<Vector<Dim> const>(coordinates.data()));
    start = end + 1;
  }
  return points;
}

template <int Dim>
Json exact_in_dimension(Problem<Dim> const& problem, double time, ExactCommand const& command) {
  auto const points = read_points<Dim>(command);
  bool const may_leave_the_domain = problem.gamma > 0.0;  // a gas moves, and takes its walls along
  for (Vector<Dim> const& x : points) {
    bool const turned = problem.domain.is_turned();
    Vector<Dim> const along = problem.domain.to_box(x);
    // Turning a point to the box's axes and back costs digits.
    double const slack = turned ? 1e-12 * problem.domain.extent().maxCoeff() : 0.0;
    for (int k = 0; k < Dim && !may_leave_the_domain; ++k) {
      if (along[k] < problem.domain.lower[k] - slack || along[k] > problem.domain.upper[k] + slack) {
        throw UserError("exact", "--points",
                        fmt::format("a coordinate {:g}{}", along[k], turned ? " along the turned axes" : ""),
                        fmt::format("one in the domain, from {:g} to {:g}", problem.domain.lower[k],
                                    problem.domain.upper[k]));
      }
    }
  }
  Json fields = Json::object();
  for (auto const& [field, f] : problem.scalars) {
    Json values = Json::array();
    for (auto const& x : points) values.push_back(number(f(x, time)));
    fields[std::string(info(field).name)] = values;
  }
  auto const put_vectors = [&](std::string const& name, VectorFunction<Dim> const& f) {
    Json values = Json::array();
    for (auto const& x : points) {
      Json components = Json::array();
      for (double const c : Vector<Dim>(f(x, time))) components.push_back(number(c));
      values.push_back(components);
    }
    fields[name] = values;
  };
  for (auto const& [field, f] : problem.vectors) put_vectors(std::string(info(field).name), f);
  if (problem.acceleration) put_vectors("acceleration", problem.acceleration);
  if (auto const heating = problem.heating.find(Rate::conduction_heating); heating != problem.heating.end()) {
    Json values = Json::array();
    for (auto const& x : points) values.push_back(number(heating->second(x, time)));
    fields["heating"] = values;
  }
  Json json = {{"fields", fields}};
  for (auto const& [name, value] : problem.landmarks) {
    // A name in two parts, such as star.pressure, makes an object.
    std::size_t const dot = name.find('.');
    Json& place = dot == std::string::npos ? json[name] : json[name.substr(0, dot)][name.substr(dot + 1)];
    place = number(value(time));
  }
  json["accuracy"] = problem.accuracy;
  return json;
}

void exact(ExactCommand const& command) {
  if (command.points.empty() && command.file.empty()) throw UserError("exact", "--points", "nothing", "points, or --points-file");
  Case const* const found = &case_named("exact", command.case_id);
  Parameters const given = read_assignments("exact", found->info, command.parameters);
  if (!(command.time >= 0.0) || !std::isfinite(command.time)) {
    throw UserError("exact", "--time", fmt::format("{:g}", command.time), "a time of 0 or later");
  }
  Json document = {{"schema", "sphverify-exact/1"},
                   {"case", found->info.id},
                   {"parameters", nullptr},
                   {"time", command.time}};
  std::string const place = "exact: " + found->info.id;
  try {
    Parameters used = in_use(*found, until(*found, given, command.time));
    AnyProblem const problem = found->problem(used);
    // At the start the scene may end whenever it likes.
    if (command.time == 0.0 && given.all().contains("final_time"))
      used.set("final_time", given.all().at("final_time"));
    document["parameters"] = parameters_json(used.all());
    document.update(std::visit(
        [&](auto const& p) { return exact_in_dimension(p, command.time, command); }, problem));
  } catch (BadValue const& error) {
    bool const is_time = parameter_of(error, found->info) == "final_time" && !given.is_given("final_time");
    if (is_time) throw UserError(place, "--time", fmt::format("{:g}", command.time), error.expected);
    Json const values = assigned_values(command.parameters);
    throw parameter_complaint(error, found->info, place, "--parameter ", &values);
  } catch (std::invalid_argument const& error) {
    throw UserError(place, "--parameter", error.what(), "values for which the case has a solution");
  }
  write_document("-", document_text(document));
}

}  // namespace

void add_exact(CLI::App& app) {
  auto command = std::make_shared<ExactCommand>();
  CLI::App* sub = app.add_subcommand("exact", "The reference solution of a case, as JSON");
  sub->add_option("CASE", command->case_id, "A case from `sphverify list cases`")->required();
  sub->add_option("-p,--parameter", command->parameters,
                  "VALUE is JSON or a bare word")
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  sub->add_option("-t,--time", command->time, "When")->required()->type_name("TIME");
  CLI::Option* const points = sub->add_option("--points", command->points, "Where: X1,X2,...; in more dimensions X:Y:Z,...")->type_name("POINTS");
  CLI::Option* const file =
      sub->add_option("--points-file", command->file, "Particles whose places are the points: CSV with columns x, y, z, or HDF5")
          ->type_name("FILE");
  points->excludes(file);
  sub->footer(
      "A parameter that is given and has no effect is refused, final_time among them: the case need only "
      "make sense until the time asked for.\n"
      "Example: sphverify exact conduction/marshak --parameter exponent=3 --time 0.5 --points 0,0.2,0.4");
  sub->callback([command] { exact(*command); });
}

}  // namespace sphverify
