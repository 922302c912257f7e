// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/catalogue.hpp"

#include <fmt/format.h>

#include "cases/support/case.hpp"
#include "formulations/rate_operator.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"
#include "harness/measure/order.hpp"
#include "harness/measure/surface.hpp"
#include "harness/study/study.hpp"
#include "reports/json/results_json.hpp"

namespace sphverify {

namespace {

/// Of every layout but equal masses.
char const* const masses_parameter = "masses [layout]: or voronoi, density times the volume of the particle's Voronoi cell";

Json field_names(FieldSet fields) {
  Json names = Json::array();
  for (FieldInfo const& field : field_infos) {
    if (fields.contains(field.field)) names.push_back(fmt::format("{} [{}]", field.name, field.unit));
  }
  return names;
}

Json boundary_names(BoundaryValueSet values) {
  Json names = Json::array();
  for (auto const& [value, name] :
       {std::pair{BoundaryValue::pressure, "pressure"}, std::pair{BoundaryValue::velocity, "velocity"},
        std::pair{BoundaryValue::temperature, "temperature"},
        std::pair{BoundaryValue::conductivity, "conductivity"}, std::pair{BoundaryValue::flux, "flux"}}) {
    if (values.contains(value)) names.push_back(name);
  }
  return names;
}

char const* rate_name(Rate rate) {
  switch (rate) {
    case Rate::acceleration:
      return "dv/dt [m/s^2]";
    case Rate::internal_work:
      return "de/dt of compression [W/kg]";
    case Rate::total_work:
      return "d(e + v^2/2)/dt of pressure forces [W/kg]";
    case Rate::conduction_heating:
      return "de/dt of heat conduction [W/kg]";
    case Rate::density:
      return "drho/dt [kg/(m^Dim s)]";
  }
  return "";
}

Json describe_scheme(SchemeInfo const& s) {
  Json conserves = Json::array();
  if (s.conserves.contains(Invariant::momentum))
    conserves.push_back("momentum, to round-off between particles");
  if (s.conserves.contains(Invariant::energy)) conserves.push_back("energy, to round-off between particles");
  Json passes = Json::array();
  if (s.least_squares) passes.push_back("quadratic-weights");
  for (PassInfo const& pass : s.first_passes) passes.push_back(pass.name);
  passes.push_back("rate");
  return {{"equation", s.equation},
          {"source", s.source},
          {"computes", rate_name(s.rate)},
          {"reads", field_names(fields_read(s))},
          {"fields", field_names(needed_fields(s))},
          {"wall_values", boundary_names(wall_values_read(s))},
          {"passes", passes},
          {"conserves", conserves},
          {"parameters", Json::array({"walls [on]: on; off, the control without wall terms; or what stands behind them in their place (sphverify list walls)"})},
          {"work_partner", s.work_partner.empty() ? Json(nullptr) : Json(s.work_partner)},
          {"remarks", std::string(s.remarks) + (s.wall_terms_are_exchange ? "" : " What crosses a wall cannot be read from its wall terms: budgets are given only where walls prescribe a flux, fluxes at walls not at all.")}};
}

Json describe_case(CaseInfo const& c) {
  Parameters const defaults(c.parameters);
  Json parameters = Json::array();
  for (ParameterSpec const& p : c.parameters) {
    Json const value = parameters_json({{p.name, p.default_value}}).front();
    parameters.push_back(
        fmt::format("{} [{}]{}: {}", p.name, value.dump(), p.unit.empty() ? "" : " in " + p.unit, p.meaning));
  }
  return {{"equation", c.equation}, {"source", c.source},       {"domain", c.domain},  {"walls", c.walls},
          {"initial", c.initial},   {"parameters", parameters}, {"remarks", c.remarks}};
}

void add_words(std::vector<CatalogueEntry>& all) {
  for (KernelInfo const& kernel : all_kernel_infos()) {
    all.push_back({"kernels", std::string(kernel.id), std::string(kernel.title), std::string(kernel.source), [kernel] {
                     return Json{{"equation", kernel.equation},
                                 {"source", kernel.source},
                                 {"support", fmt::format("{:g} h", kernel.support_ratio)},
                                 {"parameters", Json::array({"smoothing_ratio [1.2]: h/dx, with this h"})}};
                   }});
  }
  for (WallTreatmentPart const& treatment : all_wall_treatments()) {
    WallTreatmentInfo const* const info = treatment.info;
    all.push_back({"walls", std::string(info->id), std::string(info->title), std::string(info->source), [info] {
                     return Json{{"equation", info->equation}, {"source", info->source}, {"remarks", info->remarks}, {"parameters", Json::array()}};
                   }});
  }
  all.push_back(
      {"viscosities", "monaghan", "Artificial viscosity with two coefficients",
       "Monaghan & Gingold 1983; Monaghan 1992, Eqs. 4.1-4.3", [] {
         return Json{
             {"equation",
              "Pi_ij = (-alpha c mu + beta mu^2)/rho where a pair approaches, mu = h v_ij.r_ij/(r_ij^2 + 0.01 h^2), means of both"},
             {"source", "Monaghan & Gingold 1983; Monaghan 1992, Eqs. 4.1-4.3"},
             {"parameters",
              Json::array({"viscosity: {\"alpha\": a, \"beta\": b}; auto [what is taken] is 1 and 2 where the case has shocks, else 0"})}};
       }});
  all.push_back(
      {"viscosities", "riemann", "Pressure of a Riemann problem between two particles that approach",
       "Toro 2009, Section 4.3.1; Inutsuka 2002; Parshikov & Medin 2002", [] {
         return Json{
             {"equation",
              "Pi_ij = 2 q/rho^2, q = rho w (b w + sqrt(b^2 w^2 + c^2)), w = -v_ij.r_ij/(2 r_ij) where a pair approaches, "
              "b = (gamma + 1)/4, means of both"},
             {"source", "Toro 2009, Section 4.3.1; Inutsuka 2002; Parshikov & Medin 2002"},
             {"parameters", Json::array({"viscosity: riemann; no coefficient"})}};
       }});
  all.push_back({"layouts", "lattice", "Particles at the centres of equal cells", "", [] {
                   return Json{
                       {"equation",
                        "mass = density at the centre times cell volume; of a cell that a jump of the "
                        "initial state cuts mass, momentum and energy are its integrals over the cell"},
                       {"parameters", Json::array({masses_parameter})}};
                 }});
  all.push_back({"layouts", "jittered", "Lattice with every coordinate displaced at random", "", [] {
                   return Json{
                       {"equation",
                        "displacement uniform in +-amplitude dx per axis; mass = density times "
                        "Voronoi volume in 1D, cell volume otherwise; cells that a jump cuts as of lattice"},
                       {"parameters", Json::array({"amplitude, in dx, below 0.5", masses_parameter,
                                                   "seed, or a list of seeds: replicates of each level"})}};
                 }});
  all.push_back(
      {"layouts", "clumped", "Lattice with neighbours moved together in pairs", "", [] {
         return Json{{"equation", "along the first axis, about the middle of each pair; mass as of jittered"},
                     {"parameters", Json::array({"separation [0.1]: of a pair, in dx, up to 1", masses_parameter})}};
       }});
  all.push_back(
      {"layouts", "touching", "Lattice whose first particles all but touch the lower wall", "", [] {
         return Json{{"equation", "the first particle of each row along the first axis; mass as of jittered"},
                     {"parameters", Json::array({"gap [1e-12]: from the wall, in dx, up to 0.5", masses_parameter})}};
       }});
  all.push_back(
      {"layouts", "equal-mass", "Particles of equal mass, in one dimension", "", [] {
         return Json{
             {"equation",
              "positions where the mass from the lower end is (i + 1/2)/N of the whole; in regions of "
              "different density use it with smoothing: adaptive"},
             {"parameters", Json::array()}};
       }});
  all.push_back({"layouts", "hexagonal", "Triangular lattice, in two dimensions", "", [] {
                   return Json{
                       {"equation",
                        "rows along the first axis, every second one shifted by half a spacing, stretched "
                        "to fit the box; dx is the square root of a particle's area"},
                       {"parameters", Json::array({masses_parameter})}};
                 }});
  all.push_back({"layouts", "close-packed", "Face-centred cubic lattice, in three dimensions", "", [] {
                   return Json{
                       {"equation",
                        "four particles to a cubic cell, stretched to fit the box; dx is the cube root of a "
                        "particle's volume"},
                       {"parameters", Json::array({masses_parameter})}};
                 }});
  all.push_back(
      {"layouts", "glass", "Particles relaxed by mutual repulsion, in two and three dimensions", "", [] {
         return Json{
             {"equation", "from a random start until the particles hold each other in place; equal volumes"},
             {"parameters", Json::array({"seed, or a list of seeds: replicates of each level", masses_parameter})}};
       }});
  all.push_back(
      {"layouts", "random", "Particles at random places, independent of each other", "", [] {
         return Json{
             {"equation", "every coordinate uniform in the box; mass = density times Voronoi volume in 1D, equal volumes otherwise"},
             {"parameters", Json::array({"seed, or a list of seeds: replicates of each level", masses_parameter})}};
       }});
  for (MeasureWord const& word : measure_words()) {
    all.push_back({"measures", std::string(word.word), std::string(word.title), "", [] {
                     return Json{{"parameters", Json::array()}};
                   }});
  }
  all.push_back(
      {"measures", "order", "observed order of convergence with its 95% interval, and the verdict", "", [] {
         return Json{{"rules", verdict_rules}, {"parameters", Json::array()}};
       }});
  all.push_back({"measures", "skill", "error over that of doing nothing, a measure of gates", "", [] {
                   return Json{
                       {"rules",
                        "norm of the error over that of the initial state taken for the answer "
                        "(`initial` of errors.FIELD.REGION); 1 is worth nothing, above 1 is worse than "
                        "nothing"},
                       {"parameters", Json::array({"field", "region", "norm", "resolution [finest]"})}};
                 }});
  all.push_back(
      {"measures", "time_error", "share of the error that time integration made, a measure of gates", "", [] {
         return Json{
             {"rules",
              "the change of the final state when the tolerance is tightened a hundredfold, or the step "
              "halved, over the error; the largest over fields, regions and norms "
              "(`integration.time_error_share`); null where nothing was compared, as the run's "
              "`integration.remark` says"},
             {"parameters", Json::array({"resolution [all]"})}};
       }});
  all.push_back(
      {"measures", "surface", "which h/dx at which N: errors over both, of studies that vary both", "", [] {
         return Json{{"rules", surface_rules}, {"parameters", Json::array()}};
       }});
}

}  // namespace

std::vector<CatalogueEntry> const& catalogue() {
  static std::vector<CatalogueEntry> const entries = [] {
    std::vector<CatalogueEntry> all;
    for (SchemeInfo const* s : all_scheme_infos()) {
      all.push_back({"formulations", std::string(s->id), std::string(s->title), std::string(s->source),
                     [s] { return describe_scheme(*s); }});
    }
    for (Case const& c : all_cases()) {
      all.push_back(
          {"cases", c.info.id, c.info.title, c.info.source, [&c] { return describe_case(c.info); }});
    }
    add_words(all);
    return all;
  }();
  return entries;
}

std::vector<std::string> catalogue_kinds() {
  return {"formulations", "cases", "kernels", "walls", "viscosities", "layouts", "measures"};
}

}  // namespace sphverify
