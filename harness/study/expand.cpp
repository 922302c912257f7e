#include "harness/study/expand.hpp"

#include <cmath>

#include "formulations/rate_operator.hpp"

namespace sphverify {

namespace {

/// Why a formulation cannot run on a case; empty if it can.
std::string mismatch(CaseInfo const& scene_case, FormulationChoice const& formulation) {
  Rate const rate = find_scheme(formulation.id)->rate;
  switch (scene_case.kind) {
    case CaseKind::rates:
      return formulation.work.empty() && formulation.conduction.empty()
                 ? ""
                 : "an operator case evaluates one form alone, without partners";
    case CaseKind::conduction:
      if (rate == Rate::acceleration) return "a momentum form has no rate on a conduction case";
      return rate == Rate::conduction_heating ? "" : "a work form has no rate on a conduction case";
  }
  return "";
}

/// Why a discretisation makes no sense here, or would only repeat another run of the study; empty if it does.
std::string repeats(Study const& study, CaseInfo const& scene_case, FormulationChoice const& formulation,
                    Discretisation const& d) {
  if (d.density == "continuity") return "continuity density needs particles that move";
  if (!formulation.walls && d.face_weight != study.face_weights.front()) {
    return "face weight " + d.face_weight + " changes nothing without wall terms";
  }
  if (!formulation.walls && d.closure != study.closures.front()) {
    return "closure " + d.closure + " changes nothing without wall terms";
  }
  if (scene_case.kind == CaseKind::rates && d.integrator != study.integrators.front()) {
    return "integrator " + d.integrator + " changes nothing where no time passes";
  }
  return "";
}

std::string label_of(FormulationChoice const& f) {
  std::string label = f.id;
  if (!f.work.empty()) label += " + " + f.work;
  if (!f.conduction.empty()) label += " + " + f.conduction;
  return f.walls ? label : label + " (walls off)";
}

std::vector<Discretisation> discretisations(Study const& study) {
  std::vector<Discretisation> all;
  for (auto const& kernel : study.kernels)
    for (auto const& density : study.densities)
      for (double const ratio : study.smoothing_ratios)
        for (auto const& layout : study.layouts)
          for (auto const& face_weight : study.face_weights)
            for (auto const& closure : study.closures)
              for (auto const& integrator : study.integrators) {
                all.push_back({kernel, density, ratio, layout, face_weight, closure, integrator});
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
    for (FormulationChoice const& formulation : study.formulations) {
      std::string const label = label_of(formulation);
      if (std::string const reason = mismatch(info, formulation); !reason.empty()) {
        skip_once({info.id, label, reason});
        continue;
      }
      for (Discretisation const& d : discretisations(study)) {
        if (std::string const reason = repeats(study, info, formulation, d); !reason.empty()) {
          skip_once({info.id, label, reason});
          continue;
        }
        for (double const exponent : study.smoothing_exponents) {
          for (int const resolution : study.resolutions) {
            double const ratio = d.smoothing_ratio * std::pow(resolution / coarsest, exponent);
            expansion.runs.push_back(
                {one.scene_case, one.parameters, formulation, label, d, exponent, resolution, ratio});
          }
        }
      }
    }
  }
  return expansion;
}

}  // namespace sphverify
