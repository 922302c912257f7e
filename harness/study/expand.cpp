// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/study/expand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formulations/rate_operator.hpp"
#include "formulations/wall_particles/wall_treatment.hpp"
#include "harness/codes/external_code.hpp"
#include "harness/study/memory.hpp"
#include "harness/study/wall_facts.hpp"

namespace sphverify {

namespace {

/// Why a momentum form has no energy equation; empty if it has one.
std::string without_work(FormulationChoice const& formulation) {
  if (!formulation.work.empty()) return "";
  std::string const partner(find_scheme(formulation.id)->work_partner);
  if (partner.empty()) return "it names no energy equation of its own: a study must say its `work`";
  return find_scheme(partner) ? "" : "its energy equation, " + partner + ", is not among the formulations";
}

/// Why a formulation cannot run on a case; empty if it can.
std::string mismatch(CaseInfo const& scene_case, FormulationChoice const& formulation) {
  if (is_external(formulation.id)) {
    return scene_case.kind == CaseKind::rates ? "an operator case has no time for a code to run: `evaluate` compares rates" : "";
  }
  Rate const rate = find_scheme(formulation.id)->rate;
  bool const is_momentum = rate == Rate::acceleration;
  switch (scene_case.kind) {
    case CaseKind::rates:
      return formulation.work.empty() && formulation.conduction.empty()
                 ? ""
                 : "an operator case evaluates one form alone, without partners";
    case CaseKind::conduction:
      if (is_momentum) return "a momentum form has no rate on a conduction case";
      return rate == Rate::conduction_heating ? "" : "a work form has no rate on a conduction case";
    case CaseKind::hydro:
      if (!is_momentum) return "a moving gas needs a momentum form, with this one as its partner";
      return formulation.conduction.empty() ? without_work(formulation)
                                            : "a gas that conducts no heat takes no conduction form";
    case CaseKind::coupled:
      if (!is_momentum) return "a moving gas needs a momentum form, with this one as its partner";
      return formulation.conduction.empty() ? "a gas that conducts heat needs a conduction form"
                                            : without_work(formulation);
  }
  return "";
}

/// What a form reads that the particles of a case do not have; empty if there is nothing.
std::string lacks(CaseInfo const& info, AnyProblem const& problem, std::string const& formulation) {
  SchemeInfo const* const scheme = find_scheme(formulation);
  if (!scheme) return "";
  constexpr FieldSet always{Field::position, Field::mass, Field::density};
  constexpr FieldSet of_gas{Field::velocity,    Field::pressure,    Field::internal_energy,
                            Field::sound_speed, Field::temperature, Field::omega};
  return std::visit(
      [&](auto const& p) -> std::string {
        for (FieldInfo const& field : field_infos) {
          if (!fields_read(*scheme).contains(field.field) || always.contains(field.field) ||
              scheme->first_passes.writes().contains(field.field))
            continue;
          if (field.field == Field::omega && !moves(info.kind))
            return formulation + " has grad-h terms: particles at rest have one h for all";
          bool const is_known = field.field == Field::conductivity ? static_cast<bool>(p.conductivity)
                                : moves(info.kind)                 ? of_gas.contains(field.field)
                                                   : p.scalars.contains(field.field) || p.vectors.contains(field.field);
          if (!is_known) return formulation + " reads the " + std::string(field.name) + ", which the case does not have";
        }
        return "";
      },
      problem);
}

/// Of Voronoi pair weights, which a study combines with the first of its kernels and h/dx alone.
constexpr char const* no_smoothing_length = ": Voronoi pair weights have no smoothing length: the first of a study stands for all";

/// Why a form cannot take pair weights that are not the kernel's; empty if it can.
std::string without_pair_weight(std::string const& id) {
  SchemeInfo const* const scheme = find_scheme(id);
  if (!scheme) return "";
  if (id.starts_with("plugin/")) return id + " computes its own weights of pairs, from the kernel";
  std::string_view const reason = why_no_pair_weights(*scheme);
  return reason.empty() ? "" : fmt::format("pair weight voronoi: {} {}", id, reason);
}

/// Why a form that pushes through faces of cells cannot run so; empty if it can, or is none.
std::string without_faces(std::string const& id, Discretisation const& d, bool moving) {
  SchemeInfo const* const scheme = find_scheme(id);
  if (!scheme || !reads_face_offsets(*scheme)) return "";
  if (d.pair_weight == "kernel") return fmt::format("{} {}", id, why_no_kernel_weights(*scheme));
  return moving && d.density != "voronoi" ? fmt::format("{} works on the volumes of cells: take density voronoi, not {}", id, d.density) : "";
}

/// Why a form with terms in grad h cannot take a discretisation; empty if it can, or has none.
std::string without_grad_h(FormulationChoice const& formulation, Discretisation const& d) {
  for (std::string const& id : {formulation.id, formulation.work, formulation.conduction}) {
    SchemeInfo const* const scheme = find_scheme(id);
    if (!scheme || !fields_read(*scheme).contains(Field::omega)) continue;
    if (d.smoothing != "adaptive")
      return id + " is for adaptive smoothing: with one h for all it is the form without grad-h terms";
    if (d.density != "summation" && d.density != "normalised")
      return fmt::format("{} knows how a density answers to its h where it is summed: instead of {} take summation or normalised",
                         id, d.density);
  }
  return "";
}

bool brings_weights(std::string const& id) {
  SchemeInfo const* const scheme = find_scheme(id);
  return scheme && scheme->least_squares;
}

/// Why nothing can stand behind the walls; empty if it can, or nothing should.
std::string without_wall_particles(AnyProblem const& problem, FormulationChoice const& formulation, Discretisation const& d) {
  if (!formulation.walls || formulation.walls.are_terms()) return "";
  std::string const what = "walls " + formulation.walls.word;
  if (!has_walls(problem)) return what + " change nothing where there are no walls";
  if (d.pair_weight == "voronoi") return "Voronoi cells end at walls: nothing that stands behind them is seen";
  bool const sums = find_wall_treatment(formulation.walls.word)->info->masses_of_sources;
  if (d.density == "normalised") {
    std::string const instead = sums ? "summation, which counts what is behind" : "given, continuity or voronoi";
    return "normalised density divides by the kernel's part inside: with " + what + " take " + instead;
  }
  if (d.density == "summation" && !sums)
    return what + " take their masses from the density, which cannot be a sum over them: take given, continuity or voronoi";
  if (d.smoothing == "adaptive")
    return "adaptive smoothing sees images by two smoothing lengths, walls by one: with " + what + " take uniform";
  if (d.wall_motion == "mass") return what + " have no wall that stands by the mass of its nearest particle";
  for (std::string const& id : {formulation.id, formulation.work, formulation.conduction}) {
    if (id.starts_with("plugin/")) return id + " has wall terms of its own, and sees nothing behind walls";
    SchemeInfo const* const scheme = find_scheme(id);
    bool const sums_pressure = scheme && std::any_of(scheme->first_passes.begin(), scheme->first_passes.end(), [](PassInfo const& pass) {
      return pass.reads.contains(Field::pressure);
    });
    bool const is_given = std::visit(
        [](auto const& p) {
          return std::any_of(p.walls.begin(), p.walls.end(), [](auto const& wall) { return static_cast<bool>(wall.pressure); });
        },
        problem);
    if (sums_pressure && is_given)
      return fmt::format("{} smooths a pressure, which behind a wall of given pressure is not that of the fluid: with {} take its wall terms", id, what);
  }
  return "";
}

/// Why particles have no Voronoi cells where a discretisation needs them; empty if they have.
std::string without_cells(AnyProblem const& problem, Discretisation const& d) {
  if (d.pair_weight != "voronoi" && d.density != "voronoi" && !d.layout.voronoi_masses) return "";
  if (!is_closed(problem)) return "Voronoi cells are unbounded: a side of the domain has neither wall nor periodic image";
  bool const is_cut = std::visit([](auto const& p) { return !p.initial_jumps.empty() && p.domain.lower.size() > 1; }, problem);
  return d.layout.voronoi_masses && is_cut ? "Voronoi masses take the density at the particle: the initial state jumps within cells" : "";
}

bool suits(CaseKind kind, std::string const& density) {
  return density == "given" ? !moves(kind) : density == "continuity" ? moves(kind) : true;
}

bool integrates(CaseKind kind, std::string const& integrator) {
  if (integrator == "runge-kutta") return true;
  bool const at_rest =
      integrator == "bdf" || integrator == "implicit-runge-kutta" || integrator == "runge-kutta-chebyshev";
  return at_rest != moves(kind);
}

/// Whether a study left a choice open, so that what does not suit a case goes without saying.
bool left_open(std::vector<std::string> const& words, std::string const& at_rest,
               std::string const& in_motion) {
  return words == std::vector<std::string>{at_rest, in_motion};
}

/// Why a discretisation makes no sense here, or would only repeat another run of the study; empty if it does.
std::string repeats(Study const& study, CaseInfo const& scene_case, AnyProblem const& problem,
                    FormulationChoice const& formulation, Discretisation const& d) {
  bool const moving = moves(scene_case.kind);
  if (!suits(scene_case.kind, d.density)) {
    return moving ? "given density is for particles at rest: moving ones carry theirs along"
                  : "continuity density needs particles that move";
  }
  if (std::string reason = why_not(problem, d.layout); !reason.empty()) return reason;
  if (std::string reason = without_cells(problem, d); !reason.empty()) return reason;
  if (std::holds_alternative<Problem<1>>(problem) && d.layout.voronoi_masses) {
    LayoutChoice own = d.layout;
    own.voronoi_masses = false;
    if (std::find(study.layouts.begin(), study.layouts.end(), own) != study.layouts.end())
      return "Voronoi masses are a layout's own in one dimension";
  }
  if (d.pair_weight == "voronoi") {
    // The kernel is left in what densities and closures sum, and viscosity has its length: one of each stands for all.
    if (d.kernel != study.kernels.front()) return "kernel " + d.kernel + no_smoothing_length;
    if (d.smoothing_ratio != study.smoothing_ratios.front())
      return fmt::format("h/dx {:g}", d.smoothing_ratio) + no_smoothing_length;
    if (d.face_weight != study.face_weights.front())
      return "face weight " + d.face_weight + " changes nothing beside Voronoi pair weights: walls have faces of cells";
    for (std::string const& id : {formulation.id, formulation.work, formulation.conduction}) {
      if (std::string reason = without_pair_weight(id); !reason.empty()) return reason;
    }
  }
  for (std::string const& id : {formulation.id, formulation.work, formulation.conduction}) {
    if (std::string reason = without_faces(id, d, moving); !reason.empty()) return reason;
  }
  if (std::string reason = without_grad_h(formulation, d); !reason.empty()) return reason;
  if (brings_weights(formulation.id) && d.face_weight != study.face_weights.front())
    return fmt::format("face weight {} changes nothing in {}, which weighs foot points by least squares", d.face_weight, formulation.id);
  if (std::string reason = without_wall_particles(problem, formulation, d); !reason.empty()) return reason;
  // A wall that goes with the gas has the mean speed of its contacts, by face weight and closure, whatever stands behind it.
  bool const has_contacts = formulation.walls && (formulation.walls.are_terms() || has_free_wall(problem));
  if (!has_contacts && d.face_weight != study.face_weights.front()) {
    return "face weight " + d.face_weight + " changes nothing without wall terms";
  }
  if (!has_contacts && d.closure != study.closures.front()) {
    return "closure " + d.closure + " changes nothing without wall terms";
  }
  if (is_external(formulation.id)) return "";
  if (scene_case.kind == CaseKind::rates) {
    if (d.integrator == study.integrators.front()) return "";
    return "integrator " + d.integrator + " changes nothing where no time passes";
  }
  if (!integrates(scene_case.kind, d.integrator)) {
    return d.integrator + (moving ? " is for particles at rest" : " is for particles that move");
  }
  if (moving && d.density == "normalised" && !formulation.walls && has_walls(problem)) {
    return "normalised density takes the walls into account, which this control does not have";
  }
  if (moving && d.wall_motion == "mass") {
    if (d.density != "continuity") {
      return "wall motion mass needs continuity density: a summed one depends on where the wall is";
    }
    if (std::get_if<Problem<1>>(&problem) == nullptr) return "wall motion mass is for one dimension";
    if (study.wall_motions.size() > 1 && (!has_free_wall(problem) || !formulation.walls)) {
      return "wall motion mass changes nothing where no wall goes with the gas";
    }
  }
  return "";
}

/// Choices that mean nothing to particles at rest are taken once, at their defaults.
bool is_repeated_at_rest(Study const& study, Discretisation const& d) {
  return d.smoothing != study.smoothings.front() || d.wall_motion != study.wall_motions.front();
}

std::string label_of(FormulationChoice const& f) {
  std::string label = f.id;
  if (!f.work.empty()) label += " + " + f.work;
  if (!f.conduction.empty()) label += " + " + f.conduction;
  return f.walls.are_terms() ? label : label + " (walls " + f.walls.word + ")";
}

std::vector<Discretisation> discretisations(Study const& study) {
  std::vector<Discretisation> all;
  for (auto const& kernel : study.kernels)
    for (auto const& density : study.densities)
      for (double const ratio : study.smoothing_ratios)
        for (auto const& layout : study.layouts)
          for (auto const& face_weight : study.face_weights)
            for (auto const& closure : study.closures)
              for (auto const& integrator : study.integrators)
                for (auto const& smoothing : study.smoothings)
                  for (auto const& wall_motion : study.wall_motions)
                    for (auto const& pair_weight : study.pair_weights) {
                    all.push_back({kernel,
                                   density,
                                   ratio,
                                   layout,
                                   face_weight,
                                   closure,
                                   integrator,
                                   smoothing,
                                   wall_motion,
                                   {},
                                   pair_weight});
                  }
  return all;
}

/// The study of which a code that is not ours takes part in: how it computes is its own, so that of each choice the first stands
/// for all, beside which it is shown. Layout, h/dx and resolution make its initial particles.
Study of_codes(Study study, CaseInfo const& info) {
  auto const first_that = [](std::vector<std::string>& words, auto const& fits) {
    auto const found = std::find_if(words.begin(), words.end(), fits);
    if (found != words.end()) words = {*found};
  };
  first_that(study.densities, [&](std::string const& word) { return suits(info.kind, word); });
  first_that(study.integrators, [&](std::string const& word) { return word == "auto" || integrates(info.kind, word); });
  study.viscosities.resize(1);
  for (auto* words : {&study.kernels, &study.pair_weights, &study.face_weights, &study.closures, &study.smoothings, &study.wall_motions}) words->resize(1);
  return study;
}

/// The viscosities to run a case with; particles at rest have none.
std::vector<ViscosityChoice> viscosities(Study const& study, CaseInfo const& scene_case) {
  if (!moves(scene_case.kind)) return {{}};
  constexpr ViscosityChoice usual{1.0, 2.0};
  std::vector<ViscosityChoice> all;
  for (auto const& viscosity : study.viscosities) {
    ViscosityChoice const choice = viscosity.value_or(scene_case.discontinuous ? usual : ViscosityChoice{});
    if (std::find(all.begin(), all.end(), choice) == all.end()) all.push_back(choice);
  }
  return all;
}

}  // namespace

Expansion expand(Study const& study) {
  Expansion expansion;
  auto const skip_once = [&](Skipped const& skipped) {
    for (Skipped const& known : expansion.skipped) {
      if (known.case_id == skipped.case_id && known.formulation == skipped.formulation &&
          known.reason == skipped.reason) {
        return;
      }
    }
    expansion.skipped.push_back(skipped);
  };
  double const coarsest = study.resolutions.front();
  for (StudyCase const& one : study.cases) {
    CaseInfo const& info = one.scene_case->info;
    AnyProblem const problem = one.scene_case->problem(one.parameters);
    std::string const reference_only = std::visit([](auto const& p) { return p.not_run_because; }, problem);
    for (FormulationChoice const& named : study.formulations) {
      FormulationChoice formulation = named;
      if (std::string const reason = mismatch(info, formulation); !reason.empty()) {
        skip_once({info.id, label_of(formulation), reason});
        continue;
      }
      auto const code = study.code_of(formulation.id);
      if (moves(info.kind) && formulation.work.empty() && !code)
        formulation.work = find_scheme(named.id)->work_partner;
      std::string const label = label_of(formulation);
      std::string missing;
      for (std::string const& id : {formulation.id, formulation.work, formulation.conduction}) {
        if (missing.empty()) missing = lacks(info, problem, id);
      }
      if (!missing.empty()) {
        skip_once({info.id, label, missing});
        continue;
      }
      if (!reference_only.empty()) {
        skip_once({info.id, label, reference_only});
        continue;
      }
      Study const of_code = code ? of_codes(study, info) : Study{};
      Study const& choices = code ? of_code : study;
      std::vector<Discretisation> taken;
      for (Discretisation d : discretisations(choices)) {
        if (!moves(info.kind)) {
          if (is_repeated_at_rest(study, d)) continue;
          d.smoothing = "uniform";
          d.wall_motion = "velocity";
        }
        if (std::string const reason = repeats(study, info, problem, formulation, d); !reason.empty()) {
          bool const goes_without_saying =
              (!suits(info.kind, d.density) && left_open(study.densities, "given", "continuity")) ||
              (!integrates(info.kind, d.integrator) && left_open(study.integrators, "bdf", "auto"));
          if (!goes_without_saying) skip_once({info.id, label, reason});
          continue;
        }
        if (d.integrator == "auto") d.integrator = info.discontinuous ? "leapfrog" : "runge-kutta";
        for (ViscosityChoice const& viscosity : viscosities(choices, info)) {
          d.viscosity = viscosity;
          // Two words may come to the same, such as auto and leapfrog.
          if (std::find(taken.begin(), taken.end(), d) != taken.end()) continue;
          taken.push_back(d);
          for (double const exponent : study.smoothing_exponents) {
            if (d.pair_weight == "voronoi" && exponent != study.smoothing_exponents.front()) {
              skip_once({info.id, label,
                         fmt::format("exponent {:g}", exponent) + no_smoothing_length});
              continue;
            }
            for (int const resolution : study.resolutions) {
              double const ratio = d.smoothing_ratio * std::pow(resolution / coarsest, exponent);
              expansion.runs.push_back(
                  {one.scene_case, one.parameters, formulation, label, d, exponent, resolution, ratio, code});
            }
          }
        }
      }
    }
  }
  return expansion;
}

}  // namespace sphverify
