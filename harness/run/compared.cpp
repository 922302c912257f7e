// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/run/compared.hpp"

#include <fmt/format.h>

#include <cmath>

#include "formulations/basics/finite.hpp"
#include "reports/extremes.hpp"

namespace sphverify {

void mark_not_finite(RunRecord& record, std::string const& why) {
  if (why.empty() || record.status != "ok") return;
  record.status = "non-finite";
  record.reason = why;
}

void require_finite(RunRecord& record, std::vector<ComparedField> const& fields,
                    std::span<double const> weights, std::vector<Region> const& regions) {
  for (ComparedField const& field : fields)
    mark_not_finite(record, why_not_finite(field.name, field.computed));
  // An exact solution may not be known everywhere.
  auto const require = [&](std::string const& what, std::vector<std::span<double const>> const& components) {
    for (Region const& region : regions) {
      for (std::size_t const i : region.particles) {
        for (auto const& component : components) {
          if (std::isfinite(component[i])) continue;
          return mark_not_finite(record, fmt::format("{} of particle {} is not finite", what, i));
        }
      }
    }
  };
  for (ComparedField const& field : fields) require(fmt::format("exact {}", field.name), field.exact);
  require("weight (mass over exact density)", {weights});
}

void require_finite_budgets(RunRecord& record) {
  for (std::size_t w = 0; w < record.wall_flux.size(); ++w) {
    WallFlux const& flux = record.wall_flux[w];
    if (!std::isfinite(flux.exact))
      mark_not_finite(record, fmt::format("exact flux through wall {} is not finite", w));
    if (!std::isfinite(flux.measured))
      mark_not_finite(record, fmt::format("flux through wall {} is not finite", w));
  }
  auto const is_finite = [](Budget const& b) {
    // What crossed a wall may not be known, and then neither is what pairs made.
    bool const is_unknown = std::isnan(b.exchanged) && !b.pair_drift;
    return (is_unknown || std::isfinite(b.drift)) && std::isfinite(b.pair_drift.value_or(0.0)) &&
           std::isfinite(b.wall_budget_defect.value_or(0.0));
  };
  for (auto const& [quantity, budget] : record.conservation) {
    if (!is_finite(budget)) mark_not_finite(record, fmt::format("the budget of {} is not finite", quantity));
  }
  for (Budget const& component : record.momentum) {
    if (!is_finite(component)) mark_not_finite(record, "the budget of momentum is not finite");
  }
}

template <int Dim>
Profile make_profile(Particles<Dim> const& particles, std::vector<ComparedField> const& fields,
                     std::vector<double> const& weights, std::vector<Region> const& regions) {
  Profile profile;
  profile.weight = weights;
  for (Region const& region : regions) {
    profile.regions[region.name].assign(region.particles.begin(), region.particles.end());
  }
  auto const at = [](std::vector<std::span<double const>> const& components, std::size_t i) {
    std::vector<double> values;
    for (auto const& component : components) values.push_back(component[i]);
    return values;
  };
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Vector<Dim> const x = particles.positions()[i];
    profile.position.emplace_back(x.begin(), x.end());
    for (ComparedField const& field : fields) {
      std::string const name(field.name);
      profile.computed[name].push_back(at(field.computed, i));
      profile.exact[name].push_back(at(field.exact, i));
    }
  }
  return profile;
}

double time_error_share(FieldErrors const& change, FieldErrors const& error) {
  double share = 0.0;
  for (auto const& [region, changed] : change) {
    RegionError const& whole = error.at(region);
    for (double NormSet::*const norm : {&NormSet::l1, &NormSet::l2, &NormSet::linf}) {
      if (changed.error.*norm <= whole.round_off) continue;
      share = larger(share, changed.error.*norm / (whole.error.*norm));
    }
  }
  return share;
}

void put_time_error(double change, double share, Integration& integration) {
  bool const is_known = std::isfinite(change) && std::isfinite(share);
  integration.time_error = is_known ? Number(change) : std::nullopt;
  integration.time_error_share = is_known ? Number(share) : std::nullopt;
  integration.remark = is_known ? "" : "what is not finite cannot be compared";
}

#define SPHVERIFY_INSTANTIATE(Dim)                                                        \
  template Profile make_profile(Particles<Dim> const&, std::vector<ComparedField> const&, \
                                std::vector<double> const&, std::vector<Region> const&);
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
